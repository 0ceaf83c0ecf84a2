// Runs the built program, NILAS_BINARY.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "cases/scene.hpp"
#include "tests/support/process.hpp"
#include "tests/support/scene_text.hpp"
#include "tests/support/scratch_directory.hpp"

namespace nilas::cases {
namespace {

using test::oblique_scene;
using test::ProcessResult;
using test::replaced;
using test::ScratchDirectory;

class CommandLine : public testing::Test {
 protected:
  ProcessResult nilas(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), NILAS_BINARY);
    return test::run_process(arguments, scratch.path());
  }

  /// `run` and `check` both refuse: exit code 2, exactly one line on stderr holding every part, nothing written.
  void expect_refusal(const std::string& scene, const std::vector<std::string>& parts,
                      const std::vector<std::string>& overrides = {}) const {
    scratch.write("scene.toml", scene);
    for (const char* command : {"check", "run"}) {
      std::vector<std::string> arguments{command, "scene.toml"};
      for (const auto& text : overrides) arguments.insert(arguments.end(), {"--set", text});
      const auto result = nilas(arguments);
      EXPECT_EQ(result.exit_code, 2) << command << ": " << result.err;
      expect_one_line(result.err, parts);
      EXPECT_EQ(files(), std::set<std::string>{"scene.toml"}) << command;
    }
  }

  static void expect_one_line(const std::string& err, const std::vector<std::string>& parts) {
    EXPECT_EQ(err.find("nilas: "), 0u) << err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    EXPECT_EQ(err.empty() ? ' ' : err.back(), '\n') << err;
    for (const auto& part : parts) EXPECT_NE(err.find(part), std::string::npos) << part << " in: " << err;
  }

  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch.path()))
      names.insert(entry.path().lexically_relative(scratch.path()).string());
    return names;
  }

  const ScratchDirectory scratch;
};

TEST_F(CommandLine, RefusesAnUnknownKeyAndNamesTheNearest) {
  expect_refusal(replaced(oblique_scene(), "fixed = \"rim\"", "fixd = \"rim\""),
                 {"scene.toml:7: ", "ice.fixd = \"rim\"", "nearest known one is fixed"});
}

TEST_F(CommandLine, RefusesAWrongType) {
  expect_refusal(replaced(oblique_scene(), "diameter_m = 1.2", "diameter_m = \"wide\""),
                 {"scene.toml:4: ", "ice.diameter_m = \"wide\"", "allowed: a finite number > 0"});
}

TEST_F(CommandLine, RefusesANegativeDensity) {
  expect_refusal(replaced(oblique_scene(), "density_kg_m3 = 900", "density_kg_m3 = -900"),
                 {"scene.toml:9: ", "ice.material.density_kg_m3 = -900", "allowed: a finite number > 0"});
}

TEST_F(CommandLine, RefusesAnIncompressiblePoissonRatio) {
  expect_refusal(replaced(oblique_scene(), "poisson_ratio = 0.33", "poisson_ratio = 0.5"),
                 {"scene.toml:10: ", "ice.material.poisson_ratio = 0.5", ">= 0 and < 0.5"});
}

TEST_F(CommandLine, RefusesASpacingLargerThanTheSheet) {
  expect_refusal(replaced(oblique_scene(), "spacing_m = 0.05", "spacing_m = 0.5"),
                 {"scene.toml:6: ", "ice.spacing_m = 0.5", "allowed: at most", "0.3"});
}

TEST_F(CommandLine, RefusesAZeroSpeed) {
  expect_refusal(replaced(oblique_scene(), "speed_m_s = 100", "speed_m_s = 0"),
                 {"scene.toml:20: ", "impact.speed_m_s = 0", "allowed: a finite number > 0"});
}

TEST_F(CommandLine, RefusesAZeroAxis) {
  const std::string placed = "position_m = [0, 0, -2]\naxis = [0, 0, 0]\n";
  std::string scene = replaced(oblique_scene(), "[impact]\nspeed_m_s = 100\nangle_deg = 60\ngap_m = 0.02\n", "");
  scene = replaced(scene, "shape = \"hcc\"\n", "shape = \"hcc\"\n" + placed);
  expect_refusal(scene, {"scene.toml:14: ", "body.0.axis = [0, 0, 0]", "allowed: a direction"});
}

