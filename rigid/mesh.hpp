// The closed triangle mesh.
// The functions of rigid/shape.hpp for this shape.
#pragma once

#include "rigid/shape.hpp"

namespace nilas::rigid::geometry {

inline const char* name(const Mesh&) { return "mesh"; }
inline void validate(const Mesh&) {}  // its constructor has done so
Closest closest_point(const Mesh& mesh, const Vec3& point);
std::vector<SurfacePoint> surface_points(const Mesh& mesh, double spacing);
double volume(const Mesh& mesh);
double surface_area(const Mesh& mesh);
Vec3 centroid(const Mesh& mesh);
Mat3 inertia_tensor_per_mass(const Mesh& mesh);
double enclosing_radius(const Mesh& mesh, const Vec3& centre);
Vec3 enclosing_radii(const Mesh& mesh, const Vec3& centre);
std::vector<Vec3> outline(const Mesh& mesh);
Vec3 support_point(const Mesh& mesh, const Vec3& direction);

}  // namespace nilas::rigid::geometry
