// Progress of a run: a bar on a terminal, a line every few seconds otherwise.
#pragma once

#include <chrono>
#include <ostream>

#include "coupling/impact.hpp"

namespace nilas::cases {

class Progress {
 public:
  /// end_time [s] of the run.
  Progress(std::ostream& out, bool terminal, double end_time);
  /// After a sub-step; prints only when it is time to.
  void update(const Impact& impact);
  /// Ends the bar's line.
  void finish();
  double seconds() const;  // s, since construction

 private:
  using Clock = std::chrono::steady_clock;
  std::ostream& out_;
  bool terminal_;
  double end_time_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace nilas::cases
