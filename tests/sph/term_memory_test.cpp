// What a term holds in memory: its own fields when it is on, nothing when it is off.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <string>

#include "sph/ice.hpp"
#include "tests/support/surfaces.hpp"

namespace nilas::sph {
namespace {

constexpr std::size_t kSide = 6, kCount = kSide * kSide * kSide;

using Change = std::function<void(IceSpec&)>;

/// Bytes per particle of the fields that not every ice has, by name; those that hold memory only.
std::map<std::string, std::size_t> optional_fields(const Particles& p) {
  std::map<std::string, std::size_t> held;
  const auto add = [&](const char* name, const auto& field) {
    if (field.capacity() > 0) held[name] = sizeof(field[0]) * field.capacity() / p.size();
  };
  add("correction", p.correction);
  add("stabilisation", p.stabilisation);
  add("plastic_strain", p.plastic_strain);
  add("failed", p.failed);
  add("bulking", p.bulking);
  add("strain_rate", p.strain_rate);
  add("tensile_damage", p.tensile_damage);
  add("shear_damage", p.shear_damage);
  add("deformation_gradient", p.deformation_gradient);
  add("sleep", p.sleep);
  add("pair_records", p.pair_records.quantities);
  add("single_pair_records", p.single_pair_records.quantities);
  // Every ice holds the copies that its pair loops read, in one precision; what counts here is the other.
  if (held.contains("pair_records") && !held.contains("single_pair_records")) held.erase("pair_records");
  return held;
}

/// Elastic ice without any optional term, then changed, after two steps beside a sphere that touches it.
Ice ice_with(const Change& change) {
  IceSpec spec;
  PieceSpec block;
  block.shape = IceShape::block;
  block.size = Vec3::Constant(0.02 * kSide);
  spec.pieces = {block};
  spec.spacing = 0.02;
  spec.material.model = Model::elastic;
  spec.numerics.viscosity_alpha = 0;
  change(spec);
  std::vector<Surface> surfaces{test::sphere(Vec3(0, 0, -0.06 - 0.05), 0.05, 0.015)};
  Ice ice(spec, surfaces);
  for (int n = 0; n < 2; ++n) ice.step(surfaces, ice.stable_step().dt);
  return ice;
}

std::set<std::string> names_of_fields(const Change& change) {
  std::set<std::string> names;
  for (const auto& [name, bytes] : optional_fields(ice_with(change).particles())) names.insert(name);
  return names;
}

std::size_t bytes_of(const Change& change) { return ice_with(change).bytes(); }

void nothing(IceSpec&) {}
void corrected(IceSpec& s) { s.numerics.gradient_correction = true; }
void drucker_prager(IceSpec& s) { s.material.model = Model::drucker_prager; }
void neo_hookean(IceSpec& s) { s.material.model = Model::neo_hookean; }

TEST(TermMemory, IceWithoutOptionalTermsHoldsNoneOfTheirFields) {
  EXPECT_EQ(names_of_fields(nothing), (std::set<std::string>{}));
}

TEST(TermMemory, EachTermHoldsItsOwnFieldsAndNoOthers) {
  using Names = std::set<std::string>;
  EXPECT_EQ(names_of_fields(corrected), (Names{"correction"}));
  EXPECT_EQ(names_of_fields([](IceSpec& s) { corrected(s), s.numerics.hourglass_control = 1; }),
            (Names{"correction", "stabilisation"}));
  EXPECT_EQ(names_of_fields([](IceSpec& s) { s.numerics.artificial_stress = 0.3; }), (Names{"stabilisation"}));
  EXPECT_EQ(names_of_fields(drucker_prager), (Names{"failed", "plastic_strain"}));
  EXPECT_EQ(names_of_fields([](IceSpec& s) { drucker_prager(s), s.material.pressure = PressureLaw::density; }),
            (Names{"bulking", "failed", "plastic_strain"}));
  EXPECT_EQ(names_of_fields([](IceSpec& s) { s.material.model = Model::rate_dependent; }),
            (Names{"bulking", "failed", "plastic_strain", "shear_damage", "strain_rate", "tensile_damage"}));
  EXPECT_EQ(names_of_fields(neo_hookean), (Names{"deformation_gradient"}));
  EXPECT_EQ(names_of_fields([](IceSpec& s) { s.numerics.quiet_speed = 1e-3; }), (Names{"sleep"}));
  EXPECT_EQ(names_of_fields([](IceSpec& s) { s.numerics.precision = Precision::single; }),
            (Names{"single_pair_records"}));
}

TEST(TermMemory, TermsThatAreNumbersOnlyHoldNoField) {
  for (const Change& change : std::initializer_list<Change>{
           [](IceSpec& s) { s.numerics.viscosity_alpha = 0.1; }, [](IceSpec& s) { s.numerics.viscosity_beta = 0.1; },
           [](IceSpec& s) { s.numerics.density_diffusion = 0.1; },
           [](IceSpec& s) { s.numerics.density_reinitialisation = 1; }, [](IceSpec& s) { s.numerics.shifting = 0.1; },
           [](IceSpec& s) { s.gravity = Vec3(0, 0, -9.81); }, [](IceSpec& s) { s.contact.friction_coefficient = 0.1; },
           [](IceSpec& s) { s.material.pressure = PressureLaw::density; },
           [](IceSpec& s) { s.pieces.front().fixed.faces[5] = true; },
           [](IceSpec& s) {
             s.periodic = {true, true, false};
           }})
    EXPECT_EQ(names_of_fields(change), (std::set<std::string>{}));
}

TEST(TermMemory, ATermAddsTheBytesOfItsFieldsAndWorkSpaceToTheIce) {
  const std::size_t bare = bytes_of(nothing);
  const auto added = [&](const Change& change) { return bytes_of(change) - bare; };
  for (const Change& change : std::initializer_list<Change>{
           [](IceSpec& s) { s.numerics.viscosity_alpha = 0.1; },
           [](IceSpec& s) { s.numerics.density_reinitialisation = 1; },
           [](IceSpec& s) { s.gravity = Vec3(0, 0, -9.81); }, [](IceSpec& s) { s.contact.friction_coefficient = 0.1; },
           [](IceSpec& s) { s.contact.stick = true; }, [](IceSpec& s) { s.material.pressure = PressureLaw::density; },
           [](IceSpec& s) { s.pieces.front().fixed.faces[5] = true; }})
    EXPECT_EQ(added(change), 0u);
  for (const Change& change : std::initializer_list<Change>{
           corrected, drucker_prager, neo_hookean, [](IceSpec& s) { s.material.model = Model::rate_dependent; }}) {
    const Ice ice = ice_with(change);
    // Corrected pair loops copy T = sigma B in place of sigma.
    std::size_t fields = ice.particles().pair_records.bytes() - ice_with(nothing).particles().pair_records.bytes();
    for (const auto& [name, bytes] : optional_fields(ice.particles())) fields += kCount * bytes;
    EXPECT_EQ(added(change), fields);
  }
  EXPECT_LT(bytes_of([](IceSpec& s) { s.numerics.precision = Precision::single; }), bare);
  // Work space: a tensor and a number per particle.
  EXPECT_EQ(added([](IceSpec& s) { s.numerics.artificial_stress = 0.3; }), kCount * (sizeof(Vec3) + sizeof(Sym3)));
  EXPECT_EQ(added([](IceSpec& s) { s.numerics.density_diffusion = 0.1; }), kCount * sizeof(double));
  // Its longer list and coarser cells count, too.
  EXPECT_GT(added([](IceSpec& s) { s.numerics.shifting = 0.1; }), 0u);
}

TEST(TermMemory, SwitchesOfALawAddNothingToThatLaw) {
  const auto law = [](const Change& change) { return [&change](IceSpec& s) { drucker_prager(s), change(s); }; };
  const std::size_t plain = bytes_of(drucker_prager);
  const Change hardening = [](IceSpec& s) { s.material.hardening_modulus = 1e9; };
  const Change softening = [](IceSpec& s) {
    s.material.after_failure = AfterFailure::softening, s.material.softening_strain = 0.01;
  };
  EXPECT_EQ(bytes_of(law(hardening)), plain);
  EXPECT_EQ(bytes_of(law(softening)), plain);
  EXPECT_EQ(bytes_of([](IceSpec& s) { neo_hookean(s), s.material.kelvin_voigt = 0.1; }), bytes_of(neo_hookean));
}

}  // namespace
}  // namespace nilas::sph
