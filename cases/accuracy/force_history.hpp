// The force between ice and a body over time, as its impulse: what contact cases take their figures from.
#pragma once

#include <vector>

namespace nilas::cases {

class ForceHistory {
 public:
  /// impulse [N s]: from the start, at time 0, to `time` [s]; times in ascending order.
  void add(double time, double impulse);

  /// Impulse up to `time`, linear between samples, constant before the first and after the last.
  double impulse(double time) const;
  /// Force averaged over [from, to] [N].
  double mean(double from, double to) const { return (impulse(to) - impulse(from)) / (to - from); }
  /// Largest force averaged over `window` [s], centred on a sample [N].
  double peak(double window) const;
  /// Time between the first and the last sample at which the force, averaged over `window`, exceeds `level` [N].
  double time_above(double level, double window) const;

 private:
  std::vector<double> time_{0}, impulse_{0};
};

}  // namespace nilas::cases
