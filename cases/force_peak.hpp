// Peak of a force history, raw and after a moving average, found while the run goes on.
#pragma once

#include <deque>

#include "sph/vector.hpp"

namespace nilas::cases {

/// The average at time t is (1/window) INT_{t-window}^{t} F dt with F zero before the first sample; the peak is the
/// largest magnitude of that average. Exact for forces that are constant over each step.
class ForcePeak {
 public:
  /// window [s]; 0: no averaging.
  explicit ForcePeak(double window) : window_(window) {}

  /// force [N]: mean over the step of length dt [s] that ends at `time` [s].
  void add(double time, double dt, const Vec3& force);

  double raw() const { return raw_; }                          // N, largest magnitude of a step's force
  double raw_time() const { return raw_time_; }                // s
  double filtered() const { return filtered_; }                // N
  double filtered_time() const { return filtered_time_; }      // s, middle of the window that gives the peak
  const Vec3& components() const { return components_; }       // N, of the average at the filtered peak
  const Vec3& largest_components() const { return largest_; }  // N, signed, each component's own filtered peak

 private:
  struct Sample {
    double dt;
    Vec3 force;
  };
  double window_;
  std::deque<Sample> samples_;   // those the window touches
  double duration_ = 0;          // s, of samples_
  Vec3 impulse_ = Vec3::Zero();  // N s, of samples_
  double raw_ = 0, raw_time_ = 0, filtered_ = 0, filtered_time_ = 0;
  Vec3 components_ = Vec3::Zero(), largest_ = Vec3::Zero();
};

}  // namespace nilas::cases
