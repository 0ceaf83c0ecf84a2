#include "coupling/load_record.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tests/support/scratch_directory.hpp"

namespace nilas {
namespace {

const std::string kHeader =
    "time_s,impulse_x_N_s,impulse_y_N_s,impulse_z_N_s,"
    "angular_impulse_x_N_m_s,angular_impulse_y_N_m_s,angular_impulse_z_N_m_s\n";

BodyAccount account(const Vec3& impulse, const Vec3& angular_impulse) {
  BodyAccount a;
  a.ice_impulse = impulse;
  a.ice_angular_impulse = angular_impulse;
  return a;
}

void expect_same(const LoadRecord& a, const LoadRecord& b) {
  ASSERT_EQ(a.rows().size(), b.rows().size());
  for (std::size_t n = 0; n < a.rows().size(); ++n) {
    EXPECT_EQ(a.rows()[n].time, b.rows()[n].time);
    EXPECT_EQ(a.rows()[n].impulse, b.rows()[n].impulse);
    EXPECT_EQ(a.rows()[n].angular_impulse, b.rows()[n].angular_impulse);
  }
}

std::string what_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

/// Of reading a file of that text; the file's name left out.
std::string error_of(const std::string& text) {
  const test::ScratchDirectory scratch;
  const auto file = scratch.write("loads.csv", text);
  const std::string what = what_of([&] { read_load_record(file); });
  EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  if (!what.starts_with(file.string())) return what;
  return what.substr(file.string().size());
}

TEST(LoadRecord, StartsWithNothingAndKeepsEveryRow) {
  LoadRecord record;
  record.add(1e-6, account(Vec3(1, 2, 3), Vec3(4, 5, 6)));
  record.add(3e-6, account(Vec3(2, 2, 3), Vec3(4, 7, 6)));
  ASSERT_EQ(record.rows().size(), 3u);
  EXPECT_EQ(record.rows()[0].time, 0);
  EXPECT_TRUE(record.rows()[0].impulse.isZero(0));
  EXPECT_EQ(record.rows()[1].angular_impulse, Vec3(4, 5, 6));
  EXPECT_EQ(record.rows()[2].time, 3e-6);
  EXPECT_EQ(record.rows()[2].impulse, Vec3(2, 2, 3));
}

TEST(LoadRecord, WithAnIntervalKeepsRowsThatFarApartAndAlwaysTheLast) {
  LoadRecord record(1e-5);
  for (int n = 1; n <= 103; ++n) {
    record.add(1e-6 * n, account(Vec3(n, 0, 0), Vec3::Zero()));
    EXPECT_EQ(record.rows().back().impulse.x(), n);
  }
  ASSERT_EQ(record.rows().size(), 12u);
  for (std::size_t n = 0; n <= 10; ++n) EXPECT_NEAR(record.rows()[n].time, 1e-5 * static_cast<double>(n), 1e-18);
}

TEST(LoadRecord, ReadsBackToTheLastBit) {
  using Limits = std::numeric_limits<double>;
  const LoadRecord record({{-0.1, Vec3(1. / 3, -2.5e17, 0), Vec3(Limits::denorm_min(), 1e-300, Limits::max())},
                           {0, Vec3(std::numbers::pi, 1, -1), Vec3(1, 2, Limits::min())},
                           {std::nextafter(0, 1), Vec3::Zero(), Vec3(Limits::epsilon(), 0, 0)}});
  const test::ScratchDirectory scratch;
  write_load_record(record, scratch.path() / "loads.csv");
  expect_same(read_load_record(scratch.path() / "loads.csv"), record);
  EXPECT_TRUE(scratch.read("loads.csv").starts_with(kHeader));
}

TEST(LoadRecord, ReadsAFileWithTheLineEndsOfAnotherSystem) {
  const test::ScratchDirectory scratch;
  std::string text = kHeader + "0,0,0,0,0,0,0\n1,2,3,4,5,6,7\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, 1, '\r');
  const LoadRecord record = read_load_record(scratch.write("loads.csv", text));
  ASSERT_EQ(record.rows().size(), 2u);
  EXPECT_EQ(record.rows()[1].angular_impulse, Vec3(5, 6, 7));
}

TEST(LoadRecord, AMistakeInAFileIsOneLineWithPlaceAndReason) {
  std::string header = kHeader;
  header.pop_back();
  const std::string first_line = ":1: the first line must be ", columns = ": must have 7 columns: " + header,
                    cell = ":2: impulse_y_N_s is \"";
  EXPECT_EQ(error_of(""), first_line + header);
  EXPECT_EQ(error_of("time,force\n0,0\n"), first_line + header);
  EXPECT_EQ(error_of(kHeader), ":2: no row, must have at least one");
  EXPECT_EQ(error_of(kHeader + "0,0,0,0,0,0,0\n1,0,0,0,0,0\n"), ":3" + columns);
  EXPECT_EQ(error_of(kHeader + "0,0,0,0,0,0,0,0\n"), ":2" + columns);
  EXPECT_EQ(error_of(kHeader + "0,0,0,0,0,0,0\n\n"), ":3" + columns);
  for (const char* bad : {"strong", "", "1 N s", "nan", "inf", "1e999"})
    EXPECT_EQ(error_of(kHeader + "0,0," + bad + ",0,0,0,0\n"), cell + bad + "\", must be a finite number");
  EXPECT_EQ(error_of(kHeader + "0,0,0,0,0,0,0\n1,0,0,0,0,0,0\n1,0,0,0,0,0,0\n"),
            ":4: time_s is not after that of the row before");
}

TEST(LoadRecord, AFileThatCannotBeReadOrWrittenIsAnErrorThatNamesIt) {
  const std::filesystem::path missing = "/nowhere/loads.csv";
  EXPECT_EQ(what_of([&] { read_load_record(missing); }), "/nowhere/loads.csv: cannot read: No such file or directory");
  EXPECT_EQ(what_of([&] { write_load_record(LoadRecord(), missing); }),
            "/nowhere/loads.csv: cannot write: No such file or directory");
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_EQ(what_of([] { write_load_record(LoadRecord(), "/dev/full"); }),
              "/dev/full: cannot write: No space left on device");
  }
}

TEST(LoadRecord, RowsThatAreNoRecordAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Rows = std::vector<LoadRow>;
  EXPECT_THROW(LoadRecord(Rows{}), std::invalid_argument);
  EXPECT_THROW(LoadRecord(Rows{{0}, {0}}), std::invalid_argument);
  EXPECT_THROW(LoadRecord(Rows{{1}, {0}}), std::invalid_argument);
  EXPECT_THROW(LoadRecord(Rows{{nan}}), std::invalid_argument);
  EXPECT_THROW(LoadRecord(Rows{{0, Vec3(0, nan, 0)}}), std::invalid_argument);
  EXPECT_NO_THROW(LoadRecord(Rows{{-1}, {0}}));
}

}  // namespace
}  // namespace nilas
