// The sphere.
// The functions of rigid/shape.hpp for this shape.
#pragma once

#include "rigid/shape.hpp"

namespace nilas::rigid::geometry {

inline const char* name(const Sphere&) { return "sphere"; }
void validate(const Sphere& sphere);
Closest closest_point(const Sphere& sphere, const Vec3& point);
std::vector<SurfacePoint> surface_points(const Sphere& sphere, double spacing);
double volume(const Sphere& sphere);
double surface_area(const Sphere& sphere);
Vec3 centroid(const Sphere& sphere);
Vec3 inertia_per_mass(const Sphere& sphere);
double enclosing_radius(const Sphere& sphere, const Vec3& centre);
Vec3 enclosing_radii(const Sphere& sphere, const Vec3& centre);
std::vector<Vec3> outline(const Sphere& sphere);
Vec3 support_point(const Sphere& sphere, const Vec3& direction);

}  // namespace nilas::rigid::geometry
