#include "cases/accuracy/front.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace nilas::cases {

namespace {

constexpr double kNoticeable = 1.1;

using Rows = std::vector<const AccuracyRow*>;

/// Rows by metric, only those that several schemes ran.
std::vector<Rows> compared(const std::vector<AccuracyRow>& rows) {
  std::vector<Rows> groups;
  std::map<std::string, std::size_t> index;
  for (const AccuracyRow& row : rows) {
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

std::vector<Ablation> ablation(const std::vector<AccuracyRow>& rows) {
  if (rows.empty()) return {};
  const std::string& base = rows.front().scheme;
  struct Ratios {
    std::vector<double> error, time;
  };
  std::map<std::string, Ratios> ratios;
  std::vector<Ablation> result;
  for (const Rows& group : compared(rows))
    for (const AccuracyRow* row : group) {
      if (row->scheme == base) continue;
      const auto same = std::find_if(group.begin(), group.end(), [&](const AccuracyRow* other) {
        return other->scheme == base && other->spacing == row->spacing;
      });
      if (same == group.end()) continue;
      auto at = std::find_if(result.begin(), result.end(), [&](auto& a) { return a.scheme == row->scheme; });
      if (at == result.end()) at = result.insert(result.end(), Ablation{row->scheme});
      if (!std::isfinite(row->error)) {
        ++at->failed;
        continue;
      }
      const double error = row->error / (*same)->error;
      ratios[row->scheme].error.push_back(error);
      ratios[row->scheme].time.push_back(row->cpu_time / (*same)->cpu_time);
      at->better += error < 1 / kNoticeable;
      at->worse += error > kNoticeable;
    }
  for (Ablation& a : result) {
    a.error_ratio = median(ratios[a.scheme].error);
    a.time_ratio = median(ratios[a.scheme].time);
  }
  return result;
}

}  // namespace nilas::cases
