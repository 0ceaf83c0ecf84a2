// The shape of a body as Bullet has it.
#pragma once

#include <btBulletCollisionCommon.h>

#include "rigid/bullet_precision.hpp"
#include "rigid/shape.hpp"

#pragma GCC visibility push(default)

namespace nilas::rigid {
inline namespace NILAS_BULLET {

/// The shape in the frame of the collision shape (a body's: origin at the centre of mass), local scaling included.
///
/// Sphere, box, cylinder, capsule, cone along any axis: closed forms, true extents whatever the margin. Scaled
/// unequally across its axis a body of revolution stays one, with the radius that Bullet takes. Hulls and meshes are
/// their points and triangles, a cone its radius and height: the margin that Bullet adds around them when it looks for
/// contacts (4 cm by default) is not part of the body. Convex hull, point cloud, tetrahedron and convex triangle mesh:
/// the hull of the points (rigid/convex_hull.hpp). Multi-sphere: the hull of 1000 support points, inside by at most 0.5
/// % of the spheres' radii. Triangle meshes (BVH, scaled, multi-material, GImpact after updateBound): corners at the
/// same place are joined, and triangles with two such corners left out. Compound, uniform scaling: recursive. What is
/// placed or turned is a Compound; a single part at the origin is that part's shape.
///
/// Throws std::invalid_argument that gives Bullet's getName() of a shape that bounds no volume (plane, heightfield,
/// open mesh, flat hull, empty) or is not listed here, and what is allowed.
Shape shape_of(const btCollisionShape& shape);

}  // namespace NILAS_BULLET
}  // namespace nilas::rigid

#pragma GCC visibility pop
