// Half a spheroid of revolution on the plane z = 0: the nose of the HCC, twice that of a sphere.
//
// Meridian: rho = radius sin t, z = height cos t, with t from 0 (the pole) to pi/2 (the rim). The height may be longer
// or shorter than the radius, or equal.
#pragma once

#include "rigid/revolution.hpp"

namespace nilas::rigid::geometry {

struct SpheroidCap {
  double radius;  // m, of the base, in z = 0
  double height;  // m, of the pole
};

/// Area without the base [m2]: the closed form of the prolate or oblate spheroid.
double curved_area(const SpheroidCap& cap);
/// Unit outward normal at a point of the meridian.
Vec2 normal_at(const SpheroidCap& cap, const Vec2& on_meridian);
/// Point of the meridian whose outward normal is this unit vector (normal.y() >= 0): the support point.
Vec2 point_with_normal(const SpheroidCap& cap, const Vec2& normal);

/// Point of the meridian nearest to a point of the half-plane, on either side of the curve and of the base. For a point
/// below the base whose nearest point is the rim, the result may be another point of the meridian: ask the rim too.
Vec2 nearest_point(const SpheroidCap& cap, const Vec2& point);
/// Point of the meridian farthest from (-point.x(), point.y()), that is, of the whole cap from a point at that distance
/// from the axis. With the same reservation: ask the rim too.
Vec2 farthest_point(const SpheroidCap& cap, const Vec2& point);

/// Appends the samples of the cap moved up by z_base, or of its mirror image in the base if `down`. Rings of equal arc.
void append_cap(std::vector<SurfacePoint>& points, const SpheroidCap& cap, double z_base, bool down, double spacing);
/// Points of the meridian from the pole to the rim, for pictures.
std::vector<Vec2> meridian_points(const SpheroidCap& cap, int count);

}  // namespace nilas::rigid::geometry
