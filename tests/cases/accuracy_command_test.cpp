// `nilas accuracy` as a user meets it. Runs the built program, NILAS_BINARY.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/scene_text.hpp"
#include "tests/support/scratch_directory.hpp"

namespace nilas::cases {
namespace {

class AccuracyCommand : public testing::Test {
 protected:
  test::ProcessResult accuracy(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {NILAS_BINARY, "accuracy"});
    return test::run_process(arguments, scratch.path());
  }
  std::vector<std::string> lines(const std::string& file) const {
    std::ifstream in(scratch.path() / file);
    std::vector<std::string> result;
    for (std::string line; std::getline(in, line);) result.push_back(line);
    return result;
  }
  const test::ScratchDirectory scratch;
};

TEST_F(AccuracyCommand, WritesTheTableOfACaseWithTheOptionAskedFor) {
  const auto result = accuracy({"V9", "--quick", "--option", "cai-2025", "--out", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto csv = lines("out/accuracy.csv");
  ASSERT_EQ(csv.size(), 1 + 6 * 3u);  // metrics, resolutions
  EXPECT_EQ(csv[0], "case,option,spacing_m,particles,steps,cpu_time_s,error,order,tolerance,pass");
  EXPECT_EQ(csv[1].find("\"V9-elastic-pulse: arrival\",\"cai-2025\",0.04,1800,"), 0u) << csv[1];
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "out/accuracy.md"));
}

TEST_F(AccuracyCommand, ListsItsCasesAndRunsNothing) {
  const auto result = accuracy({"--list"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.out.find("V9-elastic-pulse"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

TEST_F(AccuracyCommand, RefusesWhatItDoesNotKnowAndWritesNothing) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"V9x"},
                                             {"V9", "--option", "nila"},
                                             {"--scene", "hcc-oblique"},
                                             {"--scene", "hcc-oblique", "--spacing", "0.1,0.1,0.2"},
                                             {"--economies", "--ices"},
                                             {"--economies", "V9"},
                                             {"--economies", "--spacing", "0.03"},
                                             {"--economies", "--scene", "hcc-obliqe"},
                                             {"--economies", "--set", "numerics.clf=0.3"}}) {
    const auto result = accuracy(words);
    EXPECT_EQ(result.exit_code, 2) << words[0];
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(std::filesystem::is_empty(scratch.path())) << words[0];
  }
}

TEST_F(AccuracyCommand, GivesTheGridConvergenceOfAScene) {
  scratch.write("scene.toml", test::oblique_scene());
  const auto result = accuracy(
      {"--scene", "scene.toml", "--spacing", "0.06,0.1,0.075", "--set", "run.end_time_s=4e-4", "--out", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto csv = lines("out/grid_convergence.csv");
  ASSERT_EQ(csv.size(), 5u);
  EXPECT_EQ(csv[0], "quantity,unit,at_0.1_m,at_0.075_m,at_0.06_m,order,extrapolated,gci");
  for (const char* run : {"out/spacing-0.1/summary.json", "out/spacing-0.06/summary.json"})
    EXPECT_TRUE(std::filesystem::exists(scratch.path() / run));
}

TEST_F(AccuracyCommand, GivesWhatEveryEconomyCostsAndSaves) {
  scratch.write("scene.toml", test::oblique_scene());
  const auto result = accuracy({"--economies", "--scene", "scene.toml", "--set", "run.end_time_s=6e-4", "--set",
                                "ice.diameter_m=2.4", "--out", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out.find("left out"), std::string::npos) << result.out;
  const auto csv = lines("out/economies.csv");
  ASSERT_GE(csv.size(), 3u);
  EXPECT_EQ(csv[0].find("variant,overrides,particles,particles_difference,steps,steps_difference,cpu_time_s,"), 0u);
  EXPECT_EQ(csv[1].find("\"plain\",\"run.end_time_s=6e-4 ice.diameter_m=2.4\","), 0u) << csv[1];
  const auto columns = std::count(csv[0].begin(), csv[0].end(), ',');
  for (const std::string& line : csv) {
    if (line.find("softened") == std::string::npos) {  // whose name has a comma of its own
      EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
    }
  }
  // A run of softened ice has fewer steps than the plain one, one of a cut sheet fewer particles.
  const auto count = [&](const char* key, const char* run) {
    return nlohmann::json::parse(scratch.read(std::string("out/") + run + "/summary.json"))[key].get<int>();
  };
  EXPECT_LT(count("steps", "scale-0.5"), 0.7 * count("steps", "plain"));
  EXPECT_EQ(count("steps", "single"), count("steps", "plain"));
  EXPECT_EQ(count("particles", "single"), count("particles", "plain"));
  EXPECT_LT(count("particles", "domain"), 0.8 * count("particles", "plain"));
  EXPECT_LT(count("particles", "domain-0.5"), 0.5 * count("particles", "domain"));
  EXPECT_EQ(count("particles", "all"), count("particles", "domain"));
  EXPECT_LT(count("steps", "all"), 0.7 * count("steps", "domain"));
  // The row of softened ice names its ice.
  const auto softened =
      std::find_if(csv.begin(), csv.end(), [](auto& line) { return line.starts_with("\"sound speed x 0.5\""); });
  ASSERT_NE(softened, csv.end());
  EXPECT_NE(softened->find("softened to 0.5 of its sound speeds"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "out/economies.md"));
}

TEST_F(AccuracyCommand, LeavesOutAnEconomyThatTheSceneCannotHave) {
  scratch.write("scene.toml", test::oblique_scene());
  const auto result = accuracy({"--economies", "--scene", "scene.toml", "--set", "run.end_time_s=1e-4", "--set",
                                "impact.gap_m=0.2", "--out", "out"});  // no body enters the sheet: no domain
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("domain auto: left out: "), std::string::npos) << result.out;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "out/domain"));
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "out/single/summary.json"));
}

TEST_F(AccuracyCommand, AnEconomyWhoseRunStopsIsARowThatSaysSo) {
  scratch.write("scene.toml", test::oblique_scene());
  const auto result = accuracy({"--economies", "--scene", "scene.toml", "--set", "run.end_time_s=4e-4", "--set",
                                "run.energy_bound=1e-12", "--out", "out"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.out.find("stopped: the ledger of energy does not close"), std::string::npos) << result.out;
  EXPECT_GE(lines("out/economies.csv").size(), 3u);
}

}  // namespace
}  // namespace nilas::cases
