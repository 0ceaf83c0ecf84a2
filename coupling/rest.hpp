// Ice at rest sleeps: while nothing stirs it and no body is within reach it is not stepped at all.
//
// Ice falls asleep once, for two crossings of its largest extent by a shear wave, and for 4 v_s / g with gravity g (in
// which nothing that falls can stay slow), no particle has been faster than the sleep speed v_s nor accelerated by more
// than v_s per crossing. Its state is then kept as it is: what sleeping changes
// is bounded by v_s in velocity and rho c_p v_s in stress. Ice that starts without velocity, stress and gravity is
// asleep from the start, and the run after waking is that of ice that never slept, to round-off.
#pragma once

#include <vector>

#include "coupling/body.hpp"
#include "sph/ice.hpp"

#pragma GCC visibility push(default)

namespace nilas {

class Rest {
 public:
  /// sleep_speed [m/s]; 0: this ice never sleeps. Ice without velocity and gravity, which is free of stress at the
  /// start, sleeps at once. gravity [m/s2]: its magnitude.
  Rest(const sph::Ice& ice, double sleep_speed, double gravity);

  bool asleep() const { return asleep_; }
  void wake();
  /// After a sub-step of dt [s]: whether the ice has been quiet for long enough to fall asleep.
  bool quiet(const sph::Ice& ice, double dt);
  /// Falls asleep with the bodies as they are.
  void sleep(const sph::Ice& ice, const std::vector<Body>& bodies, const std::vector<Presence>& presence);
  /// Whether a body wakes the sleeping ice: one that comes within reach of it in the next dt [s] under its load, or a
  /// locked one (the ground) that is not where it was when the ice fell asleep, or not there at all. Locked ones that
  /// stay do not wake it.
  bool woken_by(std::size_t index, const Body& body, Presence presence, const ExternalLoad& load, double dt) const;

 private:
  bool within_reach(const rigid::State& state, const Body& body, double way = 0) const;

  double sleep_speed_, margin_;
  double crossing_time_ = 0, quiet_before_sleep_ = 0;  // s
  bool asleep_ = false;
  double quiet_time_ = 0;
  Vec3 lower_ = Vec3::Zero(), upper_ = Vec3::Zero();  // of the sleeping ice, m
  // When it fell asleep.
  std::vector<rigid::State> bodies_;
  std::vector<Presence> presence_;
};

}  // namespace nilas

#pragma GCC visibility pop
