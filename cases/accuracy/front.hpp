// What a choice of numerics costs and buys: Pareto fronts of error against run time, and ablation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/accuracy/study.hpp"

namespace nilas::cases {

/// How often a scheme is on the front: of how many metrics no other scheme's run is both cheaper and more accurate
/// than each of its runs.
struct FrontCount {
  std::string scheme;
  std::size_t on_front = 0, metrics = 0;
};
/// Over the metrics that more than one scheme ran, most often on the front first.
std::vector<FrontCount> pareto_front(const std::vector<AccuracyRow>& rows);

/// CPU time that a scheme needs to bring a metric down to its tolerance, by interpolation in the logarithms between two
/// resolutions; that of the coarsest run if it is good enough already. Nothing if no run is.
std::optional<double> time_to_tolerance(const std::vector<const AccuracyRow*>& runs, double tolerance);

/// A scheme against the first one of the table, at the same spacing: medians over all metrics of the ratios of error
/// and of CPU time, and failures.
struct Ablation {
  std::string scheme;
  double error_ratio = 0, time_ratio = 0;
  std::size_t better = 0, worse = 0;   // metrics whose error fell or rose by more than a tenth
  std::size_t failed = 0;              // runs that ended in a numerical failure
  std::size_t reached = 0;             // metrics whose tolerance some resolution reached
  double time_to_tolerance_ratio = 0;  // median over the metrics whose tolerance both reached
};
/// The first scheme itself comes first, with ratios of 1.
std::vector<Ablation> ablation(const std::vector<AccuracyRow>& rows);

}  // namespace nilas::cases
