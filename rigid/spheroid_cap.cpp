#include "rigid/spheroid_cap.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace nilas::rigid::geometry {
namespace {

using std::numbers::pi;

Vec2 point_at(const SpheroidCap& cap, double t) { return {cap.radius * std::sin(t), cap.height * std::cos(t)}; }

/// Area of the cap between the rim (u = 0) and u = cos t: 2 pi b int_0^u sqrt(a^2 + (b^2 - a^2) u^2) du, with a the
/// height and b the radius.
double area_from_rim(const SpheroidCap& cap, double u) {
  const double a = cap.height, b = cap.radius;
  const double c2 = (b - a) * (b + a);
  const double x = std::sqrt(std::abs(c2)) * u / a;
  // asin(x)/x of a prolate, asinh(x)/x of an oblate spheroid; both tend to 1, the sphere.
  const double ratio = x == 0 ? 1.0 : (c2 < 0 ? std::asin(std::min(x, 1.0)) : std::asinh(x)) / x;
  return pi * b * u * (std::sqrt(std::max(0.0, a * a + c2 * u * u)) + a * ratio);
}

/// Length of the meridian from the pole to t: int_0^t sqrt(b^2 cos^2 + a^2 sin^2) dt, an elliptic integral of the
/// second kind.
double arc_from_pole(const SpheroidCap& cap, double t) {
  const double a = cap.height, b = cap.radius;
  if (b >= a) return b * std::ellint_2(std::sqrt((1 - a / b) * (1 + a / b)), t);
  const double k = std::sqrt((1 - b / a) * (1 + b / a));
  return a * (std::comp_ellint_2(k) - std::ellint_2(k, pi / 2 - t));
}

/// The t at which the meridian has this length, by bisection.
double t_at_arc(const SpheroidCap& cap, double arc) {
  double low = 0, high = pi / 2;
  while (high - low > 4 * std::numeric_limits<double>::epsilon()) {
    const double middle = 0.5 * (low + high);
    (arc_from_pole(cap, middle) < arc ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// First t in [0, pi/2] at which g(t) = -p cos t + q sin t + c sin t cos t rises through zero (p >= 0).
///
/// g/(sin t cos t) = -p/sin t + q/cos t + c. For q >= 0 it increases: one root. For q < 0 it is concave with its top at
/// tan^3 t = p/(-q): the first root, if any, lies below. Newton inside that bracket, bisection where Newton leaves it
/// or is slow; without a root the upper end.
double first_root(double p, double q, double c) {
  if (p == 0) return q >= 0 && q + c < 0 ? std::acos(-q / c) : 0.0;
  double low = 0;
  double high = q >= 0 ? pi / 2 : std::atan(std::cbrt(p / -q));
  double t = std::atan2(p, q);  // the root for c = 0, a sphere
  if (!(t < high)) t = 0.5 * high;
  double step = high;
  for (int i = 0; i < 100 && std::abs(step) > 2 * std::numeric_limits<double>::epsilon(); ++i) {
    const double sine = std::sin(t), cosine = std::cos(t);
    const double g = -p * cosine + q * sine + c * sine * cosine;
    const double slope = p * sine + q * cosine + c * (cosine - sine) * (cosine + sine);
    (g > 0 ? high : low) = t;
    double next = t - g / slope;
    const bool newton = slope > 0 && next >= low && next <= high && 2 * std::abs(next - t) <= std::abs(step);
    if (!newton) next = 0.5 * (low + high);
    step = next - t;
    t = next;
  }
  return t;
}

}  // namespace

double curved_area(const SpheroidCap& cap) { return area_from_rim(cap, 1); }

Vec2 normal_at(const SpheroidCap& cap, const Vec2& on_meridian) {
  // The gradient of (rho/b)^2 + (z/a)^2, times a b, in terms that neither over- nor underflow.
  return Vec2(on_meridian.x() / cap.radius * cap.height, on_meridian.y() / cap.height * cap.radius).stableNormalized();
}

Vec2 point_with_normal(const SpheroidCap& cap, const Vec2& normal) {
  const Vec2 scaled(cap.radius * normal.x(), cap.height * normal.y());
  return Vec2(cap.radius * scaled.x(), cap.height * scaled.y()) / scaled.stableNorm();
}

Vec2 nearest_point(const SpheroidCap& cap, const Vec2& point) {
  // Half the derivative of the squared distance to (b sin t, a cos t) is g of first_root, with p = b rho, q = a z.
  const double a = cap.height, b = cap.radius;
  return point_at(cap, first_root(b * point.x(), a * point.y(), (b - a) * (b + a)));
}

Vec2 farthest_point(const SpheroidCap& cap, const Vec2& point) {
  // As nearest_point for (-rho, z), with the sign of g reversed: a maximum.
  const double a = cap.height, b = cap.radius;
  return point_at(cap, first_root(b * point.x(), -a * point.y(), (a - b) * (a + b)));
}

void append_cap(std::vector<SurfacePoint>& points, const SpheroidCap& cap, double z_base, bool down, double spacing) {
  const double arc = arc_from_pole(cap, pi / 2);
  const int count = intervals(arc, spacing);
  double u = 1;  // cos t at the upper edge of the ring
  for (int i = 1; i <= count; ++i) {
    const double next = i == count ? 0.0 : std::cos(t_at_arc(cap, arc * i / count));
    const double area = area_from_rim(cap, u) - area_from_rim(cap, next);
    const double projected_area = pi * cap.radius * cap.radius * (u - next) * (u + next);
    // The ring is put where the surface has its mean normal: then the area vectors of a closed surface sum to zero.
    const double normal_z = std::min(1.0, projected_area / area);
    const Vec2 normal(std::sqrt((1 - normal_z) * (1 + normal_z)), normal_z);
    const Vec2 position = point_with_normal(cap, normal);
    const double up = down ? -1 : 1;
    append_ring(points, {{position.x(), z_base + up * position.y()}, {normal.x(), up * normal.y()}, area}, spacing);
    u = next;
  }
}

std::vector<Vec2> meridian_points(const SpheroidCap& cap, int count) {
  std::vector<Vec2> points = {{0, cap.height}};
  for (int i = 1; i < count - 1; ++i) points.push_back(point_at(cap, pi / 2 * i / (count - 1)));
  points.emplace_back(cap.radius, 0);
  return points;
}

}  // namespace nilas::rigid::geometry
