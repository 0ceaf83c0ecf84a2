// The references that verification cases compute themselves, against independent forms and published values.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/accuracy/breathing_sphere.hpp"

namespace nilas::cases {
namespace {

// Independent form: the traction of the radial displacement u = d/dr (sin(kr)/r) on the surface,
// sigma_rr = (lambda + 2 mu) u' + 2 lambda u/r, by central differences, with lambda/mu = 2 nu/(1 - 2 nu).
double surface_traction(double x, double nu) {
  const auto potential = [x](double r) { return std::sin(x * r) / r; };
  const auto u = [&](double r) { return (potential(r + 1e-4) - potential(r - 1e-4)) / 2e-4; };
  const double lambda = 2 * nu / (1 - 2 * nu);
  return (lambda + 2) * (u(1 + 1e-4) - u(1 - 1e-4)) / 2e-4 + 2 * lambda * u(1);
}

TEST(BreathingRoot, LeavesTheSurfaceOfTheSphereFreeOfTraction) {
  for (const double nu : {0., 0.1, 0.25, 0.33, 0.45}) {
    const double x = breathing_root(nu);
    EXPECT_LT(surface_traction(x * (1 - 1e-5), nu) * surface_traction(x * (1 + 1e-5), nu), 0) << "nu = " << nu;
  }
}

TEST(BreathingRoot, HasThePublishedValues) {
  EXPECT_NEAR(breathing_root(0.25), 2.5634, 5e-5);
  EXPECT_NEAR(breathing_root(0.30), 2.6702, 5e-5);
  EXPECT_NEAR(breathing_root(0.33), 2.7363, 5e-5);
}

// An incompressible sphere breathes where its surface is a node of the pressure: x = pi.
TEST(BreathingRoot, TendsToPiForIncompressibleSolids) { EXPECT_NEAR(breathing_root(0.49999), std::numbers::pi, 1e-3); }

}  // namespace
}  // namespace nilas::cases
