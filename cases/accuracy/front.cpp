#include "cases/accuracy/front.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace nilas::cases {

namespace {

constexpr double kNoticeable = 1.1;
constexpr double kRoundOff = 1e-9;  // a metric with a tolerance below is a check, not an error to be bought down

using Rows = std::vector<const AccuracyRow*>;

/// Rows by metric, only those that several schemes ran.
std::vector<Rows> compared(const std::vector<AccuracyRow>& rows) {
  std::vector<Rows> groups;
  std::map<std::string, std::size_t> index;
  for (const AccuracyRow& row : rows) {
    if (row.tolerance && *row.tolerance < kRoundOff) continue;
    const auto [at, fresh] = index.emplace(row.problem, groups.size());
    if (fresh) groups.emplace_back();
    groups[at->second].push_back(&row);
  }
  std::erase_if(groups, [](const Rows& group) {
    return std::all_of(group.begin(), group.end(), [&](auto* row) { return row->scheme == group.front()->scheme; });
  });
  return groups;
}

bool dominated(const AccuracyRow& row, const Rows& others) {
  return std::any_of(others.begin(), others.end(), [&](const AccuracyRow* other) {
    return other->scheme != row.scheme && other->error < row.error && other->cpu_time < row.cpu_time;
  });
}

double median(std::vector<double> values) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

}  // namespace

std::vector<FrontCount> pareto_front(const std::vector<AccuracyRow>& rows) {
  std::vector<FrontCount> counts;
  const auto count_of = [&](const std::string& scheme) -> FrontCount& {
    for (FrontCount& count : counts)
      if (count.scheme == scheme) return count;
    return counts.emplace_back(FrontCount{scheme});
  };
  for (const Rows& group : compared(rows)) {
    std::map<std::string, bool> on_front;
    for (const AccuracyRow* row : group) on_front[row->scheme] |= std::isfinite(row->error) && !dominated(*row, group);
    for (const auto& [scheme, front] : on_front) {
      FrontCount& count = count_of(scheme);
      ++count.metrics;
      count.on_front += front;
    }
  }
  std::stable_sort(counts.begin(), counts.end(), [](auto& a, auto& b) { return a.on_front > b.on_front; });
  return counts;
}

std::optional<double> time_to_tolerance(const Rows& runs, double tolerance) {
  Rows sorted = runs;
  std::sort(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return a->spacing > b->spacing; });
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    if (!(sorted[k]->error <= tolerance)) continue;
    if (k == 0 || !(sorted[k]->error > 0) || !std::isfinite(sorted[k - 1]->error)) return sorted[k]->cpu_time;
    const double share = std::log(sorted[k - 1]->error / tolerance) / std::log(sorted[k - 1]->error / sorted[k]->error);
    return sorted[k - 1]->cpu_time * std::pow(sorted[k]->cpu_time / sorted[k - 1]->cpu_time, share);
  }
  return {};
}

namespace {

Rows of_scheme(const Rows& group, const std::string& scheme) {
  Rows rows;
  for (const AccuracyRow* row : group)
    if (row->scheme == scheme) rows.push_back(row);
  return rows;
}

std::optional<double> tolerance_of(const Rows& group) {
  for (const AccuracyRow* row : group)
    if (row->tolerance) return row->tolerance;
  return {};
}

Ablation compare(const std::string& scheme, const std::string& base, const std::vector<Rows>& groups) {
  Ablation a{scheme};
  std::vector<double> errors, times, times_to_tolerance;
  for (const Rows& group : groups) {
    const Rows own = of_scheme(group, scheme), bases = of_scheme(group, base);
    for (const AccuracyRow* row : own)
      for (const AccuracyRow* other : bases) {
        if (other->spacing != row->spacing) continue;
        if (!std::isfinite(row->error)) {
          ++a.failed;
        } else if (other->error > 0 && std::isfinite(other->error)) {
          errors.push_back(row->error / other->error);
          times.push_back(row->cpu_time / other->cpu_time);
        }
      }
    const auto tolerance = tolerance_of(group);
    if (!tolerance) continue;
    const auto time = time_to_tolerance(own, *tolerance), base_time = time_to_tolerance(bases, *tolerance);
    a.reached += time.has_value();
    if (time && base_time) times_to_tolerance.push_back(*time / *base_time);
  }
  a.better = static_cast<std::size_t>(
      std::count_if(errors.begin(), errors.end(), [](double e) { return e < 1 / kNoticeable; }));
  a.worse =
      static_cast<std::size_t>(std::count_if(errors.begin(), errors.end(), [](double e) { return e > kNoticeable; }));
  a.error_ratio = median(errors);
  a.time_ratio = median(times);
  a.time_to_tolerance_ratio = median(times_to_tolerance);
  return a;
}

}  // namespace

std::vector<Ablation> ablation(const std::vector<AccuracyRow>& rows) {
  const std::vector<Rows> groups = compared(rows);
  std::vector<std::string> schemes;
  for (const Rows& group : groups)
    for (const AccuracyRow* row : group)
      if (std::find(schemes.begin(), schemes.end(), row->scheme) == schemes.end()) schemes.push_back(row->scheme);
  std::vector<Ablation> result;
  for (const std::string& scheme : schemes) result.push_back(compare(scheme, schemes.front(), groups));
  return result;
}

}  // namespace nilas::cases
