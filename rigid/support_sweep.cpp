#include "rigid/support_sweep.hpp"

#include <algorithm>
#include <numbers>

namespace nilas::rigid::geometry {
namespace {

/// Direction n of `count` around an axis.
Vec3 around(int axis, int n, int count) {
  const double angle = 2 * std::numbers::pi * n / count;
  Vec3 direction = Vec3::Zero();
  direction[(axis + 1) % 3] = std::cos(angle);
  direction[(axis + 2) % 3] = std::sin(angle);
  return direction;
}

}  // namespace

double farthest_from_axis(const Support& support, int axis, const Vec3& centre) {
  constexpr int count = 1024;
  double farthest = 0;
  for (int n = 0; n < count; ++n) {
    const Vec3 direction = around(axis, n, count);
    farthest = std::max(farthest, direction.dot(support(direction) - centre));
  }
  // The farthest point is seen from a direction at most half an interval off its own.
  return farthest / std::cos(std::numbers::pi / count);
}

std::vector<Vec3> projected_outline(const Support& support) {
  constexpr int count = 128;
  std::vector<Vec3> outline;
  for (int n = 0; n < count; ++n) {
    const Vec3 point = support(around(0, n, count)).cwiseProduct(Vec3(0, 1, 1));
    if (outline.empty() || point != outline.back()) outline.push_back(point);
  }
  if (outline.front() != outline.back()) outline.push_back(outline.front());
  return outline;
}

}  // namespace nilas::rigid::geometry
