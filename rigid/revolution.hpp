// Bodies of revolution about z, seen in their meridian half-plane (rho, z): lifting and rings of surface samples.
#pragma once

#include <vector>

#include "rigid/shape.hpp"

namespace nilas::rigid::geometry {

/// (rho, z) in the meridian half-plane, rho >= 0.
using Vec2 = Eigen::Vector2d;

/// Meridian coordinates of a point.
inline Vec2 meridian(const Vec3& point) { return {std::hypot(point.x(), point.y()), point.z()}; }
/// Unit vector from the axis towards the point; +x for a point on the axis.
Vec3 radial_direction(const Vec3& point);
/// The vector of space that has these meridian components in the half-plane of `radial`.
inline Vec3 lift(const Vec2& meridian, const Vec3& radial) { return meridian.x() * radial + Vec3(0, 0, meridian.y()); }

/// How many intervals of about `spacing` a length is cut into, at least one.
int intervals(double length, double spacing);

/// A band of the surface between two circles of latitude.
struct Ring {
  Vec2 position;  // m, the point of the meridian that stands for the band
  Vec2 normal;    // unit, there
  double area;    // m2, of the whole band
};
/// Appends the samples of a ring: a multiple of four, about `spacing` apart, in mirror images.
void append_ring(std::vector<SurfacePoint>& points, const Ring& ring, double spacing);
/// Appends the samples of a cylinder's wall from z_low to z_high (none if they are equal).
void append_wall(std::vector<SurfacePoint>& points, double radius, double z_low, double z_high, double spacing);
/// Appends the samples of a cone's side, from the base's circle at z_base to the tip at z_tip. The normal is that of
/// the meridian.
void append_cone(std::vector<SurfacePoint>& points, double radius, double z_base, double z_tip, const Vec2& normal,
                 double spacing);
/// Appends the samples of a flat disc at height z whose outward normal is (0, 0, normal_z).
void append_disc(std::vector<SurfacePoint>& points, double radius, double z, double normal_z, double spacing);

/// Section in the y-z plane from the half of the meridian at y >= 0, given from the upper to the lower end.
std::vector<Vec3> closed_outline(const std::vector<Vec2>& meridian);

}  // namespace nilas::rigid::geometry
