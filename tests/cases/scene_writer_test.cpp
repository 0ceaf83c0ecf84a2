#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "cases/scene.hpp"
#include "tests/support/scene_text.hpp"
#include "tests/support/scratch_directory.hpp"

namespace nilas::cases {
namespace {

using test::ScratchDirectory;

/// Everything of a scene but where it was read, as bit patterns and words: two scenes are the same if these are.
class Fingerprint {
 public:
  explicit Fingerprint(const Scene& scene) {
    add(scene.title);
    for (const auto& text : scene.calibrated) add(text);
    for (const auto& text : scene.notes) add(text);
    for (const auto& piece : scene.ice.pieces) add(piece);
    add(scene.ice);
    if (scene.whole_sheet) add(*scene.whole_sheet);
    for (const auto& body : scene.bodies) add(body);
    add(scene.run.end_time, scene.run.bullet_step, scene.run.momentum_bound, scene.run.angular_momentum_bound,
        scene.run.energy_bound);
    add(scene.output.interval, scene.output.history_interval, scene.output.loads_interval, scene.output.force_window);
  }
  bool operator==(const Fingerprint&) const = default;
  std::size_t size() const { return words_.size(); }

 private:
  void add(double value) { words_.push_back(std::to_string(std::bit_cast<std::uint64_t>(value))); }
  void add(const std::string& text) { words_.push_back("\"" + text + "\""); }
  template <class... Numbers>
  void add(double first, double second, Numbers... rest) {
    add(first);
    add(second);
    (add(static_cast<double>(rest)), ...);
  }
  void add(const Vec3& v) { add(v.x(), v.y(), v.z()); }
  void add(const sph::PieceSpec& piece) {
    add(static_cast<double>(piece.shape), piece.diameter, piece.thickness, piece.fixed.rim);
    add(static_cast<double>(piece.absorbing_rim));
    for (const bool face : piece.fixed.faces) add(static_cast<double>(face));
    add(piece.size);
    add(piece.centre);
    add(piece.velocity);
  }
  void add(const sph::IceSpec& ice) {
    add(ice.spacing);
    for (const bool axis : ice.periodic) add(static_cast<double>(axis));
    const auto& m = ice.material;
    add(static_cast<double>(m.model), m.density, m.young_modulus, m.poisson_ratio, static_cast<double>(m.pressure),
        m.cohesion, m.friction_angle_deg, m.dilation_angle_deg, static_cast<double>(m.after_failure),
        m.residual_strength, m.softening_strain, m.hardening_modulus, m.kelvin_voigt);
    const auto& r = m.rate_dependent;
    add(r.strength_at_unit_rate, r.rate_exponent, r.tensile_strength, r.fracture_energy, r.fracture_toughness,
        r.softening_slip, r.residual_friction_angle_deg, r.largest_bulking);
    const auto& n = ice.numerics;
    add(n.smoothing_ratio, n.gradient_correction, n.viscosity_alpha, n.viscosity_beta, n.cfl,
        static_cast<double>(n.cfl_sound_speed), n.max_step, n.max_coupling_number, n.quiet_speed, n.skin_ratio,
        static_cast<double>(n.precision), n.sound_speed_scale);
    const auto& c = ice.contact;
    add(c.stiffness, c.damping, c.tangential_damping, c.friction_coefficient, c.stick);
  }
  void add(const rigid::BodySpec& body) {
    add(body.name);
    add(rigid::name(body.shape));
    add(std::visit([](const auto& shape) { return dimensions(shape); }, body.shape));
    add(body.boundary_spacing, body.mass.mass, static_cast<double>(body.motion));
    add(body.mass.centre_of_mass);
    add(body.mass.inertia);
    add(body.position);
    add(body.orientation.w(), body.orientation.x(), body.orientation.y(), body.orientation.z());
    add(body.velocity);
    add(body.angular_velocity);
  }
  static Vec3 dimensions(const rigid::Hcc& s) { return {s.length, s.diameter, s.nose_length}; }
  static Vec3 dimensions(const rigid::Sphere& s) { return {s.diameter, 0, 0}; }
  static Vec3 dimensions(const rigid::Box& s) { return s.size; }
  static Vec3 dimensions(const rigid::Cylinder& s) { return {s.length, s.diameter, 0}; }
  static Vec3 dimensions(const rigid::Capsule& s) { return {s.length, s.diameter, 0}; }
  static Vec3 dimensions(const rigid::Cone& s) { return {s.length, s.diameter, 0}; }
  static Vec3 dimensions(const rigid::Mesh&) { return Vec3::Zero(); }      // no scene has one
  static Vec3 dimensions(const rigid::Compound&) { return Vec3::Zero(); }  // no scene has one

