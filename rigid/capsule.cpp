#include "rigid/capsule.hpp"

#include <algorithm>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "rigid/dimension.hpp"
#include "rigid/spheroid_cap.hpp"

namespace nilas::rigid::geometry {
namespace {

using std::numbers::pi;

double radius(const Capsule& capsule) { return 0.5 * capsule.diameter; }
/// Height of the centres of the caps above and below the middle.
double reach(const Capsule& capsule) { return 0.5 * (capsule.length - capsule.diameter); }
double wall_volume(const Capsule& capsule) {
  return pi / 4 * capsule.diameter * capsule.diameter * (capsule.length - capsule.diameter);
}
double caps_volume(const Capsule& capsule) { return pi / 6 * std::pow(capsule.diameter, 3); }

}  // namespace

void validate(const Capsule& capsule) {
  require_positive("capsule", "length", capsule.length);
  require_positive("capsule", "diameter", capsule.diameter);
  if (capsule.diameter <= capsule.length) return;
  std::ostringstream message;
  message << "capsule: length = " << capsule.length << " m, must be at least the diameter, " << capsule.diameter
          << " m";
  throw std::invalid_argument(message.str());
}

Closest closest_point(const Capsule& capsule, const Vec3& point) {
  const double r = radius(capsule), a = reach(capsule);
  const Vec3 centre(0, 0, std::clamp(point.z(), -a, a));  // of the nearest ball
  const Vec3 offset = point - centre;
  const double distance = offset.stableNorm();
  const Vec3 normal = distance > 0 ? Vec3(offset.stableNormalized()) : Vec3(1, 0, 0);
  return {centre + r * normal, normal, distance - r};
}

std::vector<SurfacePoint> surface_points(const Capsule& capsule, double spacing) {
  const double r = radius(capsule), a = reach(capsule);
  std::vector<SurfacePoint> points;
  append_cap(points, {r, r}, a, false, spacing);
  append_wall(points, r, -a, a, spacing);
  append_cap(points, {r, r}, -a, true, spacing);
  return points;
}

double volume(const Capsule& capsule) { return wall_volume(capsule) + caps_volume(capsule); }

double surface_area(const Capsule& capsule) { return pi * capsule.diameter * capsule.length; }

Vec3 centroid(const Capsule&) { return Vec3::Zero(); }

Vec3 inertia_per_mass(const Capsule& capsule) {
  const double r = radius(capsule), a = reach(capsule);
  const double in_wall = wall_volume(capsule) / volume(capsule), in_caps = caps_volume(capsule) / volume(capsule);
  // A half ball's centroid is 3/8 r from its base: its moment across, moved from the base's centre by a.
  const double across = in_wall * (r * r / 4 + a * a / 3) + in_caps * (0.4 * r * r + 0.75 * a * r + a * a);
  return {across, across, (0.5 * in_wall + 0.4 * in_caps) * r * r};
}

double enclosing_radius(const Capsule& capsule, const Vec3& centre) {
  const Vec2 c = meridian(centre);
  return std::hypot(c.x(), std::abs(c.y()) + reach(capsule)) + radius(capsule);
}

Vec3 enclosing_radii(const Capsule& capsule, const Vec3& centre) {
  const double z = std::abs(centre.z()) + reach(capsule);
  const Vec3 to_farther_cap(std::hypot(centre.y(), z), std::hypot(centre.x(), z), meridian(centre).x());
  return to_farther_cap + Vec3::Constant(radius(capsule));
}

std::vector<Vec3> outline(const Capsule& capsule) {
  std::vector<Vec2> meridian = meridian_points({radius(capsule), radius(capsule)}, 33);
  for (Vec2& p : meridian) p.y() += reach(capsule);
  for (int i = 32; i >= 0; --i) meridian.emplace_back(meridian[i].x(), -meridian[i].y());
  return closed_outline(meridian);
}

Vec3 support_point(const Capsule& capsule, const Vec3& direction) {
  const double side = direction.z() > 0 ? 1 : direction.z() < 0 ? -1 : 0;
  return radius(capsule) * direction + Vec3(0, 0, side * reach(capsule));
}

}  // namespace nilas::rigid::geometry
