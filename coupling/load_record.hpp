// The load of the ice on one body against time: what a run without SPH needs to play the impact back (LoadReplay).
//
// As a file it is CSV: a header with units, then one row per time, every number with the digits that read back to the
// same double.
//
//     time_s,impulse_x_N_s,impulse_y_N_s,impulse_z_N_s,angular_impulse_x_N_m_s,angular_impulse_y_N_m_s,...
//     0,0,0,0,0,0,0
//     3.5e-06,0.1234,...
#pragma once

#include <filesystem>
#include <vector>

#include "coupling/body.hpp"

#pragma GCC visibility push(default)

namespace nilas {

/// World frame. Impulses are what the ice has given so far; only their differences from row to row mean anything.
struct LoadRow {
  double time = 0;                      // s
  Vec3 impulse = Vec3::Zero();          // N s
  Vec3 angular_impulse = Vec3::Zero();  // N m s, about the body's centre of mass at each instant
};

class LoadRecord {
 public:
  /// To be added to; starts with a row of zeros at time 0. interval [s]: the least time between two rows but the last
  /// two; 0: a row for every call of add.
  explicit LoadRecord(double interval = 0);
  /// A load known otherwise. Throws std::invalid_argument if there is no row, a number is not finite, or a time is not
  /// after the one before.
  explicit LoadRecord(std::vector<LoadRow> rows);

  /// Notes what has reached the body by `time`, later than all before: in an Impact::Observer after every sub-step,
  ///     record.add(impact.last_step().time, impact.bodies()[0].account());
  /// The last row is always that of the last call, so that no impulse is missing.
  void add(double time, const BodyAccount& account);

  /// Never empty, times increasing.
  const std::vector<LoadRow>& rows() const { return rows_; }

 private:
  double interval_ = 0;
  std::vector<LoadRow> rows_;
};

/// Throws std::runtime_error, one line: the file and the reason.
void write_load_record(const LoadRecord& record, const std::filesystem::path& file);
/// Throws std::runtime_error, one line: the file, the line and what is wrong with it.
LoadRecord read_load_record(const std::filesystem::path& file);

}  // namespace nilas

#pragma GCC visibility pop
