// Ice and rigid bodies advanced together: the sub-step, written once.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "coupling/body.hpp"
#include "coupling/ledger.hpp"
#include "coupling/rest.hpp"
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
  /// Called after every sub-step, and after a stretch of sleep, with the state at its end.
  using Observer = std::function<void(Impact&)>;

  /// sleep_speed [m/s]: see coupling/rest.hpp; 0: the ice is always stepped. Throws std::invalid_argument as sph::Ice
  /// does.
  Impact(const sph::IceSpec& ice, const std::vector<Body>& bodies, Observer observer = {},
         const sph::InitialState& initial = {}, double sleep_speed = 0);

  /// One more body, which meets the ice from now on. Returns its index in bodies().
  std::size_t add(const Body& body);

  /// Advances by `duration` [s] in sub-steps no longer than the stable one, ending exactly there; the last ones share
  /// what is left evenly, so that none is tiny. loads: constant over the duration, one per body (fewer: none for the
  /// rest). Stops early after a sub-step at which `enough` says so; returns the time left undone [s]. Throws
  /// sph::NumericalFailure.
  double advance(double duration, const std::vector<ExternalLoad>& loads = {},
                 const std::function<bool()>& enough = {});

  const sph::Ice& ice() const { return ice_; }
  bool asleep() const { return rest_.asleep(); }
  const std::vector<Body>& bodies() const { return bodies_; }
  /// For a host that moves or changes it; after a change of mass or locks call limit_coupling().
  Body& body(std::size_t index) { return bodies_[index]; }
  void limit_coupling();
  void presence(std::size_t body, Presence presence);
  Presence presence(std::size_t body) const { return presence_[body]; }
  /// Where the ice last met the bodies; not moved while the ice sleeps.
  const std::vector<sph::Surface>& surfaces() const { return surfaces_; }
  const StepRecord& last_step() const { return record_; }
  sph::StepLimit stable_step() const;
  LedgerEntry ledger() { return ledger_.enter(ice_, bodies_); }

 private:
  void substep(double dt, const std::vector<ExternalLoad>& loads);
  /// The bodies alone, while the ice sleeps.
  void fly(double duration, const std::vector<ExternalLoad>& loads);
  bool body_within_reach(double duration, const std::vector<ExternalLoad>& loads) const;

  std::vector<Body> bodies_;
  std::vector<Presence> presence_;
  std::vector<sph::Surface> surfaces_;
  sph::Ice ice_;
  Ledger ledger_;
  Rest rest_;
  double max_coupling_number_;  // 0: no limit
  sph::ContactSpec contact_;
  double longest_step_ = std::numeric_limits<double>::infinity();  // s, that numerics.max_coupling_number allows
  StepRecord record_;
  Observer observer_;
};

}  // namespace nilas

#pragma GCC visibility pop
