#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/material_presets.hpp"
#include "cases/scene.hpp"
#include "tests/support/scene_text.hpp"
#include "tests/support/scratch_directory.hpp"

namespace nilas::cases {
namespace {

using test::oblique_scene;
using test::replaced;
using test::ScratchDirectory;

Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const ScratchDirectory scratch;
  return read_scene(scratch.write("scene.toml", text), overrides);
}

/// The one-line error of a scene, from the file's name on; "accepted" if there is none.
std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read(text, overrides);
  } catch (const SceneError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    const auto file = message.find("scene.toml:");
    return file == std::string::npos ? message : message.substr(file);
  }
  return "accepted";
}

/// That of the oblique scene with one change.
std::string refusal_of_change(const std::string& from, const std::string& to) {
  return refusal(replaced(oblique_scene(), from, to));
}

const std::string block_scene =
    "[ice]\nshape = \"block\"\nsize_m = [0.4, 0.06, 0.06]\nspacing_m = 0.01\n[run]\nend_time_s = 1\n";

std::string with_body(const std::string& keys) { return block_scene + "[[body]]\n" + keys; }
const std::string ball = "shape = \"sphere\"\ndiameter_m = 0.1\n";

TEST(SceneReader, AcceptsTheSceneThatTheRefusalsAreMadeFrom) {
  EXPECT_EQ(refusal(oblique_scene()), "accepted");
  EXPECT_EQ(refusal(block_scene), "accepted");
}

TEST(SceneReader, StatedValuesArriveUnchanged) {
  const Scene scene = read(oblique_scene());
  EXPECT_EQ(scene.title, "a small sheet");
  ASSERT_EQ(scene.ice.pieces.size(), 1u);
  EXPECT_EQ(scene.ice.pieces[0].diameter, 1.2);
  EXPECT_EQ(scene.ice.pieces[0].thickness, 0.3);
  EXPECT_TRUE(scene.ice.pieces[0].fixed.rim);
  EXPECT_EQ(scene.ice.spacing, 0.05);
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].name, "body");
  EXPECT_EQ(scene.bodies[0].mass.mass, 174.1);
  EXPECT_EQ(scene.bodies[0].mass.centre_of_mass, Vec3(0, 0, -0.9333));
  EXPECT_EQ(scene.bodies[0].mass.inertia, Vec3(21.4, 21.4, 3.9));
  EXPECT_EQ(scene.run.end_time, 0.001);
}

TEST(SceneReader, TheMomentumBoundOfSinglePrecisionIsThatOfFloatsUnlessStated) {
  EXPECT_EQ(read(oblique_scene()).run.momentum_bound, 1e-10);
  EXPECT_EQ(read(oblique_scene()).ice.numerics.precision, sph::Precision::double_);
  const Scene single = read(oblique_scene(), {"numerics.precision=single"});
  EXPECT_EQ(single.ice.numerics.precision, sph::Precision::single);
  EXPECT_EQ(single.run.momentum_bound, 1e-6);
  EXPECT_EQ(read(oblique_scene(), {"numerics.precision=single", "run.momentum_bound=1e-8"}).run.momentum_bound, 1e-8);
}

TEST(SceneReader, BoundaryParticlesAreThreeQuartersOfTheIceSpacingApartUnlessStated) {
  EXPECT_EQ(read(oblique_scene()).bodies[0].boundary_spacing, 0.75 * 0.05);
  EXPECT_EQ(read(oblique_scene(), {"body.0.spacing_m=0.015"}).bodies[0].boundary_spacing, 0.015);
}

TEST(SceneReader, ThePapersIceHasThePapersNumbers) {
  const auto ice = read(replaced(oblique_scene(), "density_kg_m3 = 900\npoisson_ratio = 0.33", "preset = \"cai-2025\""))
                       .ice.material;
  EXPECT_EQ(ice.density, 900);
  EXPECT_EQ(ice.young_modulus, 9.38e9);
  EXPECT_EQ(ice.poisson_ratio, 0.33);
  EXPECT_EQ(ice.cohesion, 0.58e6);
  EXPECT_EQ(ice.friction_angle_deg, 36);
  EXPECT_EQ(ice.dilation_angle_deg, 12);
  EXPECT_EQ(ice.after_failure, sph::AfterFailure::fluid);
  EXPECT_EQ(ice.pressure, sph::PressureLaw::volumetric_strain);
}

