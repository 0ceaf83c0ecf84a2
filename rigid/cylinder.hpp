// The circular cylinder with flat ends.
// The functions of rigid/shape.hpp for this shape.
#pragma once

#include "rigid/shape.hpp"

namespace nilas::rigid::geometry {

inline const char* name(const Cylinder&) { return "cylinder"; }
void validate(const Cylinder& cylinder);
Closest closest_point(const Cylinder& cylinder, const Vec3& point);
std::vector<SurfacePoint> surface_points(const Cylinder& cylinder, double spacing);
double volume(const Cylinder& cylinder);
double surface_area(const Cylinder& cylinder);
Vec3 centroid(const Cylinder& cylinder);
Vec3 inertia_per_mass(const Cylinder& cylinder);
double enclosing_radius(const Cylinder& cylinder, const Vec3& centre);
Vec3 enclosing_radii(const Cylinder& cylinder, const Vec3& centre);
std::vector<Vec3> outline(const Cylinder& cylinder);
Vec3 support_point(const Cylinder& cylinder, const Vec3& direction);

}  // namespace nilas::rigid::geometry
