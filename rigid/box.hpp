// The box, or plate.
// The functions of rigid/shape.hpp for this shape.
#pragma once

#include "rigid/shape.hpp"

namespace nilas::rigid::geometry {

inline const char* name(const Box&) { return "box"; }
void validate(const Box& box);
Closest closest_point(const Box& box, const Vec3& point);
std::vector<SurfacePoint> surface_points(const Box& box, double spacing);
double volume(const Box& box);
double surface_area(const Box& box);
Vec3 centroid(const Box& box);
Vec3 inertia_per_mass(const Box& box);
double enclosing_radius(const Box& box, const Vec3& centre);
Vec3 enclosing_radii(const Box& box, const Vec3& centre);
std::vector<Vec3> outline(const Box& box);
Vec3 support_point(const Box& box, const Vec3& direction);

}  // namespace nilas::rigid::geometry