// [impact] places the body: axis along the velocity, tip under the middle, highest point `gap` below the sheet.

TEST(SceneReader, ImpactVelocityPointsUpAndToNegativeYWithTheAxisAlongIt) {
  const auto body = read(oblique_scene()).bodies[0];
  const double angle = std::numbers::pi / 3;
  EXPECT_LT((body.velocity - 100 * Vec3(0, -std::cos(angle), std::sin(angle))).norm(), 1e-12);
  EXPECT_LT((body.orientation * Vec3::UnitZ() - body.velocity / 100).norm(), 1e-14);
}

TEST(SceneReader, VerticalImpactIsExactlyVertical) {
  const auto body = read(oblique_scene(), {"impact.angle_deg=90"}).bodies[0];
  EXPECT_EQ(body.velocity, Vec3(0, 0, 100));
  EXPECT_EQ(body.position, Vec3(0, 0, -0.15 - 0.02 - 0.9333));
}

TEST(SceneReader, ImpactLeavesTheGapBetweenTheBodyAndTheSheet) {
  for (const char* angle : {"10", "45", "60", "90"}) {
    const Scene scene = read(oblique_scene(), {std::string("impact.angle_deg=") + angle, "ice.centre_m=[1, 2, 3]"});
    const auto& body = scene.bodies[0];
    double top = -1e9;  // the surface, sampled
    for (const auto& point : rigid::surface_points(body.shape, 0.002))
      top = std::max(top, (body.position + body.orientation * (point.position - body.mass.centre_of_mass)).z());
    EXPECT_LE(top, 3 - 0.15 - 0.02 + 1e-12) << angle;
    EXPECT_GT(top, 3 - 0.15 - 0.02 - 1e-4) << angle;
    const Vec3 tip = body.position - body.orientation * body.mass.centre_of_mass;
    EXPECT_NEAR(tip.x(), 1, 1e-14);
    EXPECT_NEAR(tip.y(), 2, 1e-14);
  }
}

TEST(SceneReader, ImpactPlacesTheFirstBodyThatIsNotFixed) {
  const std::string wall =
      "[[body]]\nshape = \"box\"\nsize_m = [1, 1, 1]\nmotion = \"fixed\"\nposition_m = [0, 0, 5]\n";
  const Scene scene = read(replaced(oblique_scene(), "[[body]]\n", wall + "[[body]]\n"));
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[0].position, Vec3(0, 0, 5));
  EXPECT_EQ(scene.bodies[0].velocity, Vec3(0, 0, 0));
  EXPECT_EQ(scene.bodies[1].name, "body-2");
  EXPECT_NEAR(scene.bodies[1].velocity.norm(), 100, 1e-12);
}

// Refusals: file, line, key, value, what is allowed.

TEST(SceneReader, AnUnknownKeyNamesTheNearestKnownOne) {
  EXPECT_EQ(refusal_of_change("fixed = \"rim\"", "fixd = \"rim\""),
            "scene.toml:7: ice.fixd = \"rim\": unknown key, the nearest known one is fixed");
  EXPECT_EQ(refusal_of_change("diameter_m = 1.2", "diamter_m = 1.2"),
            "scene.toml:4: ice.diamter_m = 1.2: unknown key, the nearest known one is diameter_m");
  EXPECT_EQ(refusal_of_change("[impact]", "[impakt]"),
            "scene.toml:19: impakt = {...}: unknown key, the nearest known one is impact");
}