TEST_F(CommandLine, RefusesNaN) {
  expect_refusal(replaced(oblique_scene(), "thickness_m = 0.3", "thickness_m = nan"),
                 {"scene.toml:5: ", "ice.thickness_m = nan", "allowed: a finite number > 0"});
}

TEST_F(CommandLine, RefusesAnInertiaThatViolatesTheTriangleInequality) {
  expect_refusal(replaced(oblique_scene(), "[21.4, 21.4, 3.9]", "[1, 1, 3]"),
                 {"scene.toml:18: ", "body.0.inertia_kg_m2 = [1, 1, 3]"});
}

TEST_F(CommandLine, RefusesAnUnknownShape) {
  expect_refusal(replaced(oblique_scene(), "shape = \"disc\"", "shape = \"ring\""),
                 {"scene.toml:3: ", "ice.shape = \"ring\"", "allowed: \"disc\", \"block\", \"sphere\""});
}

TEST_F(CommandLine, RefusesASceneThatNeedsMoreMemoryThanTheMachineHas) {
  expect_refusal(replaced(oblique_scene(), "spacing_m = 0.05", "spacing_m = 1e-4"),
                 {"scene.toml:6: ", "spacing_m = 0.0001", "GB; allowed: "});
}

TEST_F(CommandLine, RefusesABodyTooLightForOneExchangeAndNamesTheOption) {
  const std::string scene = replaced(oblique_scene(), "inertia_kg_m2 = [21.4, 21.4, 3.9]\n", "");
  expect_refusal(replaced(scene, "mass_kg = 174.1", "mass_kg = 1"),
                 {"scene.toml:11: ", "coupling-stability number ", "allowed: numerics.max_coupling_number = 1"});
}

TEST_F(CommandLine, RefusesIceInsideABodyAndSaysWhatToMove) {
  const std::string placed = "position_m = [0, 0, -0.6]\n";  // the nose ends 0.18 m above the sheet's lower face
  std::string scene = replaced(oblique_scene(), "[impact]\nspeed_m_s = 100\nangle_deg = 60\ngap_m = 0.02\n", "");
  scene = replaced(scene, "shape = \"hcc\"\n", "shape = \"hcc\"\n" + placed);
  expect_refusal(scene, {"scene.toml:13: ", "body.0", "start inside it", "position_m"});
}

TEST_F(CommandLine, RefusesARunThatWouldNeverEnd) {
  expect_refusal(oblique_scene(), {"run.end_time_s = 0.001", "steps of ", "limited by "}, {"numerics.cfl=1e-300"});
}

TEST_F(CommandLine, AShortRunThatMadeEnergyFailsHoweverFewItsSteps) {
  const auto result = nilas({"run", "hcc-oblique", "--out", "out", "--set", "ice.diameter_m=0.8625", "--set",
                             "ice.spacing_m=0.0375", "--set", "impact.gap_m=0.001", "--set", "run.end_time_s=1e-4",
                             "--set", "body.0.mass_kg=0.01", "--set", "numerics.max_coupling_number=1e9"});
  EXPECT_EQ(result.exit_code, 3);
  expect_one_line(result.err, {"the ledger of energy does not close", "numerics.max_coupling_number"});
  EXPECT_TRUE(files().contains("out/dump.txt"));
}

TEST_F(CommandLine, ARunWhoseContactLeaksStops) {
  const auto result = nilas({"run", "hcc-oblique", "--out", "out", "--set", "ice.diameter_m=0.8625", "--set",
                             "ice.spacing_m=0.0375", "--set", "body.0.angular_velocity_rad_s=[-10000,0,0]"});
  EXPECT_EQ(result.exit_code, 3);
  expect_one_line(result.err, {"inside a body", "more than a spacing", "contact.stiffness"});
  EXPECT_TRUE(files().contains("out/dump.txt"));
}

TEST_F(CommandLine, RefusesAnUnknownOverride) {
  expect_refusal(oblique_scene(), {"--set: ", "numerics.clf = 0.3", "nearest known one is cfl"}, {"numerics.clf=0.3"});
}

