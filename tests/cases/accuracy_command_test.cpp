// `nilas accuracy` as a user meets it. Runs the built program, NILAS_BINARY.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

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
                                             {"--scene", "hcc-oblique", "--spacing", "0.1,0.1,0.2"}}) {
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

}  // namespace
}  // namespace nilas::cases