TEST(SceneReader, AWrongTypeIsRefused) {
  EXPECT_EQ(refusal_of_change("diameter_m = 1.2", "diameter_m = \"wide\""),
            "scene.toml:4: ice.diameter_m = \"wide\": allowed: a finite number > 0");
  EXPECT_EQ(refusal_of_change("title = \"a small sheet\"", "title = 3"),
            "scene.toml:1: title = 3: allowed: a string of one line");
  EXPECT_EQ(refusal_of_change("fixed = \"rim\"", "numerics = 3").substr(0, 15), "scene.toml:7: i");
  EXPECT_EQ(refusal_of_change("[[body]]", "[body]"),
            "scene.toml:11: body = {...}: allowed: an array of tables, [[body]]");
  EXPECT_EQ(refusal_of_change("inertia_kg_m2 = [21.4, 21.4, 3.9]", "inertia_kg_m2 = [21.4, 21.4]"),
            "scene.toml:18: body.0.inertia_kg_m2 = [21.4, 21.4]: allowed: an array of 3 finite numbers > 0");
}

TEST(SceneReader, ANumberOutOfRangeIsRefused) {
  EXPECT_EQ(refusal_of_change("density_kg_m3 = 900", "density_kg_m3 = -900"),
            "scene.toml:9: ice.material.density_kg_m3 = -900: allowed: a finite number > 0");
  EXPECT_EQ(refusal_of_change("poisson_ratio = 0.33", "poisson_ratio = 0.5"),
            "scene.toml:10: ice.material.poisson_ratio = 0.5: allowed: a finite number >= 0 and < 0.5");
  EXPECT_EQ(refusal_of_change("angle_deg = 60", "angle_deg = 90.1"),
            "scene.toml:21: impact.angle_deg = 90.1: allowed: a finite number > 0 and <= 90");
}

TEST(SceneReader, EveryNumberMustBeFinite) {
  for (const char* value : {"nan", "-nan", "inf", "-inf"}) {
    const std::string shown = std::string(value) == "-nan" ? "nan" : value;
    const std::string message = refusal_of_change("end_time_s = 0.001", std::string("end_time_s = ") + value);
    EXPECT_NE(message.find("scene.toml:24: run.end_time_s = "), std::string::npos) << message;
    EXPECT_NE(message.find(shown + ": allowed: a finite number > 0"), std::string::npos) << message;
    EXPECT_NE(refusal(block_scene, {std::string("ice.velocity_m_s=[0, 0, ") + value + "]"}), "accepted");
  }
}

TEST(SceneReader, ASpacingLargerThanTheSheetIsRefused) {
  EXPECT_EQ(refusal_of_change("spacing_m = 0.05", "spacing_m = 0.31"),
            "scene.toml:6: ice.spacing_m = 0.31: allowed: at most the smallest dimension of the ice, 0.3");
}

TEST(SceneReader, ADirectionOfLengthZeroIsRefused) {
  EXPECT_EQ(refusal_of_change("speed_m_s = 100", "speed_m_s = 0"),
            "scene.toml:20: impact.speed_m_s = 0: allowed: a finite number > 0");
  EXPECT_EQ(refusal(with_body(ball + "density_kg_m3 = 1\nposition_m = [0, 0, 1]\naxis = [0, 0, 0]\n")),
            "scene.toml:12: body.0.axis = [0, 0, 0]: allowed: a direction, not the zero vector");
}

TEST(SceneReader, AnInertiaThatNoMatterCanHaveIsRefused) {
  const std::string message = refusal_of_change("[21.4, 21.4, 3.9]", "[1, 1, 3]");
  EXPECT_EQ(message.find("scene.toml:18: body.0.inertia_kg_m2 = [1, 1, 3]: "), 0u) << message;
}

TEST(SceneReader, AnInertiaThatNoMatterInsideTheBodyCanHaveIsNoted) {
  EXPECT_TRUE(read(oblique_scene()).notes.empty());
  const auto notes = read(replaced(oblique_scene(), "3.9]", "6.15]")).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].find("body body: "), 0u) << notes[0];
}

TEST(SceneReader, AnUnknownShapeIsRefused) {
  EXPECT_EQ(refusal_of_change("shape = \"disc\"", "shape = \"ring\""),
            "scene.toml:3: ice.shape = \"ring\": allowed: \"disc\", \"block\", \"sphere\"");
  EXPECT_EQ(refusal_of_change("shape = \"hcc\"", "shape = \"mesh\""),
            "scene.toml:12: body.0.shape = \"mesh\": allowed: \"hcc\", \"sphere\", \"box\", \"plate\", \"cylinder\", "
            "\"capsule\", \"cone\"");
}

