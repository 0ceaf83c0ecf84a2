// The capsule: a cylinder with hemispherical ends.
// The functions of rigid/shape.hpp for this shape.
#pragma once

#include "rigid/shape.hpp"

namespace nilas::rigid::geometry {

inline const char* name(const Capsule&) { return "capsule"; }
void validate(const Capsule& capsule);
Closest closest_point(const Capsule& capsule, const Vec3& point);
std::vector<SurfacePoint> surface_points(const Capsule& capsule, double spacing);
double volume(const Capsule& capsule);
double surface_area(const Capsule& capsule);
Vec3 centroid(const Capsule& capsule);
Vec3 inertia_per_mass(const Capsule& capsule);
double enclosing_radius(const Capsule& capsule, const Vec3& centre);
Vec3 enclosing_radii(const Capsule& capsule, const Vec3& centre);
std::vector<Vec3> outline(const Capsule& capsule);
Vec3 support_point(const Capsule& capsule, const Vec3& direction);

}  // namespace nilas::rigid::geometry
