// `nilas stability`, run by the built program.
#include "cases/stability/stability.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "cases/scene.hpp"
#include "tests/support/process.hpp"
#include "tests/support/scratch_directory.hpp"

namespace nilas::cases {
namespace {

using test::ProcessResult;
using test::ScratchDirectory;

std::set<std::string> names_of(const std::vector<StabilityRow>& rows) {
  std::set<std::string> names;
  for (const StabilityRow& row : rows) names.insert(row.name());
  return names;
}

TEST(StabilityRows, HaveDifferentNamesThatAreFileNames) {
  const auto rows = stability_rows();
  EXPECT_EQ(names_of(rows).size(), rows.size());
  for (const std::string& name : names_of(rows)) {
    EXPECT_LT(name.size(), 120u) << name;
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789.-"), std::string::npos) << name;
  }
}

// What the project has promised to try (stress tests of its physics reference).
TEST(StabilityRows, CoverEveryPromisedExtreme) {
  const auto names = names_of(stability_rows());
  for (const char* name : {"body-mass-1-g",
                           "body-mass-10-g",
                           "body-mass-0.1-kg",
                           "body-mass-1-kg",
                           "body-mass-10-kg",
                           "body-mass-174-kg",
                           "body-mass-1e3-kg",
                           "body-mass-1e5-kg",
                           "ice-stiffness-x-0.01",
                           "ice-stiffness-x-0.1",
                           "ice-stiffness-x-1",
                           "ice-stiffness-x-10",
                           "ice-stiffness-x-100",
                           "contact-stiffness-0.02",
                           "contact-stiffness-0.2",
                           "contact-stiffness-2",
                           "contact-stiffness-20",
                           "poisson-ratio-0",
                           "poisson-ratio-0.33",
                           "poisson-ratio-0.49",
                           "poisson-ratio-0.499",
                           "poisson-ratio-0.4999",
                           "poisson-ratio-0.5",
                           "cfl-0.2",
                           "cfl-0.4",
                           "cfl-0.6",
                           "cfl-0.8",
                           "cfl-1.0",
                           "cfl-1.2",
                           "cfl-1.5",
                           "speed-0.01-m-s-touching",
                           "speed-1-m-s",
                           "speed-10-m-s",
                           "speed-100-m-s",
                           "speed-500-m-s",
                           "speed-1000-m-s",
                           "speed-3000-m-s",
                           "impact-angle-0.1-deg",
                           "impact-angle-5-deg",
                           "impact-angle-30-deg",
                           "impact-angle-90-deg",
                           "layers-of-particles-1",
                           "layers-of-particles-2",
                           "layers-of-particles-3",
                           "spin-about-the-axis-10-rad-s",
                           "spin-about-the-axis-1e2-rad-s",
                           "spin-about-the-axis-1e3-rad-s",
                           "spin-about-the-axis-1e4-rad-s",
                           "spin-across-the-axis-10-rad-s",
                           "spin-across-the-axis-1e2-rad-s",
                           "spin-across-the-axis-1e3-rad-s",
                           "spin-across-the-axis-1e4-rad-s",
                           "jitter-in-spacings-0.1",
                           "jitter-in-spacings-0.2",
                           "jitter-in-spacings-0.3",
                           "jitter-in-spacings-0.4",
                           "jitter-in-spacings-0.5",
                           "pieces-of-ice-on-top-of-each-other-exactly",
                           "ice-strength-cohesion-0",
                           "ice-strength-friction-0-deg",
                           "ice-strength-friction-60-deg",
                           "ice-strength-dilation-above-friction",
                           "body-starts-inside-the-ice-by-1-spacing",
                           "body-starts-inside-the-ice-by-5-spacings",
                           "at-rest-out-of-touch-1e5-steps",
                           "at-rest-out-of-touch-1e6-steps",
                           "at-rest-lying-on-a-wall-1e6-steps",
                           "at-rest-touching-a-wall-without-gravity-1e4-steps",
                           "far-from-the-origin-1e6-m",
                           "fast-frame-1-km-s",
                           "inertia-zero-about-the-axis",
                           "inertia-against-the-triangle-inequality",
                           "inertia-too-large-for-the-shape-printed",
                           "input-impact.speed-m-s-nan",
                           "input-impact.speed-m-s-1e300"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(StabilityRows, AreChosenByNameByCaseOrByHowLongTheyTake) {
  EXPECT_EQ(names_of(chosen_rows({"cfl-0.6"}, false)), std::set<std::string>{"cfl-0.6"});
  EXPECT_EQ(chosen_rows({"impact-angle", "cfl-0.6"}, true).size(), 5u);
  EXPECT_LT(chosen_rows({}, true).size(), chosen_rows({}, false).size());
  EXPECT_THROW(chosen_rows({"body-weight"}, false), SceneError);
}

TEST(StabilityRows, ARemedyOnlyAddsToTheRowThatItIsFor) {
  const auto rows = stability_rows();
  ASSERT_FALSE(rows.front().must_hold);
  std::size_t plain = 0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if (!rows[k].must_hold) {
      plain = k;
      continue;
    }
    ASSERT_GT(rows[k].overrides.size(), rows[plain].overrides.size()) << rows[k].name();
    EXPECT_TRUE(std::equal(rows[plain].overrides.begin(), rows[plain].overrides.end(), rows[k].overrides.begin()))
        << rows[k].name();
  }
}

TEST(StabilityTable, HasOneQuotedLinePerRowAndLeavesEmptyWhatDidNotHappen) {
  const std::vector<StabilityRow> rows{{"mass", "1 g", "hcc-oblique", {}}, {"angle", "5 deg", "hcc-oblique", {}}};
  StabilityResult held;
  held.outcome = StabilityOutcome::held;
  held.message = "150 steps";
  held.energy_growth = 1;
  held.ledger_residual = 0.25;
  held.penetration = 0;
  StabilityResult refused;
  refused.outcome = StabilityOutcome::refused;
  refused.message = "mass_kg = 0, allowed: \"more\"";
  EXPECT_EQ(stability_csv(rows, {refused, held}),
            "case,value,outcome,energy_growth,ledger_residual,penetration_m,message\n"
            "mass,1 g,refused,,,,\"mass_kg = 0, allowed: \"\"more\"\"\"\n"
            "angle,5 deg,held,1,0.25,0,150 steps\n");
}

class StabilityCommand : public testing::Test {
 protected:
  ProcessResult stability(std::vector<std::string> rows) const {
    rows.insert(rows.begin(), {NILAS_BINARY, "stability", "--out", "out"});
    return test::run_process(rows, scratch.path());
  }
  /// The lines of out/stability.csv without the header.
  std::vector<std::string> table() const {
    std::istringstream text(scratch.read("out/stability.csv"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    lines.erase(lines.begin());
    return lines;
  }
  bool exists(const std::string& file) const { return std::filesystem::exists(scratch.path() / file); }

  const ScratchDirectory scratch;
};

TEST_F(StabilityCommand, TellsWhatHeldWhatWasRefusedAndWhatStopped) {
  const auto result = stability({"coupling-number-of-a-full-face-1.0", "cfl-5", "poisson-ratio-0.5"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const auto lines = table();
  ASSERT_EQ(lines.size(), 4u);  // cfl-5 has a remedy
  EXPECT_EQ(lines[0].find("coupling number of a full face,1.0,held,1,"), 0u) << lines[0];
  EXPECT_EQ(lines[1].find("Poisson ratio,0.5,refused,,,,"), 0u) << lines[1];
  EXPECT_EQ(lines[2].find("CFL,5,stopped,"), 0u) << lines[2];
  EXPECT_NE(lines[2].find("lower numerics.cfl"), std::string::npos) << lines[2];
  EXPECT_EQ(lines[3].find("CFL,\"5, numerics.cfl=0.6\",held,"), 0u) << lines[3];
  EXPECT_TRUE(exists("out/runs/cfl-5/dump.txt"));
  EXPECT_FALSE(exists("out/runs/poisson-ratio-0.5"));
  for (const char* name : {"summary.json", "history.csv", "dump.txt"}) {
    const std::string text = scratch.read(std::string("out/runs/cfl-5/") + name);
    EXPECT_EQ(text.find("nan"), std::string::npos) << name;
    EXPECT_EQ(text.find("inf"), std::string::npos) << name;
  }
}

// The staggered bound z A dt/m < 2 (rigid body against a half-space of impedance z, over the area A that touches).
TEST_F(StabilityCommand, TheExchangeBreaksWhereTheCouplingNumberOfTheTouchingFacePassesTwo) {
  const auto result = stability({"coupling-number-of-a-full-face"});
  EXPECT_EQ(result.exit_code, 0) << result.out;
  const auto lines = table();
  ASSERT_EQ(lines.size(), 6u);
  for (const int below : {0, 1, 3, 5}) EXPECT_NE(lines[below].find(",held,1,"), std::string::npos) << lines[below];
  for (const int above : {2, 4}) {
    EXPECT_NE(lines[above].find(",stopped,"), std::string::npos) << lines[above];
    EXPECT_NE(lines[above].find("numerics.max_coupling_number"), std::string::npos) << lines[above];
  }
}

TEST_F(StabilityCommand, RefusesALightBodyAndNamesTheOptionThatHolds) {
  const auto result = stability({"body-mass-1-kg"});
  EXPECT_EQ(result.exit_code, 0) << result.out;
  const auto lines = table();
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find(",refused,"), std::string::npos) << lines[0];
  EXPECT_NE(lines[0].find("numerics.max_coupling_number = 1"), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find(",held,"), std::string::npos) << lines[1];
}

TEST_F(StabilityCommand, KeepsTheTableWhenThePictureCannotBeDrawn) {
  std::filesystem::create_directories(scratch.path() / "out/stability.png");  // a directory where the picture would go
  const auto result = stability({"poisson-ratio-0.5"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("no picture: "), std::string::npos) << result.out;
  EXPECT_EQ(table().size(), 1u);
}

TEST_F(StabilityCommand, RefusesARowThatThereIsNot) {
  const auto result = stability({"body-weight"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("body-weight"), std::string::npos);
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace nilas::cases
