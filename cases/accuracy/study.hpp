// Runs verification cases over resolutions and schemes, and judges the results.
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "cases/accuracy/verification_case.hpp"

namespace nilas::cases {

/// One metric of one run: a line of accuracy.csv.
struct AccuracyRow {
  std::string problem;  // case and metric, "V9-elastic-pulse: arrival"
  std::string scheme;
  double spacing = 0;  // m, 0 without ice
  std::size_t particles = 0, steps = 0;
  double cpu_time = 0;          // s, of the whole case at this resolution
  double error = 0;             // not finite if the run failed
  std::optional<double> order;  // against the next coarser resolution
  std::optional<double> tolerance;
  std::optional<bool> pass;  // nothing to pass: empty
  std::string remark;        // why it failed
};

struct StudyPlan {
  std::vector<VerificationCase> cases;
  std::vector<Scheme> schemes;  // the first one judges; the others run what a case has them compared at
  bool quick = false;           // only the quick resolutions
  int jobs = 1;                 // runs at a time, one thread each
};

/// Runs the plan. progress(text) is called, one call at a time, when a run is done. Rows are ordered by case, scheme,
/// metric, resolution. A numerical failure is a row that does not pass, with its message as the remark.
std::vector<AccuracyRow> run_study(const StudyPlan& plan, const std::function<void(const std::string&)>& progress);

}  // namespace nilas::cases
