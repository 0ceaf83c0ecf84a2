#include "cases/accuracy/contact_oracles.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace nilas::cases {

double mode_of_mass_on_bar(double ratio) {
  // beta sin beta - ratio cos beta rises from -ratio to pi/2 over [0, pi/2].
  double low = 0, high = std::numbers::pi / 2;
  for (int n = 0; n < 60; ++n) {
    const double beta = 0.5 * (low + high);
    (beta * std::sin(beta) < ratio * std::cos(beta) ? low : high) = beta;
  }
  return 0.5 * (low + high);
}

namespace {
/// INT_0^xi du / sqrt(1 - u^(5/2)): time to the share xi of the largest indentation, in d/v. With u = 1 - s^2 the
/// integrand is smooth; Simpson's rule.
double approach_time(double xi) {
  const auto f = [](double s) {
    const double u = 1 - s * s;
    return s > 1e-6 ? 2 * s / std::sqrt(1 - std::pow(u, 2.5)) : 2 / std::sqrt(2.5);
  };
  constexpr int intervals = 2000;
  const double from = std::sqrt(1 - xi), step = (1 - from) / intervals;
  double sum = f(from) + f(1);
  for (int n = 1; n < intervals; ++n) sum += (n % 2 ? 4 : 2) * f(from + n * step);
  return sum * step / 3;
}
}  // namespace

HertzImpact::HertzImpact(double m, double R, double E, double v) {
  indentation = std::pow(15 * m * v * v / (16 * E * std::sqrt(R)), 0.4);
  force = 4. / 3 * E * std::sqrt(R) * std::pow(indentation, 1.5);
  contact_radius = std::sqrt(R * indentation);
  duration = 2 * approach_time(1) * indentation / v;
}

double hertz_time_above(double level) { return 1 - approach_time(std::pow(level, 2. / 3)) / approach_time(1); }

SphereInFluid::SphereInFluid(double mass_ratio) : q_(2 + mass_ratio), w_(std::sqrt(q_ - q_ * q_ / 4)) {
  if (!(w_ > 0)) throw std::invalid_argument("SphereInFluid: mass ratio not below 2");
}

double SphereInFluid::velocity(double sigma) const {
  const double transient = std::cos(w_ * sigma) - q_ / (2 * w_) * std::sin(w_ * sigma);
  return 2 / q_ + (1 - 2 / q_) * std::exp(-q_ / 2 * sigma) * transient;
}

double SphereInFluid::path(double sigma) const {
  // INT exp(-q t/2) (cos w t - q/(2 w) sin w t) dt = exp(-q t/2) sin(w t) / w
  return 2 / q_ * sigma + (1 - 2 / q_) * std::exp(-q_ / 2 * sigma) * std::sin(w_ * sigma) / w_;
}

}  // namespace nilas::cases
