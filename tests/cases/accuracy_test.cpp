#include <gtest/gtest.h>

#include <cmath>

#include "cases/accuracy/accuracy_report.hpp"
#include "cases/accuracy/convergence.hpp"
#include "cases/accuracy/front.hpp"
#include "cases/accuracy/study.hpp"
#include "sph/ice.hpp"

namespace nilas::cases {
namespace {

TEST(ObservedOrder, IsThatOfAPowerLaw) {
  EXPECT_NEAR(*observed_order(3 * std::pow(0.3, 1.7), 0.3, 3 * std::pow(0.2, 1.7), 0.2), 1.7, 1e-12);
  EXPECT_FALSE(observed_order(0, 0.3, 0.1, 0.2));
  EXPECT_FALSE(observed_order(0.1, 0.3, INFINITY, 0.2));
}

// The worked example of Celik et al. 2008: N = 18000, 8000, 4500 cells, reattachment lengths 6.063, 5.972, 5.863.
TEST(GridConvergence, AgreesWithTheWorkedExampleOfItsSource) {
  const GridConvergence c = grid_convergence({2, 1.5, 1}, {5.863, 5.972, 6.063});
  EXPECT_TRUE(c.monotone);
  EXPECT_NEAR(c.order, 1.53, 0.005);
  EXPECT_NEAR(c.extrapolated, 6.1685, 5e-4);
  EXPECT_NEAR(c.index, 0.022, 5e-4);
}

TEST(GridConvergence, ExtrapolatesAPowerLawExactly) {
  const auto f = [](double h) { return 7 - 2 * std::pow(h, 1.3); };
  const GridConvergence c = grid_convergence({0.4, 0.3, 0.2}, {f(0.4), f(0.3), f(0.2)});
  EXPECT_NEAR(c.order, 1.3, 1e-9);
  EXPECT_NEAR(c.extrapolated, 7, 1e-9);
}

TEST(GridConvergence, ClaimsNoOrderForValuesThatDriftApart) {
  const GridConvergence c = grid_convergence({4, 2, 1}, {0, -1, -3});
  EXPECT_FALSE(c.monotone);
  EXPECT_EQ(c.extrapolated, -3);
  const auto f = [](double h) { return 7 + 2 / h; };
  EXPECT_FALSE(grid_convergence({3, 2, 1.5}, {f(3), f(2), f(1.5)}).monotone);
}

TEST(GridConvergence, ClaimsNoOrderForValuesThatGoBackAndForth) {
  const GridConvergence c = grid_convergence({3, 2, 1}, {1.0, 1.2, 1.1});
  EXPECT_FALSE(c.monotone);
  EXPECT_EQ(c.extrapolated, 1.1);
  EXPECT_NEAR(c.index, 3 * 0.2 / 1.1, 1e-12);
}

/// A case whose error is known: (spacing)^2 scaled by the scheme's viscosity; fails on demand.
VerificationCase known_case(double tolerance, double least_order) {
  return {.name = "known",
          .title = "",
          .reference = "",
          .metrics = {{"value", tolerance, least_order}},
          .resolutions = {1, 2, 4},
          .stated_resolution = 2,
          .quick = 2,
          .tested = 1,
          .compared = 3,
          .run = [](const Scheme& scheme, int n) {
            if (scheme.numerics.cfl > 1) throw sph::NumericalFailure("too fast");
            const double spacing = 1. / n;
            return Measurement{spacing, spacing, 10, 20, {scheme.numerics.viscosity_alpha * spacing * spacing}};
          }};
}
std::vector<AccuracyRow> study(const VerificationCase& problem, double alpha, double cfl) {
  Scheme scheme{"a", {}, {}};
  scheme.numerics.viscosity_alpha = alpha;
  scheme.numerics.cfl = cfl;
  return run_study(StudyPlan{{problem}, std::vector{scheme}, false, 2}, [](const std::string&) {});
}

TEST(AccuracyStudy, JudgesFromTheStatedResolutionOnAndMeasuresTheOrder) {
  const auto rows = study(known_case(0.02, 1.9), 0.1, 0.6);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_FALSE(rows[0].pass);
  EXPECT_FALSE(rows[0].order);
  EXPECT_EQ(rows[1].pass, std::optional(false));  // 0.025
  EXPECT_NEAR(*rows[1].order, 2, 1e-12);
  EXPECT_EQ(rows[2].pass, std::optional(true));  // 0.00625
}

TEST(AccuracyStudy, AMissedOrderIsAMiss) {
  const auto rows = study(known_case(1, 2.1), 0.1, 0.6);
  EXPECT_EQ(rows[1].pass, std::optional(true));
  EXPECT_EQ(rows[2].pass, std::optional(false));
  EXPECT_NE(rows[2].remark, "");
}

TEST(AccuracyStudy, ANumericalFailureIsARowThatDoesNotPass) {
  const auto rows = study(known_case(1, Metric::none), 0.1, 2);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].pass, std::optional(false));
  EXPECT_EQ(rows[1].remark, "too fast");
}

TEST(ParetoFront, HoldsWhatNothingBeatsInBothErrorAndTime) {
  const auto row = [](const char* scheme, double error, double time) {
    AccuracyRow r;
    r.problem = "p", r.scheme = scheme, r.error = error, r.cpu_time = time, r.spacing = 1;
    return r;
  };
  const std::vector<AccuracyRow> rows{row("base", 0.1, 1), row("better", 0.05, 2), row("worse", 0.2, 3)};
  const auto counts = pareto_front(rows);
  ASSERT_EQ(counts.size(), 3u);
  EXPECT_EQ(counts.back().scheme, "worse");
  EXPECT_EQ(counts.back().on_front, 0u);
  EXPECT_EQ(counts[0].on_front + counts[1].on_front, 2u);
  const auto terms = ablation(rows);
  ASSERT_EQ(terms.size(), 3u);
  EXPECT_EQ(terms[0].error_ratio, 1);
  EXPECT_EQ(terms[1].error_ratio, 0.5);
  EXPECT_EQ(terms[1].time_ratio, 2);
  EXPECT_EQ(terms[2].worse, 1u);
}

TEST(TimeToTolerance, FollowsThePowerLawBetweenTwoResolutions) {
  AccuracyRow coarse, fine;
  coarse.spacing = 2, coarse.cpu_time = 1, coarse.error = 0.4;
  fine.spacing = 1, fine.cpu_time = 16, fine.error = 0.1;  // error ~ time^-1/2
  EXPECT_NEAR(*time_to_tolerance({&coarse, &fine}, 0.2), 4, 1e-12);
  EXPECT_NEAR(*time_to_tolerance({&fine, &coarse}, 0.5), 1, 1e-12);
  EXPECT_FALSE(time_to_tolerance({&coarse, &fine}, 0.05));
}

}  // namespace
}  // namespace nilas::cases
