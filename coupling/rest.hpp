// Ice at rest sleeps: while nothing stirs it and no body is within reach it is not stepped at all.
//
// Ice falls asleep once, for two crossings of its largest extent by a shear wave, no particle has been faster than the
// sleep speed v_s nor accelerated by more than v_s per crossing. Its state is then kept as it is: what sleeping changes
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
  /// sleep_speed [m/s]; 0: this ice never sleeps. undisturbed: it starts without velocity, stress and gravity.
  Rest(const sph::Ice& ice, double sleep_speed, bool undisturbed);

  bool asleep() const { return asleep_; }
  void wake();
  /// After a sub-step of dt [s]: whether the ice has been quiet for long enough to fall asleep.
  bool quiet(const sph::Ice& ice, double dt);
  /// Falls asleep with the bodies as they are.
  void sleep(const sph::Ice& ice, const std::vector<Body>& bodies);
  /// Whether a body comes within reach of the sleeping ice in the next dt [s] under its load. A body that is locked and
  /// has not moved since the ice fell asleep (the ground) does not wake it.
  bool reached_by(std::size_t index, const Body& body, const ExternalLoad& load, double dt) const;

 private:
  double sleep_speed_, crossing_time_, margin_;
  bool asleep_ = false;
  double quiet_time_ = 0;
  Vec3 lower_ = Vec3::Zero(), upper_ = Vec3::Zero();  // of the sleeping ice, m
  std::vector<rigid::State> bodies_;                  // when it fell asleep
};

}  // namespace nilas

#pragma GCC visibility pop