TEST(SceneReader, CapsuleAndConeAreReadWithTheirLengthAndDiameter) {
  const std::string size = "diameter_m = 0.1\nlength_m = 0.4\ndensity_kg_m3 = 900\nposition_m = [0, 0, 5]\n";
  const auto capsule = read(with_body("shape = \"capsule\"\n" + size)).bodies[0];
  EXPECT_EQ(std::get<rigid::Capsule>(capsule.shape).length, 0.4);
  EXPECT_EQ(std::get<rigid::Capsule>(capsule.shape).diameter, 0.1);
  const auto cone = read(with_body("shape = \"cone\"\n" + size)).bodies[0];
  EXPECT_EQ(std::get<rigid::Cone>(cone.shape).length, 0.4);
  EXPECT_EQ(std::get<rigid::Cone>(cone.shape).diameter, 0.1);
  EXPECT_EQ(cone.mass.centre_of_mass, Vec3(0, 0, -0.1));  // a quarter of the height above the base
  EXPECT_EQ(refusal(with_body("shape = \"capsule\"\ndiameter_m = 0.5\nlength_m = 0.4\n")),
            "scene.toml:10: body.0.length_m = 0.4: allowed: a finite number >= 0.5");
}

TEST(SceneReader, AKeyOfAnotherShapeSaysSo) {
  EXPECT_EQ(refusal_of_change("fixed = \"rim\"", "size_m = [1, 1, 1]"),
            "scene.toml:7: ice.size_m = [1, 1, 1]: a size does not belong to shape = \"disc\"");
  EXPECT_EQ(refusal(with_body(ball + "nose_length_m = 0.1\n")),
            "scene.toml:10: body.0.nose_length_m = 0.1: does not belong to shape = \"sphere\"");
}

TEST(SceneReader, AMissingKeyNamesTheTableThatNeedsIt) {
  EXPECT_EQ(refusal_of_change("diameter_m = 1.2\n", ""),
            "scene.toml:2: ice.diameter_m (not given): needed; allowed: a finite number > 0");
  EXPECT_EQ(
      refusal_of_change("mass_kg = 174.1\ncentre_of_mass_from_tip_m = 0.9333\ninertia_kg_m2 = [21.4, 21.4, 3.9]\n", ""),
      "scene.toml:11: body.0.mass_kg (not given): needed, or density_kg_m3; allowed: a finite number > 0");
  EXPECT_EQ(refusal("title = \"no ice\"\n[run]\nend_time_s = 1\n"),
            "scene.toml:1: ice (not given): needed; allowed: a table [ice] or several [[ice]]");
}

TEST(SceneReader, AMissingFileIsOneLine) {
  const ScratchDirectory scratch;
  try {
    read_scene(scratch.path() / "none.toml", {});
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_EQ(error.what(), (scratch.path() / "none.toml").string() + ": no such file");
  }
}

TEST(SceneReader, ASyntaxErrorNamesItsLine) {
  EXPECT_EQ(refusal_of_change("thickness_m = 0.3", "thickness_m = ").substr(0, 24), "scene.toml:5: not TOML: ");
  EXPECT_EQ(refusal_of_change("thickness_m = 0.3", "diameter_m = 0.3").substr(0, 24), "scene.toml:5: not TOML: ");
}

TEST(SceneReader, PlasticityBelongsToDruckerPrager) {
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.model=elastic"}), "accepted");
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.model=elastic", "ice.material.cohesion_Pa=1e6"}),
            "--set: ice.material.cohesion_Pa = 1e+06: allowed only with model = \"drucker-prager\"");
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.residual_strength=0.5"}),
            "--set: ice.material.residual_strength = 0.5: allowed only with after_failure = \"softening\"");
}

TEST(SceneReader, HardeningBelongsToPlasticIce) {
  EXPECT_EQ(read(oblique_scene(), {"ice.material.after_failure=plastic", "ice.material.hardening_modulus_Pa=1e8"})
                .ice.material.hardening_modulus,
            1e8);
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.hardening_modulus_Pa=1e8"}),
            "--set: ice.material.hardening_modulus_Pa = 1e+08: allowed only with after_failure = \"plastic\"");
}

