#include "cases/accuracy/study.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <mutex>
#include <thread>

#include "cases/accuracy/convergence.hpp"
#include "sph/ice.hpp"

namespace nilas::cases {

namespace {

/// One run of one case.
struct Run {
  const VerificationCase* problem;
  const Scheme* scheme;
  int resolution;
  Measurement result = {};
  double cpu_time = 0;
  std::string failure = {};
};

double thread_cpu_time() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void perform(Run& run) {
  const double start = thread_cpu_time();
  try {
    run.result = run.problem->run(*run.scheme, run.resolution);
  } catch (const sph::NumericalFailure& failure) {
    run.failure = failure.what();
  } catch (const std::exception& error) {  // would end the program from a thread of its own
    run.failure = std::string("not a numerical failure: ") + error.what();
  }
  if (!run.failure.empty()) run.result.errors.assign(run.problem->metrics.size(), INFINITY);
  run.cpu_time = thread_cpu_time() - start;
}

std::vector<Run> plan_runs(const StudyPlan& plan) {
  std::vector<Run> runs;
  for (const VerificationCase& problem : plan.cases) {
    const std::size_t levels = plan.quick ? problem.quick : problem.resolutions.size();
    for (std::size_t s = 0; s < plan.schemes.size(); ++s)
      for (std::size_t k = 0; k < (s == 0 ? levels : std::min(levels, problem.compared)); ++k)
        runs.push_back({&problem, &plan.schemes[s], problem.resolutions[k]});
  }
  return runs;
}

AccuracyRow judge(const Run& run, const Run* coarser, bool finest, std::size_t n) {
  const Metric& metric = run.problem->metrics[n];
  AccuracyRow row;
  row.problem = run.problem->name + ": " + metric.name;
  row.scheme = run.scheme->name;
  row.spacing = run.result.spacing;
  row.particles = run.result.particles;
  row.steps = run.result.steps;
  row.cpu_time = run.cpu_time;
  row.error = run.result.errors[n];
  row.remark = run.failure;
  if (coarser)
    row.order = observed_order(coarser->result.errors[n], coarser->result.resolution, row.error, run.result.resolution);
  if (!std::isnan(metric.tolerance) && run.resolution >= run.problem->stated_resolution) {
    row.tolerance = metric.tolerance;
    row.pass = row.error <= metric.tolerance;
  }
  if (!run.failure.empty()) row.pass = false;
  if (!std::isnan(metric.least_order) && finest && coarser) {
    const bool fast = row.order && *row.order >= metric.least_order;
    row.pass = row.pass.value_or(true) && fast;
    if (!fast) row.remark += fmt::format("order below {}", metric.least_order);
  }
  return row;
}

/// Rows of the runs first..last, which are one case with one scheme.
void append_rows(const Run* first, const Run* last, std::vector<AccuracyRow>& rows) {
  for (std::size_t n = 0; n < first->problem->metrics.size(); ++n)
    for (const Run* run = first; run != last; ++run)
      rows.push_back(judge(*run, run == first ? nullptr : run - 1, run + 1 == last, n));
}

}  // namespace

std::vector<AccuracyRow> run_study(const StudyPlan& plan, const std::function<void(const std::string&)>& progress) {
  std::vector<Run> runs = plan_runs(plan);
  std::atomic<std::size_t> next = 0;
  std::mutex reporting;
  std::size_t done = 0;
  const auto work = [&] {
    omp_set_num_threads(1);  // of this thread only
    for (std::size_t k = next++; k < runs.size(); k = next++) {
      perform(runs[k]);
      const std::lock_guard lock(reporting);
      progress(fmt::format("{:>4} of {}  {}, {}, resolution {}: {:.1f} s{}", ++done, runs.size(), runs[k].problem->name,
                           runs[k].scheme->name, runs[k].resolution, runs[k].cpu_time,
                           runs[k].failure.empty() ? "" : ", failed"));
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int n = 0; n < plan.jobs; ++n) workers.emplace_back(work);
  }

  std::vector<AccuracyRow> rows;
  for (std::size_t first = 0; first < runs.size();) {
    std::size_t last = first;
    while (last < runs.size() && runs[last].problem == runs[first].problem && runs[last].scheme == runs[first].scheme)
      ++last;
    append_rows(&runs[first], &runs[0] + last, rows);
    first = last;
  }
  return rows;
}

}  // namespace nilas::cases
