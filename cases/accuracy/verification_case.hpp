// A verification case: a problem with an exact or trusted reference, run at several resolutions with any numerics.
//
// One set, shared by the tests, `nilas accuracy` and the report: a case measures, it does not judge. One file per case.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "cases/scheme.hpp"

namespace nilas::cases {

/// One quantity that a case compares with its reference.
struct Metric {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::string name;           // "arrival", "peak force": what the error is the error of
  double tolerance = none;    // largest error allowed from the stated resolution on; none: reported only
  double least_order = none;  // that the method has between the two finest resolutions; none: not asserted
  bool missed = false;        // the preset `nilas` is known to miss the tolerance: the tests expect it, so that a miss
                              // that has gone is news, too
};

/// One run of a case.
struct Measurement {
  double resolution = 0;  // what the order is measured against: the spacing [m], or the step [s] without ice
  double spacing = 0;     // m; 0 without ice
  std::size_t particles = 0;
  std::size_t steps = 0;
  std::vector<double> errors;  // one per metric, >= 0, relative unless the metric's name says otherwise
};

struct VerificationCase {
  std::string name;       // "V9-elastic-pulse"
  std::string title;      // one sentence
  std::string reference;  // what it is compared with, and where that comes from
  std::vector<Metric> metrics;
  /// Resolutions, coarse to fine, in the case's own measure (cells per width, steps per second...), at least three.
  std::vector<int> resolutions;
  int stated_resolution;      // the tolerances must hold from here on
  std::size_t quick, tested;  // how many of the resolutions `--quick` and the tests run
  std::size_t compared;       // how many of them every other scheme runs, too: 0 where that is dear or tells little
  /// Runs it on the calling thread. Throws sph::NumericalFailure.
  std::function<Measurement(const Scheme& scheme, int resolution)> run;
};

inline std::ostream& operator<<(std::ostream& out, const VerificationCase& c) { return out << c.name; }

}  // namespace nilas::cases
