#include "cases/domain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "cases/domain_check.hpp"
#include "sph/lattice.hpp"
#include "tests/support/process.hpp"
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

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read(text, overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

sph::PieceSpec sheet(double thickness, const Vec3& centre = Vec3::Zero()) {
  sph::PieceSpec disc;
  disc.diameter = 10;
  disc.thickness = thickness;
  disc.centre = centre;
  return disc;
}

rigid::BodySpec ball(double diameter, const Vec3& position, const Vec3& velocity) {
  rigid::BodySpec body;
  body.shape = rigid::Sphere{diameter};
  body.boundary_spacing = 0.02 * diameter;
  body.mass = rigid::from_density(body.shape, 900);
  body.position = position;
  body.velocity = velocity;
  return body;
}

// The centre goes from the sheet's lower face to its upper one over thickness / tan(angle); the ball's equator follows.
TEST(Passage, OfABallEndsWhereTheBallLeavesTheSheet) {
  const Vec3 centre(1, 2, 3);
  const double a = 0.15, t = 0.3;
  const auto of = [&](const Vec3& from, const Vec3& velocity, double end) {
    return passage(sheet(t, centre), {ball(2 * a, centre + from, velocity)}, end);
  };
  EXPECT_NEAR(of({0, 0, -1}, {0, 0, 100}, 1).reach, a, 1e-3);
  EXPECT_NEAR(of({0, 0, -1}, {0, 0, 100}, 1).half_width, a, 1e-3);
  EXPECT_NEAR(of({0, 0.5, -1}, {0, 0, 100}, 1).reach, 0.5 + a, 1e-3);
  // At 45 degrees the point of the ball's side that leaves last through the upper face: y = z - 1 - a sqrt(2) at worst
  // on the near side at the lower face, and on the far side at the upper face z = t/2.
  const double far = 0.5 * t + a * std::sqrt(2);
  EXPECT_NEAR(of({0, -1, -1}, {0, 70, 70}, 1).reach, far, 2e-3);
  EXPECT_NEAR(of({0, -1, -1}, {0, 70, 70}, 1).half_width, a, 1e-3);
}

TEST(Passage, CountsOnlyWhatEntersBeforeTheEnd) {
  const auto of = [&](double end) { return passage(sheet(0.3), {ball(0.3, {0, 0, -1}, {0, 0, 100})}, end); };
  EXPECT_EQ(of(6.9e-3).reach, 0);  // the ball's top is at -0.85 and reaches -0.15 after 7 ms
  EXPECT_EQ(of(6.9e-3).half_width, 0);
  // 0.05 m deep: a cap of that height.
  EXPECT_NEAR(of(7.5e-3).reach, std::sqrt(0.15 * 0.15 - 0.1 * 0.1), 3e-3);
  EXPECT_EQ(passage(sheet(0.3), {ball(0.3, {0, 0, -1}, {0, 0, -100})}, 1).reach, 0);
}

TEST(Domain, IsReachTwoHalfWidthsAThicknessAndTheRim) {
  const Scene scene = read(oblique_scene(), {"ice.diameter_m=4.8", "impact.angle_deg=90", "run.end_time_s=0.006"});
  // HCC of radius 0.15 m, 0.3 m of ice, kernel radius 2 x 1.3 x 0.05 m.
  EXPECT_NEAR(domain_diameter(scene), 2 * (0.15 + 0.3 + 0.3 + 0.13), 1e-9);
}

TEST(Domain, KeepsParticlesOfTheWholeSheetAndAllWithinItsRadius) {
  for (const char* spacing : {"0.05", "0.048", "0.07"}) {
    const std::vector<std::string> sets{"ice.diameter_m=3", std::string("ice.spacing_m=") + spacing};
    const Scene whole = read(oblique_scene(), sets);
    auto with_domain = sets;
    with_domain.push_back("ice.domain=auto");
    const Scene part = read(oblique_scene(), with_domain);
    ASSERT_LT(part.ice.pieces[0].diameter, 3);
    EXPECT_GE(part.ice.pieces[0].diameter, domain_diameter(part) * (1 - 1e-12));
    const auto positions = [](const Scene& scene, double within) {
      std::set<std::array<double, 3>> all;
      for (const sph::Motion& m : sph::lattice(scene.ice).motion)
        if (m.position.head<2>().norm() <= within) all.insert({m.position.x(), m.position.y(), m.position.z()});
      return all;
    };
    EXPECT_EQ(positions(part, 10), positions(whole, 0.5 * part.ice.pieces[0].diameter));
  }
}

TEST(Domain, IsTheWholeSheetWhereThatIsNotLarger) {
  const Scene scene = read(oblique_scene(), {"ice.domain=auto"});
  EXPECT_EQ(scene.ice.pieces[0].diameter, 1.2);
  EXPECT_TRUE(scene.ice.pieces[0].fixed.rim);
  EXPECT_FALSE(scene.ice.pieces[0].absorbing_rim);
}

TEST(Domain, IsFullUnlessTheSceneAsks) {
  const Scene scene = read(oblique_scene(), {"ice.diameter_m=4.8"});
  EXPECT_FALSE(scene.whole_sheet);
  EXPECT_EQ(scene.ice.pieces[0].diameter, 4.8);
  EXPECT_EQ(refusal(oblique_scene(), {"ice.domain_diameter_m=1"}),
            "--set: ice.domain_diameter_m = 1: belongs to domain = \"auto\"");
}

TEST(Domain, IsRefusedForIceThatItIsNotMadeFor) {
  const std::string allowed =
      "--set: ice.domain = \"auto\": allowed: for a single solid disc at rest without gravity, fixed = \"rim\" or "
      "\"none\"; \"full\" "
      "for other ice";
  const std::string domain = "ice.domain=auto";
  EXPECT_EQ(refusal(oblique_scene(), {domain, "ice.fixed=bottom"}), allowed);
  EXPECT_EQ(refusal(oblique_scene(), {domain, "ice.inner_diameter_m=0.2"}), allowed);
  EXPECT_EQ(refusal(oblique_scene(), {domain, "ice.velocity_m_s=[0, 0, -1]"}), allowed);
  const std::string block =
      "[ice]\nshape = \"block\"\nsize_m = [0.7, 0.7, 0.7]\nspacing_m = 0.1\n[run]\nend_time_s = 1\n";
  EXPECT_EQ(refusal(block, {domain}), allowed);
  const std::string two =
      "[[ice]]\nshape = \"disc\"\ndiameter_m = 1\nthickness_m = 0.3\nspacing_m = 0.1\ndomain = \"auto\"\n"
      "[[ice]]\nshape = \"sphere\"\ndiameter_m = 0.3\ncentre_m = [0, 0, 2]\n[run]\nend_time_s = 1\n";
  EXPECT_NE(refusal(two).find("scene.toml:6: ice.0.domain = \"auto\": allowed: for a single"), std::string::npos)
      << refusal(two);
  EXPECT_EQ(refusal(oblique_scene(), {"ice.domain=wide"}), "--set: ice.domain = \"wide\": allowed: \"full\", \"auto\"");
}

TEST(Domain, IsRefusedWhereNoBodyEntersTheSheet) {
  const std::string allowed =
      "--set: ice.domain = \"auto\": allowed: if a body enters the sheet before run.end_time_s; else \"full\"";
  EXPECT_EQ(refusal(oblique_scene(), {"ice.domain=auto", "run.end_time_s=1e-4"}), allowed);
}

TEST(Domain, IsRefusedWhereItsRimWouldLieInTheHole) {
  const std::string why =
      refusal(oblique_scene(), {"ice.domain=auto", "ice.diameter_m=4.8", "ice.domain_diameter_m=0.4"});
  EXPECT_TRUE(why.starts_with("--set: ice.domain_diameter_m = 0.4: allowed: a finite number > 0.5")) << why;
}

// The tolerances, at a spacing that takes seconds.
TEST(DomainCheck, ACutSheetGivesTheForceOfTwiceItsDomain) {
  const ScratchDirectory scratch;
  const auto result = test::run_process(
      {NILAS_BINARY, "run", "cai-2025-90", "--set", "ice.domain=auto", "--set", "ice.spacing_m=0.05", "--set",
       "body.0.spacing_m=0.0375", "--set", "run.end_time_s=0.0015", "--out", "out", "--check-domain"},
      scratch.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::ifstream file(scratch.path() / "out/domain-check.json");
  const auto check = nlohmann::json::parse(file);
  EXPECT_NEAR(check["diameter_m"][1].get<double>(), 2 * check["diameter_m"][0].get<double>(), 0.1);
  const auto& hcc = check["bodies"]["hcc"];
  EXPECT_LT(std::abs(hcc["peak_difference"].get<double>()), 0.01);
  EXPECT_LT(std::abs(hcc["impulse_difference"].get<double>()), 0.02);
  EXPECT_NE(result.out.find("within the bounds"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("bounds on what the cut changes"), std::string::npos);

  std::ifstream summary_file(scratch.path() / "out/summary.json");
  const auto summary = nlohmann::json::parse(summary_file);
  const auto& domain = summary["domain"];
  EXPECT_EQ(domain["kind"], "auto");
  EXPECT_EQ(domain["whole_diameter_m"], 4.8);
  EXPECT_GT(domain["out_energy_J"], 0);
  EXPECT_LT(domain["out_energy_J"], domain["exchanged_energy_J"]);
  EXPECT_EQ(domain["out_energy_J"], summary["energy_J"]["absorbed"]);
  EXPECT_EQ(domain["peak_bound"], check["peak_bound"]);
  // What the ice gave back is in the kinetic energy that the body, which is free, has lost.
  const double lost = 0.5 * 174.1 * (1e4 - std::pow(summary["final_velocity_m_s"][2].get<double>(), 2));
  EXPECT_NEAR(domain["exchanged_energy_J"].get<double>(), lost, 1e-6 * lost);
}

// The bound is of use only if it holds where the domain is too small, too.
TEST(DomainCheck, TheBoundHoldsWhereTheCutIsTooClose) {
  const ScratchDirectory scratch;
  const auto result =
      test::run_process({NILAS_BINARY, "run", "cai-2025-90", "--set", "ice.domain=auto", "--set",
                         "ice.domain_diameter_m=0.7", "--set", "ice.spacing_m=0.05", "--set", "body.0.spacing_m=0.0375",
                         "--set", "run.end_time_s=0.002", "--out", "out", "--check-domain"},
                        scratch.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::ifstream file(scratch.path() / "out/domain-check.json");
  const auto check = nlohmann::json::parse(file);
  const auto& hcc = check["bodies"]["hcc"];
  EXPECT_GT(std::abs(hcc["impulse_difference"].get<double>()), 0.02);
  EXPECT_LT(std::abs(hcc["peak_difference"].get<double>()), check["peak_bound"].get<double>());
  EXPECT_LT(std::abs(hcc["impulse_difference"].get<double>()), check["impulse_bound"].get<double>());
}

TEST(DomainCheck, IsRefusedWhereNothingIsCutAway) {
  const ScratchDirectory scratch;
  scratch.write("scene.toml", oblique_scene());
  const auto result = test::run_process({NILAS_BINARY, "run", "scene.toml", "--check-domain"}, scratch.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("ice.domain = \"auto\""), std::string::npos) << result.err;
}

TEST(DomainCheck, ARunWithoutACutSaysSo) {
  const DomainCheck check(read(oblique_scene()));
  EXPECT_EQ(describe(check.report({}, 0)), "");
  const DomainCheck whole(read(oblique_scene(), {"ice.domain=auto"}));
  EXPECT_EQ(describe(whole.report({}, 0)), "domain: the whole sheet, nothing left out\n");
}

}  // namespace
}  // namespace nilas::cases
