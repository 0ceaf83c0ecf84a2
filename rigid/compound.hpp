// The union of placed shapes.
// The functions of rigid/shape.hpp for this shape.
#pragma once

#include "rigid/shape.hpp"

namespace nilas::rigid::geometry {

inline const char* name(const Compound&) { return "compound"; }
void validate(const Compound& compound);
Closest closest_point(const Compound& compound, const Vec3& point);
std::vector<SurfacePoint> surface_points(const Compound& compound, double spacing);
double volume(const Compound& compound);
double surface_area(const Compound& compound);
Vec3 centroid(const Compound& compound);
Mat3 inertia_tensor_per_mass(const Compound& compound);
double enclosing_radius(const Compound& compound, const Vec3& centre);
Vec3 enclosing_radii(const Compound& compound, const Vec3& centre);
std::vector<Vec3> outline(const Compound& compound);
Vec3 support_point(const Compound& compound, const Vec3& direction);

}  // namespace nilas::rigid::geometry
