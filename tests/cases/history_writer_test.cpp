#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

#include "cases/results.hpp"

namespace nilas::test {
namespace {

namespace fs = std::filesystem;
using cases::HistoryWriter;

std::vector<std::string> lines(const fs::path& path) {
  std::ifstream in(path);
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

std::vector<double> numbers(const std::string& line) {
  std::vector<double> all;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) all.push_back(std::strtod(cell.c_str(), nullptr));
  return all;
}

class HistoryWriterTest : public testing::Test {
 protected:
  fs::path file = fs::path(testing::TempDir()) /
                  (std::string("nilas-") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
  void SetUp() override { fs::remove(file); }
  void TearDown() override { fs::remove(file); }
};

TEST_F(HistoryWriterTest, TheHeaderIsThereBeforeTheFirstRow) {
  const HistoryWriter writer(file, {"time_s", "force_x_N"});
  EXPECT_EQ(lines(file), std::vector<std::string>{"time_s,force_x_N"});
}

TEST_F(HistoryWriterTest, EveryNumberReadsBackExactly) {
  using Limits = std::numeric_limits<double>;
  const std::vector<double> row{0.1,
                                1.0 / 3,
                                std::numbers::pi * 1e-300,
                                -2.5e17,
                                Limits::max(),
                                Limits::epsilon(),
                                Limits::min(),
                                Limits::denorm_min(),
                                0.0,
                                -0.0,
                                std::nextafter(1.0, 2.0)};
  HistoryWriter writer(file, std::vector<std::string>(row.size(), "x"));
  writer.append(row);
  const std::vector<double> read = numbers(lines(file).at(1));
  ASSERT_EQ(read, row);
  EXPECT_TRUE(std::signbit(read[9]));
}

TEST_F(HistoryWriterTest, EveryRowIsOnDiskAsSoonAsItIsAppended) {
  HistoryWriter writer(file, {"time_s", "step"});
  for (int i = 0; i < 5; ++i) {
    writer.append({1e-6 * i, double(i)});
    const auto written = lines(file);
    ASSERT_EQ(written.size(), i + 2u);
    EXPECT_EQ(numbers(written.back()), (std::vector<double>{1e-6 * i, double(i)}));
  }
}

TEST_F(HistoryWriterTest, ANonFiniteValueIsRefusedByColumnAndRowAndNotWritten) {
  HistoryWriter writer(file, {"time_s", "force_x_N"});
  writer.append({0, 1});
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    try {
      writer.append({1, bad});
      FAIL() << "written";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string() + ": force_x_N is "), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("row 1"), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(lines(file), (std::vector<std::string>{"time_s,force_x_N", "0,1"}));
}

TEST_F(HistoryWriterTest, AMissingDirectoryIsAnErrorThatNamesTheFileAndTheReason) {
  const fs::path missing = file / "history.csv";
  try {
    HistoryWriter writer(missing, {"time_s"});
    FAIL() << "made";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), missing.string() + ": cannot write: No such file or directory");
  }
}

TEST(HistoryWriterOnAFullDisk, IsAnErrorThatNamesTheReason) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  try {
    HistoryWriter writer("/dev/full", {"time_s"});
    FAIL() << "written";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "/dev/full: cannot write: No space left on device");
  }
}

}  // namespace
}  // namespace nilas::test