TEST_F(CommandLine, RefusesAMissingFile) {
  for (const char* command : {"check", "run"}) {
    const auto result = nilas({command, "missing.toml"});
    EXPECT_EQ(result.exit_code, 2);
    expect_one_line(result.err, {"missing.toml: no such file"});
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(CommandLine, WrongUsageIsBadInput) {
  const std::vector<std::vector<std::string>> wrong = {{},
                                                       {"walk"},
                                                       {"run"},
                                                       {"run", "hcc-oblique", "--fast"},
                                                       {"run", "hcc-oblique", "--threads", "none"},
                                                       {"run", "hcc-oblique", "--threads", "0"},
                                                       {"run", "hcc-oblique", "hcc-60"},
                                                       {"compare"},
                                                       {"plot"},
                                                       {"plot", "a", "b"},
                                                       {"list", "a"}};
  for (const auto& arguments : wrong) {
    const auto result = nilas(arguments);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments);
    expect_one_line(result.err, {});
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(CommandLine, HelpAndVersionAreNotErrors) {
  for (const char* option : {"--help", "--version"}) {
    const auto result = nilas({option});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_FALSE(result.out.empty());
    EXPECT_TRUE(result.err.empty());
  }
}

TEST_F(CommandLine, ListsEveryShippedScene) {
  const auto result = nilas({"list"});
  EXPECT_EQ(result.exit_code, 0);
  for (const auto& scene : shipped_scenes()) {
    EXPECT_NE(result.out.find(scene.name + " "), std::string::npos) << scene.name;
    EXPECT_NE(result.out.find(scene.title), std::string::npos) << scene.name;
  }
}

TEST_F(CommandLine, ChecksAShippedSceneByNameAndWritesNothing) {
  const auto result = nilas({"check", "hcc-oblique", "--set", "run.end_time_s=1e-4"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("particles"), std::string::npos);
  EXPECT_TRUE(files().empty());
}

TEST_F(CommandLine, AnExistingRunDirectoryIsOverwrittenOnlyByForce) {
  scratch.write("scene.toml", oblique_scene());
  std::filesystem::create_directory(scratch.path() / "out");
  scratch.write("out/summary.json", "precious");
  const std::vector<std::string> run = {"run", "scene.toml", "--out", "out", "--set", "run.end_time_s=1e-6"};
  const auto refused = nilas(run);
  EXPECT_EQ(refused.exit_code, 2);
  expect_one_line(refused.err, {"out"});
  EXPECT_EQ(files(), (std::set<std::string>{"scene.toml", "out", "out/summary.json"}));

  auto forced = run;
  forced.push_back("--force");
  EXPECT_EQ(nilas(forced).exit_code, 0);
  EXPECT_TRUE(files().contains("out/scene.toml"));
}

TEST_F(CommandLine, TheRunDirectoryIsNamedAfterTheScene) {
  scratch.write("small.toml", oblique_scene());
  EXPECT_EQ(nilas({"run", "small.toml", "--threads", "1", "--set", "run.end_time_s=1e-6"}).exit_code, 0);
  EXPECT_TRUE(files().contains("runs/small/scene.toml"));
}

TEST_F(CommandLine, ARunWritesItsDirectoryAndItsFilledInSceneGivesTheSameResult) {
  scratch.write("scene.toml", oblique_scene());
  const auto first = nilas({"run", "scene.toml", "--out", "first", "--threads", "1", "--set", "run.end_time_s=4e-4"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  for (const char* name :
       {"summary.json", "history.csv", "loads.csv", "result.h5", "result.xmf", "scene.toml", "log.txt"})
    EXPECT_TRUE(files().contains(std::string("first/") + name)) << name;

  const auto second = nilas({"run", "first/scene.toml", "--out", "second", "--threads", "2"});
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(scratch.read("first/scene.toml"), scratch.read("second/scene.toml"));
  EXPECT_EQ(scratch.read("first/history.csv"), scratch.read("second/history.csv"));
  EXPECT_EQ(scratch.read("first/loads.csv"), scratch.read("second/loads.csv"));
}

TEST_F(CommandLine, ASummaryHoldsEveryPromisedKey) {
  scratch.write("scene.toml", oblique_scene());
  ASSERT_EQ(nilas({"run", "scene.toml", "--out", "out", "--set", "run.end_time_s=3e-4"}).exit_code, 0);
  const auto summary = nlohmann::json::parse(scratch.read("out/summary.json"));
  for (const char* key : {"particles",
                          "boundary_particles",
                          "steps",
                          "simulated_time_s",
                          "wall_time_s",
                          "particle_steps_per_s",
                          "peak_rss_bytes",
                          "peak_force_N",
                          "peak_force_filtered_N",
                          "force_window_s",
                          "sound_speed_scale",
                          "quiet_speed_m_s",
                          "asleep_fraction",
                          "peak_force_time_s",
                          "peak_force_components_N",
                          "impulse_N_s",
                          "final_position_m",
                          "final_velocity_m_s",
                          "final_angular_velocity_rad_s",
                          "attitude_change_deg",
                          "momentum_residual",
                          "angular_momentum_residual",
                          "energy_residual",
                          "max_penetration_m",
                          "failed_fraction",
                          "coupling_stability_number",
                          "terms_left_out",
                          "stopped_by"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_EQ(summary["stopped_by"], "end time reached");
  EXPECT_GT(summary["peak_force_N"], 0);
  EXPECT_LT(summary["momentum_residual"], 1e-10);
}

TEST_F(CommandLine, CheckAndLogSayThatQuietIceSleepsOrWhyItDoesNot) {
  scratch.write("scene.toml", oblique_scene());
  const std::vector<std::string> quiet = {"scene.toml", "--set", "numerics.quiet_speed_m_s=1e-3"};
  const std::string sleeps = "sleeps until something faster than 0.001 m/s reaches it", without = "without effect";
  const auto check = nilas({"check", quiet[0], quiet[1], quiet[2]});
  EXPECT_NE(check.out.find(sleeps), std::string::npos) << check.out;
  const auto heavy = nilas({"check", quiet[0], quiet[1], quiet[2], "--set", "run.gravity_m_s2=[0,0,-9.81]"});
  EXPECT_EQ(heavy.out.find(sleeps), std::string::npos) << heavy.out;
  EXPECT_NE(heavy.out.find("numerics.quiet_speed_m_s is " + without), std::string::npos) << heavy.out;

  const auto run = nilas({"run", quiet[0], quiet[1], quiet[2], "--out", "out", "--set", "run.end_time_s=4e-4"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(scratch.read("out/log.txt").find(sleeps), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(scratch.read("out/summary.json"))["quiet_speed_m_s"], 1e-3);
}

TEST_F(CommandLine, ARunOfSoftenedIceSaysSoWhereverItGivesAForce) {
  scratch.write("scene.toml", oblique_scene());
  const std::vector<std::string> scene = {"scene.toml", "--set", "numerics.sound_speed_scale=0.5"};
  const std::string name = ", softened to 0.5 of its sound speeds", note = "the ice is softened for a larger step";

  const auto check = nilas({"check", scene[0], scene[1], scene[2]});
  for (const std::string& part : {name, note}) EXPECT_NE(check.out.find(part), std::string::npos) << check.out;

  const auto run = nilas({"run", scene[0], scene[1], scene[2], "--out", "out", "--set", "run.end_time_s=4e-4"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string log = scratch.read("out/log.txt");
  EXPECT_NE(log.find("warning: " + note), std::string::npos) << log;
  EXPECT_NE(log.find(name, log.find("peak force")), std::string::npos) << log;
  const auto summary = nlohmann::json::parse(scratch.read("out/summary.json"));
  EXPECT_EQ(summary["sound_speed_scale"], 0.5);
  EXPECT_NE(summary["ice"].get<std::string>().find(name), std::string::npos);

  const auto again = nilas({"run", "out/scene.toml", "--out", "again"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(scratch.read("out/history.csv"), scratch.read("again/history.csv"));
}

TEST_F(CommandLine, AnUnstableRunStopsWithParticleStepAndLimiterAndWritesNoNaN) {
  scratch.write("scene.toml", oblique_scene());
  const auto result = nilas(
      {"run", "scene.toml", "--out", "out", "--set", "numerics.cfl=5", "--set", "numerics.max_coupling_number=10"});
  EXPECT_EQ(result.exit_code, 3);
  expect_one_line(result.err, {"ice particle ", "in step ", "limited by ", "last good frame"});
  EXPECT_TRUE(files().contains("out/dump.txt"));
  for (const char* name : {"summary.json", "history.csv", "loads.csv", "log.txt", "dump.txt", "result.xmf"}) {
    const std::string text = scratch.read(std::string("out/") + name);
    EXPECT_EQ(text.find("nan"), std::string::npos) << name;
    EXPECT_EQ(text.find("inf"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace nilas::cases
