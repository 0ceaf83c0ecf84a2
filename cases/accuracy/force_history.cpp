#include "cases/accuracy/force_history.hpp"

#include <algorithm>

namespace nilas::cases {

void ForceHistory::add(double time, double impulse) {
  time_.push_back(time);
  impulse_.push_back(impulse);
}

double ForceHistory::impulse(double time) const {
  const auto after = std::upper_bound(time_.begin(), time_.end(), time);
  if (after == time_.begin()) return impulse_.front();
  if (after == time_.end()) return impulse_.back();
  const auto k = static_cast<std::size_t>(after - time_.begin());
  const double share = (time - time_[k - 1]) / (time_[k] - time_[k - 1]);
  return impulse_[k - 1] + share * (impulse_[k] - impulse_[k - 1]);
}

double ForceHistory::peak(double window) const {
  double largest = 0;
  for (const double t : time_) largest = std::max(largest, mean(t - window / 2, t + window / 2));
  return largest;
}

double ForceHistory::time_above(double level, double window) const {
  const auto above = [&](double t) { return mean(t - window / 2, t + window / 2) > level; };
  const auto first = std::find_if(time_.begin(), time_.end(), above);
  const auto last = std::find_if(time_.rbegin(), time_.rend(), above);
  return first == time_.end() ? 0 : *last - *first;
}

}  // namespace nilas::cases
