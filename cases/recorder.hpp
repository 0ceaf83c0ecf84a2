// Watches a run step by step: history rows, peaks, loads on the boundary particles, and whether the ledger closes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cases/force_peak.hpp"
#include "cases/results.hpp"
#include "cases/scene.hpp"
#include "coupling/impact.hpp"

namespace nilas::cases {

/// What the recorder keeps of one body.
struct BodyRecord {
  explicit BodyRecord(double force_window) : peak(force_window) {}
  ForcePeak peak;
  double largest_angular_velocity = 0;  // rad/s
  double largest_attitude_change_deg = 0;
  Vec3 initial_axis = Vec3::UnitZ();
  std::vector<Vec3> impulse;           // N s, on each boundary particle since the start
  std::vector<Vec3> impulse_at_frame;  // N s, the same at the last frame
  // At the last history row.
  Vec3 row_impulse = Vec3::Zero(), row_angular_impulse = Vec3::Zero();
};

class Recorder {
 public:
  /// Writes history.csv into `directory`.
  Recorder(const Scene& scene, const std::filesystem::path& directory, double force_window);

  /// After every sub-step. Returns a sentence if the ledger has stayed open beyond the scene's bounds, else nothing.
  std::string observe(const Impact& impact, const LedgerEntry& ledger);
  /// Whether this sub-step ends a history row, so that the ledger is due.
  bool row_due(const Impact& impact) const;
  /// Every sub-step, cheap.
  void accumulate(const Impact& impact);

  /// The ice and the bodies now, as a frame of result.h5; starts a new traction interval.
  IceFrame ice_frame(const Impact& impact) const;
  std::vector<BodyFrame> body_frames(const Impact& impact);

  const std::vector<BodyRecord>& bodies() const { return bodies_; }
  const LedgerEntry& ledger() const { return ledger_; }
  double largest_penetration() const { return largest_penetration_; }

 private:
  std::vector<double> row(const Impact& impact);
  RunSpec bounds_;
  double history_interval_;
  double next_row_ = 0, last_row_ = 0, last_frame_ = 0;
  double largest_penetration_ = 0, row_penetration_ = 0;
  std::vector<BodyRecord> bodies_;
  LedgerEntry ledger_;
  std::size_t momentum_closed_ = 0, angular_momentum_closed_ = 0, energy_closed_ = 0;  // last step within the bound
  HistoryWriter history_;
};

/// What result.h5 says once about each body.
std::vector<BodyDescription> describe(const std::vector<Body>& bodies);

/// Angle between the body's axis and the x-y plane [deg], the attitude angle beta of Cai et al. 2025.
double attitude_deg(const rigid::State& state);

}  // namespace nilas::cases
