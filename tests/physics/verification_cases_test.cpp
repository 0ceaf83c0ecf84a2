// Every verification case with the preset `nilas`, at the resolutions that are cheap enough for a test: tolerances hold
// from the stated resolution on, but for those that the case itself names as missed, and the error falls with the order
// that the method has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/accuracy/catalogue.hpp"

namespace nilas::cases {
namespace {

class VerificationCases : public testing::TestWithParam<VerificationCase> {};

TEST_P(VerificationCases, HoldTheirTolerancesAndOrders) {
  const VerificationCase& problem = GetParam();
  std::vector<Measurement> runs;
  std::vector<double> worst(problem.metrics.size(), 0);  // from the stated resolution on
  for (std::size_t k = 0; k < problem.tested; ++k) {
    runs.push_back(problem.run(nilas_scheme(), problem.resolutions[k]));
    const Measurement& m = runs.back();
    ASSERT_EQ(m.errors.size(), problem.metrics.size());
    for (std::size_t n = 0; n < m.errors.size(); ++n) {
      const Metric& metric = problem.metrics[n];
      RecordProperty(metric.name + " at " + std::to_string(problem.resolutions[k]), std::to_string(m.errors[n]));
      if (problem.resolutions[k] >= problem.stated_resolution) worst[n] = std::max(worst[n], m.errors[n]);
    }
  }
  for (std::size_t n = 0; n < problem.metrics.size(); ++n) {
    const Metric& metric = problem.metrics[n];
    if (problem.tested == 0 || problem.resolutions[problem.tested - 1] < problem.stated_resolution) break;
    if (std::isnan(metric.tolerance)) continue;
    EXPECT_EQ(worst[n] > metric.tolerance, metric.missed) << metric.name << ": " << worst[n];
  }
  if (runs.size() < 2) return;
  const Measurement &coarse = runs[runs.size() - 2], &fine = runs.back();
  for (std::size_t n = 0; n < problem.metrics.size(); ++n) {
    if (std::isnan(problem.metrics[n].least_order)) continue;
    EXPECT_GE(std::log(coarse.errors[n] / fine.errors[n]) / std::log(coarse.resolution / fine.resolution),
              problem.metrics[n].least_order)
        << problem.metrics[n].name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, VerificationCases, testing::ValuesIn(verification_cases()), [](const auto& test) {
  std::string name = test.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
}  // namespace nilas::cases
