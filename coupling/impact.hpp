// Ice and rigid bodies advanced together: the sub-step, written once.
#pragma once

#include <functional>
#include <vector>

#include "coupling/body.hpp"
#include "coupling/ledger.hpp"
#include "sph/ice.hpp"

#pragma GCC visibility push(default)

namespace nilas {

/// How the last sub-step went.
struct StepRecord {
  double dt = 0;  // s
  sph::Limiter limiter = sph::Limiter::sound_speed;
  std::size_t number = 0;  // sub-steps so far
  double time = 0;         // s since the start, at the end of the sub-step
};

class Impact {
 public:
  /// Called after every sub-step with the state at its end.
  using Observer = std::function<void(Impact&)>;

  /// Throws std::invalid_argument as sph::Ice does.
  Impact(const sph::IceSpec& ice, std::vector<Body> bodies, Observer observer = {},
         const sph::InitialState& initial = {});

  /// Advances by `duration` [s] in sub-steps no longer than the stable one, ending exactly there; the last ones share
  /// what is left evenly, so that none is tiny. loads: constant over the duration, one per body (empty: none). Throws
  /// sph::NumericalFailure.
  void advance(double duration, const std::vector<ExternalLoad>& loads = {});

  const sph::Ice& ice() const { return ice_; }
  const std::vector<Body>& bodies() const { return bodies_; }
  Body& body(std::size_t index) { return bodies_[index]; }
  const std::vector<sph::Surface>& surfaces() const { return surfaces_; }
  const StepRecord& last_step() const { return record_; }
  sph::StepLimit stable_step() const;
  LedgerEntry ledger() { return ledger_.enter(ice_, bodies_); }

 private:
  void substep(double dt, const std::vector<ExternalLoad>& loads);

  std::vector<Body> bodies_;
  std::vector<sph::Surface> surfaces_;
  sph::Ice ice_;
  Ledger ledger_;
  double longest_step_;  // s, that numerics.max_coupling_number allows at the start
  StepRecord record_;
  Observer observer_;
};

}  // namespace nilas

#pragma GCC visibility pop