  std::vector<std::string> words_;
};

Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const ScratchDirectory scratch;
  return read_scene(scratch.write("scene.toml", text), overrides);
}

void expect_round_trip(const Scene& scene, const std::string& what) {
  const std::string text = write_scene(scene);
  const Scene again = read(text);
  EXPECT_TRUE(Fingerprint(again) == Fingerprint(scene)) << what << "\n" << text;
  EXPECT_EQ(write_scene(again), text) << what;
}

TEST(SceneWriter, EveryShippedSceneReadsBackTheSameToTheLastBit) {
  for (const auto& shipped : shipped_scenes())
    expect_round_trip(read_scene(find_scene(shipped.name), {}), shipped.name);
}

TEST(SceneWriter, EveryAngleOfImpactReadsBackTheSameToTheLastBit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(1, 90);
  for (int i = 0; i < 50; ++i) {
    const std::string set = "impact.angle_deg=" + std::to_string(angle(random));
    expect_round_trip(read(test::oblique_scene(), {set}), set);
  }
}

TEST(SceneWriter, ABodyOfEveryShapeAndMotionReadsBackTheSame) {
  const std::string ice = "[ice]\nshape = \"disc\"\ndiameter_m = 1\nthickness_m = 0.1\nspacing_m = 0.1\n";
  const std::string run = "[run]\nend_time_s = 1\n";
  const std::string shapes[] = {"shape = \"sphere\"\ndiameter_m = 0.3\n",
                                "shape = \"box\"\nsize_m = [0.1, 0.7, 0.3]\n",
                                "shape = \"plate\"\nsize_m = [3, 0.7, 0.3]\n",
                                "shape = \"cylinder\"\nlength_m = 0.7\ndiameter_m = 0.3\n",
                                "shape = \"capsule\"\nlength_m = 0.7\ndiameter_m = 0.3\n",
                                "shape = \"cone\"\nlength_m = 0.7\ndiameter_m = 0.3\n",
                                "shape = \"hcc\"\nlength_m = 0.7\ndiameter_m = 0.3\nnose_length_m = 0.1\n"};
  const std::string motions[] = {"motion = \"free\"\ndensity_kg_m3 = 700.1\nvelocity_m_s = [0.1, -0.2, 0.3]\n",
                                 "motion = \"translation-only\"\nmass_kg = 0.1\nvelocity_m_s = [0.1, -0.2, 0.3]\n",
                                 "motion = \"fixed-path\"\nangular_velocity_rad_s = [0.1, -0.2, 1e9]\n",
                                 "motion = \"fixed-path\"\ndensity_kg_m3 = 1500\n", "motion = \"fixed\"\n"};
  for (const auto& shape : shapes)
    for (const auto& motion : motions) {
      const std::string body = "[[body]]\nposition_m = [0.1, 0.7, -1.3]\naxis = [0.3, -0.1, 0.7]\n" + shape + motion;
      expect_round_trip(read(ice + body + run), shape + motion);
    }
}

TEST(SceneWriter, StatedMassPropertiesReadBackTheSame) {
  const std::string keys = "centre_of_mass_m = [0.01, -0.02, 0.03]\ninertia_kg_m2 = [0.1, 0.11, 0.12]\n";
  const std::string body =
      "[[body]]\nshape = \"box\"\nsize_m = [0.5, 0.5, 0.5]\nmass_kg = 5.3\nposition_m = [0, 0, -1]\n";
  const std::string ice = "[ice]\nshape = \"disc\"\ndiameter_m = 1\nthickness_m = 0.1\nspacing_m = 0.1\n";
  expect_round_trip(read(ice + body + keys + "[run]\nend_time_s = 1\n"), "mass");
}

TEST(SceneWriter, EveryKindOfIceReadsBackTheSame) {
  const std::string block =
      "[ice]\nshape = \"block\"\nsize_m = [0.7, 0.7, 0.7]\nspacing_m = 0.1\n[run]\nend_time_s = 1\n";
  expect_round_trip(read(block, {"ice.periodic=[\"y\", \"z\"]", "ice.fixed=[\"x-\", \"x+\"]"}), "periodic");
  expect_round_trip(read(block, {"ice.material.model=elastic", "ice.material.pressure=density"}), "elastic");
  expect_round_trip(read(block, {"ice.material.after_failure=softening", "ice.material.residual_strength=0.1",
                                 "ice.material.softening_strain=0.03"}),
                    "softening");
  expect_round_trip(
      read(block, {"ice.material.after_failure=cohesionless", "contact.stick=true", "numerics.gradient_correction=true",
                   "numerics.cfl_sound_speed=p-wave", "numerics.precision=single", "numerics.sound_speed_scale=0.7",
                   "numerics.quiet_speed_m_s=1e-3"}),
      "words");
  expect_round_trip(read(block, {"ice.material.after_failure=plastic", "ice.material.hardening_modulus_Pa=1e8"}),
                    "hardening");
  expect_round_trip(read(block, {"ice.material.model=neo-hookean", "ice.material.kelvin_voigt=0.3"}), "neo-hookean");
  expect_round_trip(read(block, {"ice.material.preset=real-ice"}), "real-ice");
  expect_round_trip(
      read(block, {"ice.material.model=rate-dependent", "ice.material.strength_at_unit_rate_Pa=1.1e7",
                   "ice.material.rate_exponent=0.09", "ice.material.tensile_strength_Pa=6e5",
                   "ice.material.fracture_energy_J_m2=1.3", "ice.material.fracture_toughness_Pa_sqrt_m=1.1e5",
                   "ice.material.softening_slip_m=1e-3", "ice.material.largest_bulking=0.3",
                   "ice.material.residual_friction_angle_deg=7"}),
      "rate-dependent");
  expect_round_trip(read(test::oblique_scene(), {"ice.fixed=[\"rim\", \"z-\"]"}), "rim and bottom");
  const std::string pieces =
      "[[ice]]\nshape = \"sphere\"\ndiameter_m = 0.3\nspacing_m = 0.1\n[ice.material]\npoisson_ratio = 0.1\n"
      "[[ice]]\nshape = \"block\"\nsize_m = [1, 1, 1]\ncentre_m = [2, 0, 0]\nvelocity_m_s = [-0.1, 0, 0]\n"
      "[run]\nend_time_s = 1\n";
  expect_round_trip(read(pieces), "pieces");
}

TEST(SceneWriter, ACutSheetReadsBackTheSameWhateverTheSpacing) {
  for (const char* spacing : {"0.05", "0.03", "0.0333", "0.017"})
    for (const char* fixed : {"rim", "none"}) {
      const std::vector<std::string> sets{"ice.domain=auto", "ice.diameter_m=2.4",
                                          std::string("ice.spacing_m=") + spacing, std::string("ice.fixed=") + fixed};
      const Scene scene = read(test::oblique_scene(), sets);
      EXPECT_TRUE(scene.ice.pieces[0].absorbing_rim);
      expect_round_trip(scene, spacing);
    }
  expect_round_trip(read(test::oblique_scene(), {"ice.domain=auto"}), "a sheet that is not larger than its domain");
}

TEST(SceneWriter, OddNumbersReadBackTheSameToTheLastBit) {
  const double odd[] = {0.1,
                        1.0 / 3,
                        1e300,
                        9007199254740993.0,
                        12345678901234567890.0,
                        1e22,
                        std::numeric_limits<double>::max(),
                        std::numeric_limits<double>::min(),
                        std::numeric_limits<double>::denorm_min(),
                        std::nextafter(1.0, 2.0),
                        5e-324 * 12345};
  for (const double value : odd) {
    Scene scene = read(test::oblique_scene());
    scene.run.end_time = value;
    scene.ice.pieces[0].velocity = {value, -value, -0.0};
    scene.bodies[0].angular_velocity = {-value, 0.0, value};
    expect_round_trip(scene, std::to_string(value));
  }
}

TEST(SceneWriter, RandomBitPatternsReadBackTheSame) {
  std::mt19937_64 random(11);
  Scene scene = read(test::oblique_scene());
  for (int i = 0; i < 2000;) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    scene.ice.pieces[0].centre[i++ % 3] = value;
    if (i % 3 == 0) {
      EXPECT_EQ(read(write_scene(scene)).ice.pieces[0].centre, scene.ice.pieces[0].centre);
    }
  }
}

TEST(SceneWriter, TextKeepsItsQuotesBackslashesAndLetters) {
  Scene scene = read(test::oblique_scene());
  scene.title = "a \"quoted\" \\ title: 45\u00b0, \u03c3\u2081 #not a comment";
  scene.calibrated.insert(scene.calibrated.end(), {"x = \"y\"", "", "[z]"});
  expect_round_trip(scene, "text");
}

TEST(SceneWriter, AMassThatNobodyStatedIsNotWritten) {
  const std::string text = write_scene(read_scene(find_scene("ice-ball-on-plate"), {}));
  EXPECT_EQ(text.find("mass_kg"), std::string::npos);
}

}  // namespace
}  // namespace nilas::cases
