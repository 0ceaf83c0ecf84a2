// Shapes of rigid bodies: exact closest point, volume, centroid, inertia, and surface samples of known area and normal.
//
// Geometry frame: HCC: origin at the tip of the nose, +z out of the nose along the axis (the body lies at z <= 0).
// Sphere, box, cylinder, capsule, cone (axis z): origin at the middle of the height. Mesh, compound: as stated. SI
// units. All but mesh and compound are convex. Free functions on a closed set of value types. A new shape is one file
// pair (as rigid/sphere.*), one entry of the variant and one reader branch of the scene.
#pragma once

#include <array>
#include <memory>
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

/// Cylinder with hemispherical ends.
struct Capsule {
  double length;    // m, along z, tip to tip, at least the diameter
  double diameter;  // m
};
/// Tip at z = length/2, base at z = -length/2.
struct Cone {
  double length;    // m, along z
  double diameter;  // m, of the base
};

namespace geometry {
struct MeshSurface;
}
/// A closed surface of triangles; it may have several shells and cavities. Points: rigid/convex_hull.hpp.
class Mesh {
 public:
  using Triangle = std::array<int, 3>;  // vertices, counter-clockwise seen from outside

  /// All triangles are turned if they enclose a negative volume. Throws std::invalid_argument that names the vertex,
  /// triangle or edge if a vertex is not finite, a triangle has no area, an edge does not join exactly two triangles
  /// turned alike (an open surface has an edge with one), or the volume is zero. That the surface does not cut itself
  /// is taken for granted.
  Mesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles);

  const std::vector<Vec3>& vertices() const;
  const std::vector<Triangle>& triangles() const;
  const geometry::MeshSurface& surface() const { return *surface_; }

 private:
  std::shared_ptr<const geometry::MeshSurface> surface_;  // immutable, shared by copies
};

struct Part;
/// The union of placed shapes. Volume, area, centroid and inertia are sums over the parts, exact if no part reaches
/// into another; what two parts share counts twice.
struct Compound {
  std::vector<Part> parts;  // at least one
};

using Shape = std::variant<Hcc, Sphere, Box, Cylinder, Capsule, Cone, Mesh, Compound>;

/// A point p of the part's geometry frame is at position + orientation * p of the compound's.
struct Part {
  Shape shape;
  Vec3 position = Vec3::Zero();         // m
  Quat orientation = Quat::Identity();  // unit
};

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
/// the centre and the axis included, gives a unit normal. Where several points are nearest, one of them. At an edge or
/// corner of a mesh seen from inside the normal points away from the query point.
///
/// Compound: of the part whose signed distance is least. Outside that is exact. Inside it is the part that holds the
/// point deepest: the true depth is no less, and the same unless that part's nearest point lies in another part.
Closest closest_point(const Shape& shape, const Vec3& point);

/// A sample of the surface: the samples' areas sum to the area of the surface, their area vectors to zero (of a
/// compound whose parts overlap: see below).
struct SurfacePoint {
  Vec3 position;  // m, exactly on the surface
  Vec3 normal;    // unit, outward
  double area;    // m2
};
/// Samples about `spacing` apart. Bodies of revolution are sampled in rings whose counts are multiples of four and that
/// start half an interval off the x axis, so that the set has the mirror symmetries x -> -x and y -> -y, bit for bit;
/// boxes face by face with cell-centred points. Areas of rings are exact (integrated), not estimated, and a ring lies
/// where the surface has the ring's mean normal: a uniform pressure gives no force. A mesh has at least one sample per
/// triangle, at its centroid; larger triangles are halved across their longest edge. Of a compound, the samples of a
/// part that lie in another part, or between two that touch (to 1e-6 of the size), are dropped, and so are those that
/// an earlier part has too: the areas then sum to the exposed area to within about the length of the cut times the
/// spacing, and a uniform pressure leaves a force on as much area. Throws std::invalid_argument if the spacing is not
/// positive and finite or asks for more than 1e8 samples.
std::vector<SurfacePoint> surface_points(const Shape& shape, double spacing);

double volume(const Shape& shape);        // m3
double surface_area(const Shape& shape);  // m2
Vec3 centroid(const Shape& shape);        // m, geometry frame
/// Inertia tensor about the centroid along the geometry axes, divided by the mass [m2].
Mat3 inertia_tensor_per_mass(const Shape& shape);
/// Its diagonal: the principal moments. Throws std::invalid_argument if the geometry axes of a mesh or compound are not
/// principal, that is if a product of inertia exceeds 1e-6 of the largest moment.
Vec3 inertia_per_mass(const Shape& shape);
/// Radius of the smallest sphere about `centre` (geometry frame) that holds the shape.
double enclosing_radius(const Shape& shape, const Vec3& centre);
/// Largest distance of the body's matter from each geometry axis through `centre`: the bound I_i <= m R_i^2. Of a
/// compound an upper bound, at most 5e-6 above.
Vec3 enclosing_radii(const Shape& shape, const Vec3& centre);
/// Closed outline (last point = first) of the section in the y-z plane of the geometry frame, for pictures. Of a mesh
/// or compound, whose section may be in pieces: the convex outline of its projection on that plane.
std::vector<Vec3> outline(const Shape& shape);
/// Name as in a scene: "hcc", "sphere", "box", "cylinder", "capsule", "cone"; "mesh", "compound".
std::string name(const Shape& shape);
/// Point of the body farthest along a unit direction (support point), geometry frame; of a face or edge, its middle (of
/// a mesh, one of its corners; of parts equally far, the first one's).
Vec3 support_point(const Shape& shape, const Vec3& direction);

}  // namespace nilas::rigid

namespace nilas {
/// An HCC as a shape; lengths in m. For hosts that attach bodies in one line.
inline rigid::Shape hcc(double length, double diameter, double nose_length) {
  return rigid::Hcc{length, diameter, nose_length};
}
}  // namespace nilas

#pragma GCC visibility pop