TEST(SceneReader, EveryModelHasKeysOfItsOwn) {
  EXPECT_EQ(read(oblique_scene(), {"ice.material.model=neo-hookean", "ice.material.kelvin_voigt=1"})
                .ice.material.kelvin_voigt,
            1);
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.kelvin_voigt=1"}),
            "--set: ice.material.kelvin_voigt = 1: allowed only with model = \"neo-hookean\"");
  EXPECT_EQ(read(oblique_scene(), {"ice.material.model=rate-dependent", "ice.material.rate_exponent=0.1"})
                .ice.material.rate_dependent.rate_exponent,
            0.1);
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.rate_exponent=0.1"}),
            "--set: ice.material.rate_exponent = 0.1: allowed only with model = \"rate-dependent\"");
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.preset=real-ice", "ice.material.cohesion_Pa=1e6"}),
            "--set: ice.material.cohesion_Pa = 1e+06: allowed only with model = \"drucker-prager\"");
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.preset=real-ice", "ice.material.pressure=density"}),
            "--set: ice.material.pressure = \"density\": allowed only with model = \"elastic\" or \"drucker-prager\"");
}

TEST(SceneReader, RealIceIsRateDependentWithTheElasticConstantsOfThePapersIce) {
  const auto ice = read(oblique_scene(), {"ice.material.preset=real-ice"}).ice;
  EXPECT_EQ(ice.material.model, sph::Model::rate_dependent);
  EXPECT_EQ(ice.material.young_modulus, 9.38e9);
  EXPECT_EQ(ice.material.rate_dependent, sph::RateDependentSpec{});
  EXPECT_EQ(ice_name(ice), "real-ice");
}

TEST(SceneReader, SoftenedIceKeepsItsStatedConstantsAndIsNamedSo) {
  const auto ice = read(oblique_scene(), {"ice.material.preset=real-ice", "numerics.sound_speed_scale=0.5"}).ice;
  EXPECT_EQ(ice.numerics.sound_speed_scale, 0.5);
  EXPECT_EQ(ice.material, real_ice());
  EXPECT_EQ(ice_name(ice), "real-ice, softened to 0.5 of its sound speeds");
  EXPECT_EQ(read(oblique_scene()).ice.numerics.sound_speed_scale, 1);
}

TEST(SceneReader, ReadsAQuietSpeedThatIsNotNegative) {
  EXPECT_EQ(read(oblique_scene()).ice.numerics.quiet_speed, 0);
  EXPECT_EQ(read(oblique_scene(), {"numerics.quiet_speed_m_s=1e-3"}).ice.numerics.quiet_speed, 1e-3);
  EXPECT_NE(refusal(oblique_scene(), {"numerics.quiet_speed_m_s=-1"}).find("numerics.quiet_speed_m_s"),
            std::string::npos);
}

TEST(SceneReader, RefusesASoundSpeedScaleOutsideZeroToOne) {
  for (const char* value : {"0", "-0.5", "1.1"})
    EXPECT_NE(refusal(oblique_scene(), {std::string("numerics.sound_speed_scale=") + value})
                  .find("allowed: a finite number > 0 and <= 1"),
              std::string::npos)
        << value;
}

/// How many entries of a scene's list of calibrations are about this key.
std::size_t calibrated(const Scene& scene, const std::string& key) {
  return static_cast<std::size_t>(std::count_if(scene.calibrated.begin(), scene.calibrated.end(),
                                                [&](const std::string& c) { return c.starts_with(key); }));
}

TEST(SceneReader, FittedConstantsOfTheIceAreAlwaysListedAndOnce) {
  EXPECT_EQ(calibrated(read(oblique_scene(), {"ice.material.preset=real-ice"}), "softening_slip_m"), 1u);
  EXPECT_EQ(calibrated(read(oblique_scene(), {"ice.material.preset=real-ice", "ice.material.softening_slip_m=1e-3"}),
                       "softening_slip_m"),
            0u);
  EXPECT_EQ(calibrated(read(oblique_scene()), "after_failure"), 1u);
  EXPECT_EQ(calibrated(read(oblique_scene(), {"ice.material.after_failure=plastic"}), "after_failure"), 0u);
  EXPECT_EQ(calibrated(read_scene(find_scene("hcc-90"), {}), "after_failure"), 1u);
  const Scene written = read(write_scene(read(oblique_scene(), {"ice.material.preset=real-ice"})));
  EXPECT_EQ(calibrated(written, "softening_slip_m"), 1u);
}

