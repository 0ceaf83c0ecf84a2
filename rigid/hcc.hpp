// The hemispherically capped cylinder: half a spheroid, a cylinder, a flat tail.
// The functions of rigid/shape.hpp for this shape.
#pragma once

#include "rigid/shape.hpp"

namespace nilas::rigid::geometry {

inline const char* name(const Hcc&) { return "hcc"; }
void validate(const Hcc& hcc);
Closest closest_point(const Hcc& hcc, const Vec3& point);
std::vector<SurfacePoint> surface_points(const Hcc& hcc, double spacing);
double volume(const Hcc& hcc);
double surface_area(const Hcc& hcc);
Vec3 centroid(const Hcc& hcc);
Vec3 inertia_per_mass(const Hcc& hcc);
double enclosing_radius(const Hcc& hcc, const Vec3& centre);
Vec3 enclosing_radii(const Hcc& hcc, const Vec3& centre);
std::vector<Vec3> outline(const Hcc& hcc);
Vec3 support_point(const Hcc& hcc, const Vec3& direction);

}  // namespace nilas::rigid::geometry
