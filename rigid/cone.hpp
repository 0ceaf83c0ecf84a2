// The circular cone.
// The functions of rigid/shape.hpp for this shape.
#pragma once

#include "rigid/shape.hpp"

namespace nilas::rigid::geometry {

inline const char* name(const Cone&) { return "cone"; }
void validate(const Cone& cone);
Closest closest_point(const Cone& cone, const Vec3& point);
std::vector<SurfacePoint> surface_points(const Cone& cone, double spacing);
double volume(const Cone& cone);
double surface_area(const Cone& cone);
Vec3 centroid(const Cone& cone);
Vec3 inertia_per_mass(const Cone& cone);
double enclosing_radius(const Cone& cone, const Vec3& centre);
Vec3 enclosing_radii(const Cone& cone, const Vec3& centre);
std::vector<Vec3> outline(const Cone& cone);
Vec3 support_point(const Cone& cone, const Vec3& direction);

}  // namespace nilas::rigid::geometry
