#include "cases/force_peak.hpp"

#include <cmath>

namespace nilas::cases {

void ForcePeak::add(double time, double dt, const Vec3& force) {
  if (force.norm() > raw_) raw_ = force.norm(), raw_time_ = time;

  Vec3 average = force;
  if (window_ > 0) {
    samples_.push_back({dt, force});
    impulse_ += dt * force;
    duration_ += dt;
    // Drop what has left the window; the oldest sample may still be in it with a part of its length.
    while (duration_ - samples_.front().dt >= window_) {
      duration_ -= samples_.front().dt;
      impulse_ -= samples_.front().dt * samples_.front().force;
      samples_.pop_front();
    }
    const double outside = std::max(0.0, duration_ - window_);
    average = (impulse_ - outside * samples_.front().force) / window_;
  }
  if (average.norm() > filtered_)
    filtered_ = average.norm(), filtered_time_ = time - 0.5 * window_, components_ = average;
  for (int k = 0; k < 3; ++k)
    if (std::abs(average[k]) > std::abs(largest_[k])) largest_[k] = average[k];
}

}  // namespace nilas::cases
