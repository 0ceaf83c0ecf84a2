// The exact solutions of the contact and rigid-body cases, each found a second way.
#include "cases/accuracy/contact_oracles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "cases/accuracy/force_history.hpp"
#include "cases/accuracy/free_top.hpp"

namespace nilas::cases {
namespace {

using std::numbers::pi;

TEST(ModeOfMassOnBar, HasTheTabulatedRoots) {
  EXPECT_NEAR(mode_of_mass_on_bar(0.1), 0.31105, 5e-6);
  EXPECT_NEAR(mode_of_mass_on_bar(0.5), 0.65327, 5e-6);
  EXPECT_NEAR(mode_of_mass_on_bar(1), 0.86033, 5e-6);
  EXPECT_NEAR(mode_of_mass_on_bar(2), 1.07687, 5e-6);
  EXPECT_NEAR(mode_of_mass_on_bar(10), 1.42887, 5e-6);
}

TEST(ModeOfMassOnBar, IsTheSpringAndTheFreeBarAtItsLimits) {
  // A third of a light bar moves with the mass (Rayleigh); a heavy bar swings as if its end were free.
  EXPECT_NEAR(mode_of_mass_on_bar(1e-4), std::sqrt(1e-4 / (1 + 1e-4 / 3)), 1e-9);
  EXPECT_NEAR(mode_of_mass_on_bar(1e9), pi / 2, 1e-8);
}

// The values of the project's physics reference, found there by an ODE.
TEST(HertzImpact, HasTheReferencesValues) {
  const double radius = 0.03, mass = 4. / 3 * pi * std::pow(radius, 3) * 900, modulus = 9.38e9 / (1 - 0.33 * 0.33);
  const HertzImpact plane(mass, radius, modulus, 1);
  EXPECT_NEAR(plane.indentation, 77.18e-6, 5e-9);
  EXPECT_NEAR(plane.force, 1648.4, 0.05);
  EXPECT_NEAR(plane.duration, 227.2e-6, 0.05e-6);
  EXPECT_NEAR(plane.contact_radius, 1.52e-3, 5e-6);
  const HertzImpact spheres(mass / 2, radius / 2, modulus / 2, 1);
  EXPECT_NEAR(spheres.indentation, 88.66e-6, 5e-9);
  EXPECT_NEAR(spheres.force, 717.53, 0.05);
  EXPECT_NEAR(spheres.duration, 260.9e-6, 0.1e-6);
}

TEST(HertzImpact, StaysAboveATenthOfItsForceAsLongAsTheEquationOfMotionSays) {
  // d'' = -5/4 d^(3/2), d(0) = 0, d'(0) = 1: largest d and largest force over it 1; leapfrog.
  const double dt = 1e-5;
  double d = 0, v = 1, total = 0, above = 0;
  while (d >= 0) {
    d += 0.5 * dt * v;
    v -= 1.25 * dt * std::pow(std::max(0.0, d), 1.5);
    d += 0.5 * dt * v;
    total += dt;
    if (std::pow(std::max(0.0, d), 1.5) > 0.1) above += dt;
  }
  EXPECT_NEAR(total, 2.9433, 1e-3);
  EXPECT_NEAR(hertz_time_above(0.1), above / total, 1e-4);
}

// Oracle: potential f(r, t) cos(theta) of the dipole, f_tt = f_rr + 2 f_r/r - 2 f/r^2 from r = 1 on (a = c = rho = 1),
// f_r = v at the sphere, M v' = (4/3) pi f_t, by finite differences in r and leapfrog in time.
std::vector<double> sphere_by_finite_differences(double mass_ratio, double end, double dr) {
  const double dt = 0.5 * dr;
  const auto cells = static_cast<std::size_t>((1.2 + end) / dr);  // the wave does not reach the far end
  std::vector<double> f(cells, 0), before(cells, 0), velocities;
  double v = 1;
  for (int step = 0; step * dt < end; ++step) {
    std::vector<double> next(cells, 0);
    for (std::size_t k = 0; k + 1 < cells; ++k) {
      const double r = 1 + (static_cast<double>(k) + 0.5) * dr;  // cell centres; flux form of the spherical Laplacian
      const double outer = std::pow(r + dr / 2, 2) * (f[k + 1] - f[k]) / dr;
      const double inner = k > 0 ? std::pow(r - dr / 2, 2) * (f[k] - f[k - 1]) / dr : v;
      next[k] = 2 * f[k] - before[k] + dt * dt * ((outer - inner) / dr - 2 * f[k]) / (r * r);
    }
    // Force on the sphere: INT p cos(theta) dA with p = -f_t cos(theta), f taken from the first cells to r = 1.
    const auto at_sphere = [&](const std::vector<double>& g) { return 1.5 * g[0] - 0.5 * g[1]; };
    v += mass_ratio * (at_sphere(next) - at_sphere(f));  // m = 4/3 pi
    before = f;
    f = next;
    velocities.push_back(v);
  }
  return velocities;
}

TEST(SphereInFluid, FollowsTheWaveEquation) {
  for (const double mass_ratio : {0.3, 1.0, 1.7}) {
    const SphereInFluid exact(mass_ratio);
    const double dr = 2e-3;
    const std::vector<double> v = sphere_by_finite_differences(mass_ratio, 4, dr);
    for (std::size_t k = 100; k < v.size(); k += 100)
      EXPECT_NEAR(v[k], exact.velocity(0.5 * dr * static_cast<double>(k + 1)), 3e-3) << mass_ratio << " " << k;
  }
}

TEST(SphereInFluid, EndsWithHalfOfTheDisplacedMassAdded) {
  for (const double mass_ratio : {0.1, 1.0, 1.9})
    EXPECT_NEAR(SphereInFluid(mass_ratio).velocity(60), 1 / (1 + mass_ratio / 2), 1e-12);
}

TEST(SphereInFluid, PathIsTheIntegralOfVelocity) {
  const SphereInFluid sphere(1);
  double sum = 0;
  for (int k = 0; k < 4000; ++k) sum += 1e-3 * sphere.velocity(1e-3 * (k + 0.5));
  EXPECT_NEAR(sphere.path(4), sum, 1e-6);
}

/// Euler's equations by classical Runge-Kutta.
Vec3 runge_kutta(Vec3 w, double time, int steps) {
  const auto rate = [](const Vec3& x) {
    return Vec3(Vec3(top_inertia.cwiseProduct(x)).cross(x).cwiseQuotient(top_inertia));
  };
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const Vec3 k1 = rate(w), k2 = rate(w + h / 2 * k1), k3 = rate(w + h / 2 * k2), k4 = rate(w + h * k3);
    w += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return w;
}

TEST(JacobisValues, AreThoseOfRungeKutta) {
  for (const auto& [time, exact] : euler_top_samples)
    EXPECT_LT((runge_kutta(Vec3::Ones(), time, 20000) - exact).norm(), 2e-9) << time;
  for (const auto& [time, exact] : dzhanibekov_samples)
    EXPECT_LT((runge_kutta({0.01, 5, 0.01}, time, 20000) - exact).norm(), 2e-8) << time;
}

TEST(ForceHistory, HasThePeakAndTheDurationOfAHalfSine) {
  ForceHistory history;
  for (int k = 1; k <= 1500; ++k)  // force sin(pi t) up to t = 1, then none
    history.add(1e-3 * k, k < 1000 ? (1 - std::cos(pi * 1e-3 * k)) / pi : 2 / pi);
  EXPECT_NEAR(history.mean(0, 1), 2 / pi, 1e-6);
  EXPECT_NEAR(history.peak(0.1), std::sin(pi * 0.05) / (pi * 0.05), 1e-6);
  EXPECT_NEAR(history.time_above(0.5, 1e-6), 2. / 3, 3e-3);
  EXPECT_EQ(history.impulse(2), history.impulse(1.5));
}

}  // namespace
}  // namespace nilas::cases
