#include "rigid/cone.hpp"

#include <algorithm>
#include <numbers>

#include "rigid/dimension.hpp"
#include "rigid/revolution.hpp"

namespace nilas::rigid::geometry {
namespace {

using std::numbers::pi;

Vec2 tip(const Cone& cone) { return {0, 0.5 * cone.length}; }
Vec2 rim(const Cone& cone) { return {0.5 * cone.diameter, -0.5 * cone.length}; }
/// Unit, down the side, in the meridian half-plane.
Vec2 down_side(const Cone& cone) { return Vec2(0.5 * cone.diameter, -cone.length).stableNormalized(); }
Vec2 side_normal(const Cone& cone) { return Vec2(cone.length, 0.5 * cone.diameter).stableNormalized(); }
double slant(const Cone& cone) { return std::hypot(0.5 * cone.diameter, cone.length); }

/// Distance of the farthest point of the meridian from (-rho, z).
double farthest_distance(const Cone& cone, const Vec2& point) {
  const Vec2 mirrored(-point.x(), point.y());
  return std::max((tip(cone) - mirrored).norm(), (rim(cone) - mirrored).norm());
}

}  // namespace

void validate(const Cone& cone) {
  require_positive("cone", "length", cone.length);
  require_positive("cone", "diameter", cone.diameter);
}

Closest closest_point(const Cone& cone, const Vec3& point) {
  const Vec2 p = meridian(point);
  const Vec3 radial = radial_direction(point);
  const Vec2 from_tip = p - tip(cone), normal = side_normal(cone);
  const double above_side = normal.dot(from_tip), below_base = rim(cone).y() - p.y();
  const double along = down_side(cone).dot(from_tip);  // where the nearest point of the side's line lies
  const bool inside = std::max(above_side, below_base) <= 0;
  const auto corner = [&](const Vec2& at) -> Closest {
    const Vec2 away = p - at;
    const Vec2 direction = away.isZero(0) ? normal : Vec2(away.stableNormalized());
    return {lift(at, radial), lift(direction, radial), away.stableNorm()};
  };
  if (inside ? below_base > above_side : below_base > 0 && p.x() <= rim(cone).x())
    return {lift({p.x(), rim(cone).y()}, radial), Vec3(0, 0, -1), below_base};
  if (!inside && along <= 0) return corner(tip(cone));
  if (!inside && along >= slant(cone)) return corner(rim(cone));
  return {lift(tip(cone) + along * down_side(cone), radial), lift(normal, radial), above_side};
}

std::vector<SurfacePoint> surface_points(const Cone& cone, double spacing) {
  const double radius = 0.5 * cone.diameter, half = 0.5 * cone.length;
  std::vector<SurfacePoint> points;
  append_cone(points, radius, -half, half, side_normal(cone), spacing);
  append_disc(points, radius, -half, -1, spacing);
  return points;
}

double volume(const Cone& cone) { return pi / 12 * cone.diameter * cone.diameter * cone.length; }

double surface_area(const Cone& cone) { return pi / 2 * cone.diameter * (slant(cone) + 0.5 * cone.diameter); }

Vec3 centroid(const Cone& cone) { return {0, 0, -0.25 * cone.length}; }

Vec3 inertia_per_mass(const Cone& cone) {
  const double r2 = 0.25 * cone.diameter * cone.diameter;
  const double across = 0.15 * r2 + 0.0375 * cone.length * cone.length;
  return {across, across, 0.3 * r2};
}

double enclosing_radius(const Cone& cone, const Vec3& centre) { return farthest_distance(cone, meridian(centre)); }

Vec3 enclosing_radii(const Cone& cone, const Vec3& centre) {
  // Seen along x or y the body is its meridian section.
  return {farthest_distance(cone, {std::abs(centre.y()), centre.z()}),
          farthest_distance(cone, {std::abs(centre.x()), centre.z()}), meridian(centre).x() + 0.5 * cone.diameter};
}

std::vector<Vec3> outline(const Cone& cone) { return closed_outline({tip(cone), rim(cone)}); }

Vec3 support_point(const Cone& cone, const Vec3& direction) {
  const Vec2 d = meridian(direction);
  const Vec3 radial = radial_direction(direction);
  const double tip_over_rim = d.dot(tip(cone) - rim(cone));
  if (tip_over_rim > 0) return lift(tip(cone), radial);
  if (tip_over_rim == 0) return lift(0.5 * (tip(cone) + rim(cone)), radial);
  return lift({d.x() > 0 ? 0.5 * cone.diameter : 0.0, -0.5 * cone.length}, radial);
}

}  // namespace nilas::rigid::geometry