TEST(SceneReader, TheDilationAngleIsAtMostTheFrictionAngle) {
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.dilation_angle_deg=36"}), "accepted");
  EXPECT_EQ(refusal_of_change("poisson_ratio = 0.33", "dilation_angle_deg = 40"),
            "scene.toml:10: ice.material.dilation_angle_deg = 40: allowed: a finite number >= 0 and <= 36");
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.friction_angle_deg=5"}),
            "scene.toml:8: ice.material.dilation_angle_deg (not given): needed, the default of 12 is larger than "
            "friction_angle_deg; allowed: a finite number >= 0 and <= 5");
}

TEST(SceneReader, MassIsStatedOnce) {
  EXPECT_EQ(refusal_of_change("mass_kg = 174.1\n", "mass_kg = 174.1\ndensity_kg_m3 = 1500\n"),
            "scene.toml:17: body.0.density_kg_m3 = 1500: allowed: either density_kg_m3 or mass_kg, not both");
  EXPECT_EQ(refusal_of_change("mass_kg = 174.1\n", "density_kg_m3 = 1500\n"),
            "scene.toml:17: body.0.centre_of_mass_from_tip_m = 0.9333: allowed only together with mass_kg");
}

TEST(SceneReader, InertiaFromGeometryIsThatOfTheHomogeneousBody) {
  const auto body = read(replaced(oblique_scene(), "[21.4, 21.4, 3.9]", "\"from geometry\"")).bodies[0];
  EXPECT_EQ(body.mass.inertia, rigid::from_mass(body.shape, 174.1).inertia);
}

TEST(SceneReader, ABodyThatNoForceMovesNeedsNoMass) {
  EXPECT_EQ(refusal(with_body(ball + "motion = \"fixed\"\nposition_m = [0, 0, 1]\n")), "accepted");
  EXPECT_EQ(refusal(with_body(ball + "motion = \"fixed-path\"\nposition_m = [0, 0, 1]\n")), "accepted");
  EXPECT_NE(refusal(with_body(ball + "motion = \"free\"\nposition_m = [0, 0, 1]\n")), "accepted");
}

TEST(SceneReader, AFixedBodyHasNoVelocity) {
  EXPECT_EQ(refusal(with_body(ball + "motion = \"fixed\"\nposition_m = [0, 0, 1]\nvelocity_m_s = [0, 0, 1]\n")),
            "scene.toml:12: body.0.velocity_m_s = [0, 0, 1]: allowed: none, a fixed body is at rest");
}

TEST(SceneReader, ABodyIsPlacedOnce) {
  EXPECT_EQ(refusal_of_change("length_m = 1.8\ndiameter", "length_m = 1.8\nposition_m = [0, 0, -2]\ndiameter"),
            "scene.toml:14: body.0.position_m = [0, 0, -2]: [impact] places this body; allowed: one of the two");
}

TEST(SceneReader, ImpactNeedsABodyThatMovesAndASheet) {
  EXPECT_EQ(refusal(block_scene + "[impact]\nspeed_m_s = 1\nangle_deg = 90\ngap_m = 0\n"),
            "scene.toml:7: impact = {...}: needs a [[body]] whose motion is not \"fixed\"");
  const std::string sphere = "shape = \"sphere\"\ndiameter_m = 1.2\n";
  EXPECT_EQ(refusal(replaced(replaced(oblique_scene(), "fixed = \"rim\"\n", ""),
                             "shape = \"disc\"\ndiameter_m = 1.2\nthickness_m = 0.3\n", sphere)),
            "scene.toml:17: impact = {...}: allowed under a disc or block of ice only");
}

