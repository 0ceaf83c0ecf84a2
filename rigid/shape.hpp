// Shapes of rigid bodies: exact closest point, volume, centroid, inertia, and surface samples of known area and normal.
//
// Geometry frame: HCC: origin at the tip of the nose, +z out of the nose along the axis (the body lies at z <= 0).
// Sphere, box, cylinder (axis z): origin at the centre. SI units. All shapes are convex.
// Free functions on a closed set of value types. A new shape is one file pair (as rigid/sphere.*), one entry of the
// variant and one reader branch of the scene.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "rigid/vector.hpp"

#pragma GCC visibility push(default)

namespace nilas::rigid {

/// Hemispherically capped cylinder: a semi-ellipsoid of semi-axes nose_length (axial) and diameter/2, then a cylinder.
/// The nose may be longer or shorter than the radius; nose_length = length leaves no cylinder.
struct Hcc {
  double length;       // m, tip to tail
  double diameter;     // m
  double nose_length;  // m, at most length
};
struct Sphere {
  double diameter;  // m
};
/// Also a plate.
struct Box {
  Vec3 size;  // m, full edge lengths
};
struct Cylinder {
  double length;    // m, along z
  double diameter;  // m
};

using Shape = std::variant<Hcc, Sphere, Box, Cylinder>;

/// Throws std::invalid_argument naming the dimension, its value and what is allowed, if the shape has no interior.
/// surface_points and the mass properties call it; the other functions take a valid shape for granted.
void validate(const Shape& shape);

/// Point of the surface nearest to a query point.
struct Closest {
  Vec3 point;       // m, on the surface
  Vec3 normal;      // unit, out of the body, at that point; at an edge seen from outside: towards the query point
  double distance;  // m, negative inside
};
/// Exact to round-off (Newton on the ellipse for the HCC's nose, to 1e-14 of its size). Total: any finite query point,
/// the centre and the axis included, gives a unit normal. Where several points are nearest, one of them.
Closest closest_point(const Shape& shape, const Vec3& point);

/// A sample of the surface: the samples' areas sum to the area of the surface, their area vectors to zero.
struct SurfacePoint {
  Vec3 position;  // m, exactly on the surface
  Vec3 normal;    // unit, outward
  double area;    // m2
};
/// Samples about `spacing` apart. Bodies of revolution are sampled in rings whose counts are multiples of four and that
/// start half an interval off the x axis, so that the set has the mirror symmetries x -> -x and y -> -y, bit for bit;
/// boxes face by face with cell-centred points. Areas of rings are exact (integrated), not estimated, and a ring lies
/// where the surface has the ring's mean normal: a uniform pressure gives no force. Throws std::invalid_argument if
/// the spacing is not positive and finite or asks for more than 1e8 samples.
std::vector<SurfacePoint> surface_points(const Shape& shape, double spacing);

double volume(const Shape& shape);        // m3
double surface_area(const Shape& shape);  // m2
Vec3 centroid(const Shape& shape);        // m, geometry frame
/// Principal moments of inertia about the centroid, divided by the mass [m2]; axes are those of the geometry frame.
Vec3 inertia_per_mass(const Shape& shape);
/// Radius of the smallest sphere about `centre` (geometry frame) that holds the shape.
double enclosing_radius(const Shape& shape, const Vec3& centre);
/// Largest distance of the body's matter from each geometry axis through `centre`: the bound I_i <= m R_i^2.
Vec3 enclosing_radii(const Shape& shape, const Vec3& centre);
/// Closed outline (last point = first) of the section in the y-z plane of the geometry frame, for pictures.
std::vector<Vec3> outline(const Shape& shape);
/// Name as in a scene: "hcc", "sphere", "box", "cylinder".
std::string name(const Shape& shape);
/// Point of the body farthest along a unit direction (support point), geometry frame; of a face or edge, its middle.
Vec3 support_point(const Shape& shape, const Vec3& direction);

}  // namespace nilas::rigid

namespace nilas {
/// An HCC as a shape; lengths in m. For hosts that attach bodies in one line.
inline rigid::Shape hcc(double length, double diameter, double nose_length) {
  return rigid::Hcc{length, diameter, nose_length};
}
}  // namespace nilas

#pragma GCC visibility pop
