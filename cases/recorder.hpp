// Watches a run step by step: history rows, peaks, loads on the boundary particles, and whether the ledger closes.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "cases/force_peak.hpp"
#include "cases/results.hpp"
#include "cases/scene.hpp"
#include "coupling/impact.hpp"
#include "coupling/load_record.hpp"

namespace nilas::cases {

/// What the recorder keeps of one body.
struct BodyRecord {
  BodyRecord(double force_window, double loads_interval) : peak(force_window), loads(loads_interval) {}
  ForcePeak peak;
  LoadRecord loads;
  double largest_angular_velocity = 0;  // rad/s
  double largest_attitude_change_deg = 0;
  Vec3 initial_axis = Vec3::UnitZ();
  std::vector<Vec3> impulse;           // N s, on each boundary particle since the start
  std::vector<Vec3> impulse_at_frame;  // N s, the same at the last frame
  // At the last history row.
  Vec3 row_impulse = Vec3::Zero(), row_angular_impulse = Vec3::Zero();
  double row_penetration = 0;  // m, deepest since then
};

class Recorder {
 public:
  /// Writes history.csv into `directory`.
  Recorder(const Scene& scene, const std::filesystem::path& directory, double force_window);

  /// Records a row of the history. Returns a sentence if the ledger has stayed open beyond the scene's bounds for too
  /// many steps, else nothing.
  std::string observe(const Impact& impact, const LedgerEntry& ledger);
  /// At the end of a run: records the last step if no row did, and judges the ledger as it stands.
  std::string finish(const Impact& impact, const LedgerEntry& ledger);
  /// Whether this sub-step ends a history row, so that the ledger is due.
  bool row_due(const Impact& impact) const;
  /// Every sub-step, cheap.
  void accumulate(const Impact& impact);
  /// The load on each body against time: loads.csv, of several bodies loads-NAME.csv (coupling/load_record.hpp). Throws
  /// std::runtime_error with path and reason.
  void write_loads(const std::filesystem::path& directory, const std::vector<Body>& bodies) const;

  /// The ice and the bodies now, as a frame of result.h5; starts a new traction interval.
  IceFrame ice_frame(const Impact& impact) const;
  std::vector<BodyFrame> body_frames(const Impact& impact);

  const std::vector<BodyRecord>& bodies() const { return bodies_; }
  const LedgerEntry& ledger() const { return ledger_; }
  double largest_penetration() const { return largest_penetration_; }
  /// Largest (kinetic + elastic energy) / (the same at the start + work from outside) so far: above 1, energy was made.
  double energy_growth() const { return energy_growth_; }

 private:
  /// Since when one of the ledgers has been open; rows may be many steps apart.
  struct LedgerWatch {
    std::size_t last_closed = 0, first_open = 0;  // steps
    bool open = false;
    void note(std::size_t step, bool closed) {
      if (closed) last_closed = step;
      if (!closed && !open) first_open = step;
      open = !closed;
    }
    std::size_t open_for(std::size_t step) const { return open ? step - first_open : 0; }       // seen open
    std::size_t unclosed_for(std::size_t step) const { return open ? step - last_closed : 0; }  // not seen closed
  };
  struct LedgerCheck {
    double residual, bound;
    const char* what;
    const char* key;
    LedgerWatch& watch;
    std::string sentence() const;
  };
  std::array<LedgerCheck, 3> checks(const LedgerEntry& ledger);
  void record_row(const Impact& impact, const LedgerEntry& ledger);
  void note_energy(const LedgerEntry& ledger);
  std::vector<double> row(const Impact& impact);
  RunSpec bounds_;
  double history_interval_;
  double next_row_ = 0, last_row_ = 0, last_frame_ = 0;
  double largest_penetration_ = 0;
  double energy_ratio_ = 1, energy_growth_ = 1;  // at the last row; the largest so far
  std::vector<BodyRecord> bodies_;
  LedgerEntry ledger_;
  std::array<LedgerWatch, 3> watches_;  // momentum, angular momentum, energy
  std::size_t step_ = 0;                // of the last row
  HistoryWriter history_;
};

/// What result.h5 says once about each body.
std::vector<BodyDescription> describe(const std::vector<Body>& bodies);

/// Angle between the body's axis and the x-y plane [deg], the attitude angle beta of Cai et al. 2025.
double attitude_deg(const rigid::State& state);

/// Angle by which the body's axis has turned from `initial_axis` [deg].
double attitude_change_deg(const Vec3& initial_axis, const rigid::State& state);

}  // namespace nilas::cases
