#include "sph/kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nilas::sph {
namespace {

const double lengths[] = {1e-3, 0.026, 1.0, 40.0};  // h, m

// The integrand is a polynomial of degree 7 in r: Gauss-Legendre with five points is exact.
double integral_over_space(const WendlandC2& kernel) {
  const double x[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
  const double w[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                      0.2369268850561891};
  const double half = 0.5 * kernel.support_radius();
  double sum = 0;
  for (int i = 0; i < 5; ++i) {
    const double r = half * (1 + x[i]);
    sum += w[i] * half * 4 * std::numbers::pi * r * r * kernel.value(r);
  }
  return sum;
}

TEST(WendlandC2, IntegratesToOne) {
  for (const double h : lengths) EXPECT_NEAR(integral_over_space(WendlandC2(h)), 1, 1e-10);
}

TEST(WendlandC2, ValueAtTheCentreIsTheNormalisation) {
  for (const double h : lengths) EXPECT_NEAR(WendlandC2(h).value(0) * h * h * h, 21 / (16 * std::numbers::pi), 1e-14);
}

TEST(WendlandC2, GradientIsTheDerivativeOfTheValue) {
  for (const double h : lengths) {
    const WendlandC2 kernel(h);
    const double steepest = kernel.value(0) / h;
    for (int n = 1; n < 40; ++n) {
      const double r = n * h / 20, e = 1e-4 * h;
      const double slope = (kernel.value(r + e) - kernel.value(r - e)) / (2 * e);
      EXPECT_NEAR(kernel.gradient_factor(r) * r / steepest, slope / steepest, 1e-6) << "q = " << r / h;
    }
  }
}

TEST(WendlandC2, DecreasesMonotonicallyInsideItsSupport) {
  const WendlandC2 kernel(0.5);
  for (int n = 1; n < 100; ++n) EXPECT_LT(kernel.value(n * 0.01), kernel.value((n - 1) * 0.01));
}

TEST(WendlandC2, VanishesAtTheEndOfItsSupportAndBeyond) {
  for (const double h : lengths) {
    const WendlandC2 kernel(h);
    EXPECT_EQ(kernel.support_radius(), 2 * h);
    for (const double q : {2.0, 2.0000001, 3.0, 1e6}) {
      EXPECT_EQ(kernel.value(q * h), 0);
      EXPECT_EQ(kernel.gradient_factor(q * h), 0);
    }
    EXPECT_GT(kernel.value(1.99 * h), 0);
    EXPECT_LT(kernel.gradient_factor(1.99 * h), 0);
  }
}

TEST(WendlandC2, GradientIsFiniteAndZeroAtCoincidence) {
  const WendlandC2 kernel(0.026);
  EXPECT_TRUE(std::isfinite(kernel.gradient_factor(0)));
  EXPECT_EQ(kernel.gradient_factor(0) * 0.0, 0);
  EXPECT_EQ(kernel.gradient_factor(0), kernel.gradient_scale());
}

TEST(WendlandC2, LoopFormWithTheGradientScaleIsTheSameGradient) {
  const WendlandC2 kernel(0.3);
  for (int n = 0; n <= 50; ++n) {
    const double r = n * 0.01, t = 1 - r / (2 * 0.3);
    EXPECT_NEAR(kernel.gradient_scale() * t * t * t, kernel.gradient_factor(r), 1e-12 * -kernel.gradient_scale());
  }
}

}  // namespace
}  // namespace nilas::sph
