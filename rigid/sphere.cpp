#include "rigid/sphere.hpp"

#include <numbers>

#include "rigid/dimension.hpp"
#include "rigid/spheroid_cap.hpp"

namespace nilas::rigid::geometry {

using std::numbers::pi;

void validate(const Sphere& sphere) { require_positive("sphere", "diameter", sphere.diameter); }

Closest closest_point(const Sphere& sphere, const Vec3& point) {
  const double radius = 0.5 * sphere.diameter;
  const double r = point.stableNorm();
  const Vec3 normal = r > 0 ? Vec3(point.stableNormalized()) : Vec3(0, 0, 1);
  return {radius * normal, normal, r - radius};
}

std::vector<SurfacePoint> surface_points(const Sphere& sphere, double spacing) {
  const double radius = 0.5 * sphere.diameter;
  std::vector<SurfacePoint> points;
  append_cap(points, {radius, radius}, 0, false, spacing);
  append_cap(points, {radius, radius}, 0, true, spacing);
  return points;
}

double volume(const Sphere& sphere) { return pi / 6 * std::pow(sphere.diameter, 3); }

double surface_area(const Sphere& sphere) { return pi * sphere.diameter * sphere.diameter; }

Vec3 centroid(const Sphere&) { return Vec3::Zero(); }

Vec3 inertia_per_mass(const Sphere& sphere) { return Vec3::Constant(0.1 * sphere.diameter * sphere.diameter); }

double enclosing_radius(const Sphere& sphere, const Vec3& centre) { return centre.norm() + 0.5 * sphere.diameter; }

Vec3 enclosing_radii(const Sphere& sphere, const Vec3& centre) {
  const Vec3 off_axis(std::hypot(centre.y(), centre.z()), std::hypot(centre.z(), centre.x()),
                      std::hypot(centre.x(), centre.y()));
  return off_axis + Vec3::Constant(0.5 * sphere.diameter);
}

std::vector<Vec3> outline(const Sphere& sphere) {
  const double radius = 0.5 * sphere.diameter;
  std::vector<Vec2> meridian = meridian_points({radius, radius}, 33);
  for (int i = 31; i >= 0; --i) meridian.emplace_back(meridian[i].x(), -meridian[i].y());
  return closed_outline(meridian);
}

Vec3 support_point(const Sphere& sphere, const Vec3& direction) { return 0.5 * sphere.diameter * direction; }

}  // namespace nilas::rigid::geometry