TEST(SceneReader, BodiesHaveDifferentPlainNames) {
  const std::string fixed = "motion = \"fixed\"\nposition_m = [0, 0, 1]\n";
  EXPECT_EQ(refusal(with_body(ball + fixed + "name = \"a\"\n[[body]]\nname = \"a\"\n" + ball + fixed)),
            "scene.toml:14: body.1.name = \"a\": allowed: a name that no other body has; \"a\" is taken");
  EXPECT_EQ(refusal(with_body("name = \"a/b\"\n" + ball + fixed)),
            "scene.toml:8: body.0.name = \"a/b\": allowed: letters, digits, - and _");
}

TEST(SceneReader, FixedPartsAreTheRimOfADiscOrFaces) {
  const auto faces = read(block_scene, {"ice.fixed=[\"x-\", \"z+\"]"}).ice.pieces[0].fixed.faces;
  EXPECT_EQ(faces, (std::array{true, false, false, false, false, true}));
  EXPECT_EQ(read(block_scene, {"ice.fixed=bottom"}).ice.pieces[0].fixed.faces,
            (std::array{false, false, false, false, true, false}));
  EXPECT_EQ(read(block_scene, {"ice.fixed=none"}).ice.pieces[0].fixed.faces, (std::array<bool, 6>{}));
  EXPECT_NE(refusal(block_scene, {"ice.fixed=rim"}), "accepted");
  EXPECT_NE(refusal(block_scene, {"ice.fixed=[\"none\", \"x-\"]"}), "accepted");
}

TEST(SceneReader, APeriodicAxisIsAWholeNumberOfSpacingsAndWiderThanTheKernel) {
  EXPECT_EQ(read(block_scene, {"ice.periodic=[\"y\"]", "numerics.smoothing_ratio=1.3"}).ice.periodic,
            (std::array{false, true, false}));
  EXPECT_NE(
      refusal(block_scene, {"ice.periodic=[\"y\"]", "numerics.smoothing_ratio=1.3", "ice.size_m=[0.4, 0.065, 0.06]"}),
      "accepted");
  EXPECT_NE(
      refusal(block_scene, {"ice.periodic=[\"y\"]", "numerics.smoothing_ratio=1.3", "ice.size_m=[0.4, 0.05, 0.06]"}),
      "accepted");
  EXPECT_NE(refusal(block_scene, {"ice.periodic=[\"y\"]", "numerics.smoothing_ratio=1.4"}), "accepted");
  EXPECT_NE(refusal(oblique_scene(), {"ice.periodic=[\"y\"]"}), "accepted");
  EXPECT_NE(refusal(block_scene, {"ice.periodic=[\"w\"]"}), "accepted");
}

TEST(SceneReader, HourglassControlNeedsTheGradientCorrection) {
  EXPECT_EQ(read(block_scene, {"numerics.hourglass_control=1", "numerics.gradient_correction=true"})
                .ice.numerics.hourglass_control,
            1);
  EXPECT_NE(refusal(block_scene, {"numerics.hourglass_control=1", "numerics.gradient_correction=false"}), "accepted");
}

TEST(SceneReader, SeveralPiecesShareSpacingAndMaterial) {
  const std::string first =
      "[[ice]]\nshape = \"sphere\"\ndiameter_m = 1\nspacing_m = 0.1\n[ice.material]\nmodel = \"elastic\"\n";
  const std::string second = "[[ice]]\nshape = \"block\"\nsize_m = [1, 1, 1]\ncentre_m = [2, 0, 0]\n";
  const std::string run = "[run]\nend_time_s = 1\n";
  const Scene scene = read(first + second + run);
  ASSERT_EQ(scene.ice.pieces.size(), 2u);
  EXPECT_EQ(scene.ice.pieces[1].centre, Vec3(2, 0, 0));
  EXPECT_EQ(scene.ice.material.model, sph::Model::elastic);
  EXPECT_EQ(refusal(first + second + "spacing_m = 0.1\n[ice.material]\nmodel = \"elastic\"\n" + run), "accepted");
  EXPECT_EQ(refusal(first + second + "spacing_m = 0.2\n" + run),
            "scene.toml:11: ice.1.spacing_m = 0.2: allowed: the spacing of the first piece, 0.1");
  EXPECT_EQ(refusal(first + second + "[ice.material]\n" + run),
            "scene.toml:11: ice.1.material = {...}: allowed: the material of the first piece");
}

