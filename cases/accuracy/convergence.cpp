#include "cases/accuracy/convergence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace nilas::cases {

namespace {

constexpr double kSafety = 1.25, kSafetyWithoutOrder = 3;
// An order outside this range says that the three grids are not yet in the range where an order means anything.
constexpr double kSmallestOrder = 0.2, kLargestOrder = 6;

/// Solves p = (ln(e32/e21) + q(p)) / ln(r21), q(p) = ln((r21^p - 1)/(r32^p - 1)), by iteration. Without the modulus
/// that the source has around the numerator: with it values that drift apart look as if they converged.
double observed_order(double r21, double r32, double ratio) {
  double p = std::log(ratio) / std::log(r21);
  for (int n = 0; n < 200; ++n) {
    if (p == 0) return 0;
    const double q = std::log((std::pow(r21, p) - 1) / (std::pow(r32, p) - 1));
    p = (std::log(ratio) + q) / std::log(r21);
  }
  return p;
}

}  // namespace

std::optional<double> observed_order(double coarse_error, double coarse_resolution, double fine_error,
                                     double fine_resolution) {
  if (!(coarse_error > 0) || !(fine_error > 0)) return {};
  const double order = std::log(coarse_error / fine_error) / std::log(coarse_resolution / fine_resolution);
  return std::isfinite(order) ? std::optional(order) : std::nullopt;
}

GridConvergence grid_convergence(const std::vector<double>& h, const std::vector<double>& f) {
  assert(h.size() == 3 && f.size() == 3 && h[0] > h[1] && h[1] > h[2]);
  const double e32 = f[0] - f[1], e21 = f[1] - f[2];
  const double r32 = h[0] / h[1], r21 = h[1] / h[2];
  if (e32 == 0 && e21 == 0) return {0, f[2], 0, true};
  if (e32 * e21 > 0) {
    const double p = observed_order(r21, r32, e32 / e21);
    if (p >= kSmallestOrder && p <= kLargestOrder) {
      const double gain = std::pow(r21, p) - 1;
      return {p, f[2] - e21 / gain, kSafety * std::abs(e21 / f[2]) / gain, true};
    }
  }
  const auto [low, high] = std::minmax_element(f.begin(), f.end());
  return {0, f[2], kSafetyWithoutOrder * (*high - *low) / std::abs(f[2]), false};
}

}  // namespace nilas::cases
