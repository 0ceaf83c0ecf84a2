// Four elastic particles at a time: the same as the law particle by particle, to round-off; the rest is left to it.
#include <gtest/gtest.h>

#include "sph/material.hpp"
#include "sph/pair_passes_kernel.hpp"
#include "sph/stress_update.hpp"
#include "sph/stress_update_kernel.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

constexpr double dx = 0.02, dt = 2e-6, kEpsilon = 2.2e-16;

MaterialSpec ice(Model model, PressureLaw pressure) {
  MaterialSpec spec;
  spec.model = model;
  spec.pressure = pressure;
  return spec;
}

/// Four particles with random gradients and stresses of that size [1/s, Pa].
Particles four(const MaterialSpec& spec, double gradient, double stress) {
  test::Random random(7);
  Particles p = test::particles_at({{0, 0, 0}, {dx, 0, 0}, {0, dx, 0}, {0, 0, dx}}, dx);
  p.mass = spec.density * dx * dx * dx;
  if (spec.model == Model::drucker_prager) p.plastic_strain.assign(4, 0), p.failed.assign(4, 0);
  if (spec.model == Model::drucker_prager && spec.pressure == PressureLaw::density) p.bulking = {0, 1e-5, 0, 2e-5};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 a = stress * random.vector(), b = stress * random.vector();
    p.stress[i] = {a[0], a[1], a[2], b[0], b[1], b[2]};
    for (int k = 0; k < 3; ++k) p.velocity_gradient[i].row(k) = gradient * random.vector().transpose();
    p.motion[i].volume *= 1 + 1e-5 * random.vector()[0];
  }
  return p;
}

/// The oracle: one particle alone is too few for a pack, so update_stress leaves it to the law.
Particles by_law(const Particles& all, const MaterialSpec& spec) {
  Particles result = all;
  const Material material = make_material(spec, dx, 1.3 * dx);
  for (std::size_t i = 0; i < 4; ++i) {
    Particles one = test::particles_at({all.motion[i].position}, dx);
    one.mass = all.mass;
    one.motion[0] = all.motion[i], one.stress[0] = all.stress[i], one.velocity_gradient[0] = all.velocity_gradient[i];
    if (!all.failed.empty()) one.failed = {all.failed[i]}, one.plastic_strain = {all.plastic_strain[i]};
    if (!all.bulking.empty()) one.bulking = {all.bulking[i]};
    update_stress(one, material, spec.density, dt);
    result.motion[i] = one.motion[0], result.stress[i] = one.stress[0];
    if (!all.failed.empty()) result.failed[i] = one.failed[0], result.plastic_strain[i] = one.plastic_strain[0];
  }
  return result;
}

/// scale [Pa]: of the largest number whose rounding the stresses show.
void expect_equal(const Particles& a, const Particles& b, double scale) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a.motion[i].volume, b.motion[i].volume, 4 * kEpsilon * b.motion[i].volume);
    EXPECT_LT((to_matrix(a.stress[i]) - to_matrix(b.stress[i])).norm(), 16 * kEpsilon * scale) << i;
  }
}

ElasticPackConstants range(const MaterialSpec& spec) {
  const ElasticConstants e(spec);
  const DruckerPragerCone cone(spec, e);
  const double volume = dx * dx * dx;
  return {e.bulk_modulus, e.shear_modulus, cone.alpha, cone.k, volume, volume / 100};
}

TEST(ElasticPack, IsTheLawToRoundOffInEveryInstructionSetForBothPressureLaws) {
  for (const PressureLaw pressure : {PressureLaw::volumetric_strain, PressureLaw::density}) {
    const MaterialSpec spec = ice(Model::drucker_prager, pressure);
    const Particles start = four(spec, 5, 5e4);
    const Particles expected = by_law(start, spec);
    ASSERT_EQ(expected.failed, std::vector<std::uint8_t>(4, 0)) << "the state is to be an elastic one";
    for (const bool v3 : {false, true}) {
      if (v3 && !has_v3()) continue;
      const bool density = pressure == PressureLaw::density;
      const ElasticPackUpdate update =
          v3 ? v3::select_elastic_update(density) : baseline::select_elastic_update(density);
      Particles p = start;
      double work = 0;
      ASSERT_TRUE(update(p, 0, range(spec), dt, work));
      // From density the pressure is K times a difference of numbers near 1.
      expect_equal(p, expected, density ? ElasticConstants(spec).bulk_modulus : 1e6);
    }
  }
}

TEST(ElasticPack, ElasticIceNeverYields) {
  const MaterialSpec spec = ice(Model::elastic, PressureLaw::volumetric_strain);
  Particles p = four(spec, 500, 5e9);
  const Particles expected = by_law(p, spec);
  update_stress(p, make_material(spec, dx, 1.3 * dx), spec.density, dt);
  expect_equal(p, expected, 5e9);
}

TEST(ElasticPack, LeavesFourAloneOfWhichOneYieldsOrHasFailedOrStrainsByMuch) {
  const MaterialSpec spec = ice(Model::drucker_prager, PressureLaw::volumetric_strain);
  const auto change = [&](const auto& spoil) {
    Particles p = four(spec, 5, 5e4);
    spoil(p);
    const Particles before = p;
    double work = 0;
    for (const bool v3 : {false, true}) {
      if (v3 && !has_v3()) continue;
      EXPECT_FALSE(
          (v3 ? v3::select_elastic_update : baseline::select_elastic_update)(false)(p, 0, range(spec), dt, work));
      EXPECT_EQ(work, 0);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(p.motion[i].volume, before.motion[i].volume);
        EXPECT_EQ(to_matrix(p.stress[i]), to_matrix(before.stress[i]));
      }
    }
  };
  change([](Particles& p) { p.stress[2].xy = 5e6; });                    // beyond the cone
  change([](Particles& p) { p.stress[1] = {4e6, 4e6, 4e6, 0, 0, 0}; });  // beyond its apex
  change([](Particles& p) { p.failed[3] = 1; });
  change([](Particles& p) { p.velocity_gradient[0](0, 0) = 1e4; });
  change([](Particles& p) { p.velocity_gradient[0](0, 0) = std::nan(""); });
  change([](Particles& p) { p.motion[2].volume = 1e-9 * p.motion[2].volume; });
}

}  // namespace
}  // namespace nilas::sph