// --set

TEST(SceneReader, OverridesReplaceAndAddKeys) {
  const Scene scene = read(oblique_scene(), {"body.0.mass_kg=50", "numerics.cfl=0.3", "ice.fixed=bottom",
                                             "ice.centre_m=[1, 2, 3]", "title=\"two = words\""});
  EXPECT_EQ(scene.bodies[0].mass.mass, 50);
  EXPECT_EQ(scene.ice.numerics.cfl, 0.3);
  EXPECT_FALSE(scene.ice.pieces[0].fixed.rim);
  EXPECT_EQ(scene.ice.pieces[0].centre, Vec3(1, 2, 3));
  EXPECT_EQ(scene.title, "two = words");
}

TEST(SceneReader, ALaterOverrideWins) {
  EXPECT_EQ(read(oblique_scene(), {"numerics.cfl=0.3", "numerics.cfl=0.4"}).ice.numerics.cfl, 0.4);
}

TEST(SceneReader, AnOverridingElementOfAnArrayIsNamedByItsIndex) {
  EXPECT_EQ(read(oblique_scene(), {"body.0.inertia_kg_m2.2=3.8"}).bodies[0].mass.inertia, Vec3(21.4, 21.4, 3.8));
  for (const char* wrong : {"body.1.mass_kg=50", "body.x.mass_kg=50", "body.mass_kg=50", "body.-1.mass_kg=50"})
    EXPECT_EQ(refusal(oblique_scene(), {wrong}).find(std::string("--set: ") + wrong), 0u) << wrong;
}

TEST(SceneReader, MistakesInOverridesAreLocatedThere) {
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.poisson_ratio=0.5"}),
            "--set: ice.material.poisson_ratio = 0.5: allowed: a finite number >= 0 and < 0.5");
  EXPECT_EQ(refusal(oblique_scene(), {"ice.material.density=900"}),
            "--set: ice.material.density = 900: unknown key, the nearest known one is density_kg_m3");
  EXPECT_EQ(refusal(oblique_scene(), {"numeric.cfl=0.3"}),
            "--set: numeric = {...}: unknown key, the nearest known one is numerics");
  for (const char* wrong : {"", "=", "cfl", ".=1", "numerics.=1", "numerics..cfl=1", "numerics.cfl=", "title=two words",
                            "title.x=1", "title.x.y=1", "numerics.cfl=1\nskin_ratio=2"})
    EXPECT_EQ(refusal(oblique_scene(), {wrong}).find("--set: "), 0u) << wrong;
}

TEST(SceneFiles, EveryShippedSceneIsFoundByNameAndHasATitle) {
  const auto scenes = shipped_scenes();
  EXPECT_GE(scenes.size(), 14u);
  for (const auto& scene : scenes) {
    EXPECT_FALSE(scene.title.empty()) << scene.name;
    EXPECT_EQ(read_scene(find_scene(scene.name), {}).title, scene.title);
  }
}

TEST(SceneFiles, AMistypedNameIsAnsweredWithTheNearestScene) {
  try {
    find_scene("hcc-obliqe");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_STREQ(error.what(), "hcc-obliqe: no such file or shipped scene; the nearest shipped scene is hcc-oblique");
  }
}

TEST(SceneFiles, ThePrintedInertiaIsNotedAndTheHomogeneousBodyIsTheTrueOne) {
  EXPECT_EQ(read_scene(find_scene("cai-2025-90"), {}).notes.size(), 1u);
  const Scene scene = read_scene(find_scene("hcc-90"), {});
  EXPECT_TRUE(scene.notes.empty());
  const auto& mass = scene.bodies[0].mass;  // figures from the volume integrals of the printed geometry
  EXPECT_NEAR(mass.mass, 183.783, 5e-4);
  EXPECT_NEAR(-mass.centre_of_mass.z(), 0.932692, 5e-7);
  EXPECT_NEAR(mass.inertia.x(), 47.234, 5e-4);
  EXPECT_NEAR(mass.inertia.z(), 2.0358, 5e-5);
}

}  // namespace
}  // namespace nilas::cases
