#include "rigid/bullet_shape.hpp"

#include <BulletCollision/CollisionShapes/btTriangleCallback.h>

#include <map>
#include <numbers>
#include <stdexcept>

#include "rigid/bullet_body.hpp"
#include "rigid/convex_hull.hpp"

namespace nilas::rigid {
inline namespace NILAS_BULLET {
namespace {

/// Where a shape lies in the frame asked for: scaled about its own origin, turned, moved.
struct Frame {
  Vec3 position = Vec3::Zero();
  Quat orientation = Quat::Identity();
  double scale = 1;
};

const btVector3 everywhere(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT);

/// Turns z into a coordinate axis.
Quat z_to(int axis) { return axis == 2 ? Quat(Quat::Identity()) : orientation_along(Vec3::Unit(axis)); }

/// Corners of triangles, as Bullet hands them over one by one.
class Triangles final : public btTriangleCallback, public btInternalTriangleIndexCallback {
 public:
  void processTriangle(btVector3* corners, int, int) override { add(corners); }
  void internalProcessTriangleIndex(btVector3* corners, int, int) override { add(corners); }
  const std::vector<Vec3>& corners() const { return corners_; }

 private:
  void add(const btVector3* corners) {
    for (int k = 0; k < 3; ++k) corners_.push_back(from_bullet(corners[k]));
  }
  std::vector<Vec3> corners_;
};

Mesh mesh_of(const btConcaveShape& shape, double scale) {
  Triangles triangles;
  shape.processAllTriangles(&triangles, -everywhere, everywhere);
  std::map<std::array<double, 3>, int> known;
  std::vector<Vec3> vertices;
  std::vector<int> index;
  for (const Vec3& corner : triangles.corners()) {
    const auto [entry, is_new] =
        known.try_emplace({corner.x(), corner.y(), corner.z()}, static_cast<int>(known.size()));
    if (is_new) vertices.push_back(scale * corner);
    index.push_back(entry->second);
  }
  std::vector<Mesh::Triangle> joined;
  for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
    const Mesh::Triangle t{index[i], index[i + 1], index[i + 2]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) joined.push_back(t);
  }
  return Mesh(std::move(vertices), std::move(joined));
}

std::vector<Vec3> points_of(const btPolyhedralConvexShape& shape) {
  if (shape.getShapeType() == CONVEX_TRIANGLEMESH_SHAPE_PROXYTYPE) {
    Triangles triangles;
    static_cast<const btConvexTriangleMeshShape&>(shape).getMeshInterface()->InternalProcessAllTriangles(
        &triangles, -everywhere, everywhere);
    return triangles.corners();
  }
  std::vector<Vec3> points;
  for (int i = 0; i < shape.getNumVertices(); ++i) {
    btVector3 vertex;
    shape.getVertex(i, vertex);
    points.push_back(from_bullet(vertex));
  }
  return points;
}

/// Support points in directions evenly spread (a golden spiral).
std::vector<Vec3> support_points(const btConvexShape& shape) {
  constexpr int count = 1000;
  std::vector<Vec3> points;
  for (int n = 0; n < count; ++n) {
    const double z = (2 * n + 1.0) / count - 1, rho = std::sqrt(1 - z * z);
    const double azimuth = 2 * std::numbers::pi * std::numbers::phi * n;
    points.push_back(from_bullet(
        shape.localGetSupportingVertex(to_bullet(Vec3(rho * std::cos(azimuth), rho * std::sin(azimuth), z)))));
  }
  return points;
}

Mesh hull_of(std::vector<Vec3> points, double scale) {
  for (Vec3& p : points) p *= scale;
  return convex_hull(points);
}

/// A shape that is no compound, with the axis that its z lies along.
struct Leaf {
  Shape shape;
  int up = 2;
};

template <class Derived>
const Derived& as(const btCollisionShape& shape) {
  return static_cast<const Derived&>(shape);
}

Leaf leaf_of(const btCylinderShape& cylinder, double scale) {
  const int up = cylinder.getUpAxis();
  return {Cylinder{2 * scale * cylinder.getHalfExtentsWithMargin()[up], 2 * scale * cylinder.getRadius()}, up};
}

Leaf leaf_of(const btCapsuleShape& capsule, double scale) {
  const double radius = scale * capsule.getRadius();
  return {Capsule{2 * (scale * capsule.getHalfHeight() + radius), 2 * radius}, capsule.getUpAxis()};
}

Leaf leaf_of(const btConeShape& cone, double scale) {
  return {Cone{scale * cone.getHeight(), 2 * scale * cone.getRadius()}, cone.getConeUpIndex()};
}

Leaf leaf_of(const btCollisionShape& shape, double scale) {
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE:
      return {Sphere{2 * scale * as<btSphereShape>(shape).getRadius()}};
    case BOX_SHAPE_PROXYTYPE:
      return {Box{2 * scale * from_bullet(as<btBoxShape>(shape).getHalfExtentsWithMargin())}};
    case CYLINDER_SHAPE_PROXYTYPE:
      return leaf_of(as<btCylinderShape>(shape), scale);
    case CAPSULE_SHAPE_PROXYTYPE:
      return leaf_of(as<btCapsuleShape>(shape), scale);
    case CONE_SHAPE_PROXYTYPE:
      return leaf_of(as<btConeShape>(shape), scale);
    case CONVEX_HULL_SHAPE_PROXYTYPE:
    case CONVEX_POINT_CLOUD_SHAPE_PROXYTYPE:
    case CONVEX_TRIANGLEMESH_SHAPE_PROXYTYPE:
    case TETRAHEDRAL_SHAPE_PROXYTYPE:
      return {hull_of(points_of(as<btPolyhedralConvexShape>(shape)), scale)};
    case MULTI_SPHERE_SHAPE_PROXYTYPE:
      return {hull_of(support_points(as<btConvexShape>(shape)), scale)};
    case TRIANGLE_MESH_SHAPE_PROXYTYPE:
    case SCALED_TRIANGLE_MESH_SHAPE_PROXYTYPE:
    case MULTIMATERIAL_TRIANGLE_MESH_PROXYTYPE:
    case GIMPACT_SHAPE_PROXYTYPE:
      return {mesh_of(as<btConcaveShape>(shape), scale)};
    default:
      throw std::invalid_argument(
          "bounds no volume that is known; allowed: sphere, box, cylinder, capsule, cone, convex hull, multi-sphere, "
          "closed triangle mesh, and compounds of these");
  }
}

void append_parts(std::vector<Part>& parts, const btCollisionShape& shape, const Frame& at) {
  if (shape.isCompound()) {
    const auto& compound = as<btCompoundShape>(shape);
    for (int k = 0; k < compound.getNumChildShapes(); ++k) {
      const btTransform& child = compound.getChildTransform(k);
      const Vec3 offset = at.scale * from_bullet(child.getOrigin());
      append_parts(parts, *compound.getChildShape(k),
                   {at.position + at.orientation * offset,
                    at.orientation * from_bullet(child.getRotation()).normalized(), at.scale});
    }
  } else if (shape.getShapeType() == UNIFORM_SCALING_SHAPE_PROXYTYPE) {
    const auto& scaling = as<btUniformScalingShape>(shape);
    append_parts(parts, *scaling.getChildShape(),
                 {at.position, at.orientation, at.scale * scaling.getUniformScalingFactor()});
  } else {
    try {
      Leaf leaf = leaf_of(shape, at.scale);
      validate(leaf.shape);
      parts.push_back({std::move(leaf.shape), at.position, (at.orientation * z_to(leaf.up)).normalized()});
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(std::string("Bullet shape \"") + shape.getName() + "\": " + error.what());
    }
  }
}

}  // namespace

Shape shape_of(const btCollisionShape& shape) {
  std::vector<Part> parts;
  append_parts(parts, shape, {});
  if (parts.empty()) throw std::invalid_argument(std::string("Bullet shape \"") + shape.getName() + "\": has no parts");
  const Part& first = parts.front();
  if (parts.size() == 1 && first.position.isZero(0) && first.orientation.vec().isZero(0)) return first.shape;
  return Compound{std::move(parts)};
}

}  // namespace NILAS_BULLET
}  // namespace nilas::rigid
