#include "rigid/cylinder.hpp"

#include <algorithm>
#include <numbers>

#include "rigid/dimension.hpp"
#include "rigid/revolution.hpp"

namespace nilas::rigid::geometry {

using std::numbers::pi;

void validate(const Cylinder& cylinder) {
  require_positive("cylinder", "length", cylinder.length);
  require_positive("cylinder", "diameter", cylinder.diameter);
}

Closest closest_point(const Cylinder& cylinder, const Vec3& point) {
  const Vec2 extent(0.5 * cylinder.diameter, 0.5 * cylinder.length);
  const Vec2 p = meridian(point);
  const Vec3 radial = radial_direction(point);
  const double up = p.y() < 0 ? -1 : 1;
  const Vec2 excess = p.cwiseAbs() - extent;  // how far beyond the wall and the nearer end
  if (excess.maxCoeff() > 0) {
    const Vec2 nearest(std::min(p.x(), extent.x()), std::clamp(p.y(), -extent.y(), extent.y()));
    const Vec2 outward(std::max(excess.x(), 0.0), up * std::max(excess.y(), 0.0));
    return {lift(nearest, radial), lift(outward.stableNormalized(), radial), outward.stableNorm()};
  }
  if (excess.x() > excess.y()) return {lift({extent.x(), p.y()}, radial), radial, excess.x()};
  return {lift({p.x(), up * extent.y()}, radial), Vec3(0, 0, up), excess.y()};
}

std::vector<SurfacePoint> surface_points(const Cylinder& cylinder, double spacing) {
  const double radius = 0.5 * cylinder.diameter, half = 0.5 * cylinder.length;
  std::vector<SurfacePoint> points;
  append_disc(points, radius, half, 1, spacing);
  append_wall(points, radius, -half, half, spacing);
  append_disc(points, radius, -half, -1, spacing);
  return points;
}

double volume(const Cylinder& cylinder) { return pi / 4 * cylinder.diameter * cylinder.diameter * cylinder.length; }

double surface_area(const Cylinder& cylinder) {
  return pi * cylinder.diameter * (cylinder.length + 0.5 * cylinder.diameter);
}

Vec3 centroid(const Cylinder&) { return Vec3::Zero(); }

Vec3 inertia_per_mass(const Cylinder& cylinder) {
  const double d2 = cylinder.diameter * cylinder.diameter;
  const double across = d2 / 16 + cylinder.length * cylinder.length / 12;
  return {across, across, d2 / 8};
}

double enclosing_radius(const Cylinder& cylinder, const Vec3& centre) {
  const Vec2 c = meridian(centre);
  return std::hypot(c.x() + 0.5 * cylinder.diameter, std::abs(c.y()) + 0.5 * cylinder.length);
}

Vec3 enclosing_radii(const Cylinder& cylinder, const Vec3& centre) {
  const double radius = 0.5 * cylinder.diameter;
  const double z = std::abs(centre.z()) + 0.5 * cylinder.length;
  return {std::hypot(std::abs(centre.y()) + radius, z), std::hypot(std::abs(centre.x()) + radius, z),
          meridian(centre).x() + radius};
}

std::vector<Vec3> outline(const Cylinder& cylinder) {
  const double radius = 0.5 * cylinder.diameter, half = 0.5 * cylinder.length;
  return closed_outline({{radius, half}, {radius, -half}});
}

Vec3 support_point(const Cylinder& cylinder, const Vec3& direction) {
  const Vec2 d = meridian(direction);
  const double rho = d.x() > 0 ? 0.5 * cylinder.diameter : 0.0;
  const double z = d.y() > 0 ? 0.5 * cylinder.length : d.y() < 0 ? -0.5 * cylinder.length : 0.0;
  return lift({rho, z}, radial_direction(direction));
}

}  // namespace nilas::rigid::geometry
