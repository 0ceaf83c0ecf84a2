// Shapes read back from Bullet's collision shapes. Oracle: Bullet's own support function or bounding box.
#include "rigid/bullet_shape.hpp"

#include <BulletCollision/CollisionShapes/btBox2dShape.h>
#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "rigid/bullet_body.hpp"
#include "tests/rigid/meshes.hpp"
#include "tests/rigid/shape_oracle.hpp"

namespace nilas::rigid {
namespace {

constexpr double eps = std::numeric_limits<btScalar>::epsilon();

/// Bullet's support function, without the margin that it adds to hulls and cones.
void expect_support_of_bullet(const btConvexShape& bullet, double margin, double tolerance = 16 * eps) {
  const Shape shape = shape_of(bullet);
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i) {
    const Vec3 d = Vec3(normal(random), normal(random), normal(random)).normalized();
    const double expected = d.dot(from_bullet(bullet.localGetSupportingVertex(to_bullet(d)))) - margin;
    EXPECT_NEAR(d.dot(support_point(shape, d)), expected, tolerance) << bullet.getName() << ' ' << d.transpose();
  }
}

const btVector3 stretched(btScalar(0.5), btScalar(2), btScalar(1.5));

TEST(ShapeOfBullet, SphereIsExactWithScaling) {
  btSphereShape sphere(btScalar(0.15));
  EXPECT_EQ(std::get<Sphere>(shape_of(sphere)).diameter, 2 * double(btScalar(0.15)));
  sphere.setLocalScaling(btVector3(2, 2, 2));
  EXPECT_EQ(std::get<Sphere>(shape_of(sphere)).diameter, 4 * double(btScalar(0.15)));
}

TEST(ShapeOfBullet, BoxHasItsTrueExtentsWhateverTheMarginAndScaling) {
  btBoxShape box(btVector3(btScalar(0.1), btScalar(0.2), btScalar(0.3)));
  for (const double margin : {0.0, 0.004, 0.04}) {
    box.setMargin(btScalar(margin));
    EXPECT_LT((std::get<Box>(shape_of(box)).size - Vec3(0.2, 0.4, 0.6)).norm(), 4 * eps) << margin;
  }
  box.setLocalScaling(stretched);
  EXPECT_LT((std::get<Box>(shape_of(box)).size - Vec3(0.1, 0.8, 0.9)).norm(), 8 * eps);
}

/// Extents of Bullet's own box about the shape, which for these shapes is as wide as the shape and its outer margin.
Vec3 extents(const btCollisionShape& shape, double outer_margin) {
  btVector3 low, high;
  shape.getAabb(btTransform::getIdentity(), low, high);
  return from_bullet(high - low) - Vec3::Constant(2 * outer_margin);
}

Vec3 extents(const Shape& shape) {
  Vec3 size;
  for (int k = 0; k < 3; ++k)
    size[k] = support_point(shape, Vec3::Unit(k))[k] - support_point(shape, -Vec3::Unit(k))[k];
  return size;
}

TEST(ShapeOfBullet, CylinderAlongEveryAxisIsExactWithMarginAndScaling) {
  const btVector3 across_x(btScalar(0.5), btScalar(0.2), btScalar(0.2)),
      across_y(btScalar(0.2), btScalar(0.5), btScalar(0.2)), across_z(btScalar(0.2), btScalar(0.2), btScalar(0.5));
  btCylinderShapeX x(across_x);
  btCylinderShape y(across_y);
  btCylinderShapeZ z(across_z);
  btCylinderShape* const along[] = {&x, &y, &z};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double margin : {0.04, 0.01, 0.0}) {
      along[axis]->setMargin(btScalar(margin));
      EXPECT_LT((extents(shape_of(*along[axis])) - extents(*along[axis], 0)).norm(), 16 * eps) << axis;
    }
    expect_support_of_bullet(*along[axis], 0);  // sharp edges: margin 0
    btVector3 scaling(2, 2, 2);
    scaling[axis] = btScalar(0.5);
    along[axis]->setLocalScaling(scaling);
    expect_support_of_bullet(*along[axis], 0);
  }
  EXPECT_EQ(name(shape_of(z)), "cylinder");
  EXPECT_EQ(name(std::get<Compound>(shape_of(x)).parts.at(0).shape), "cylinder");
}

TEST(ShapeOfBullet, CapsuleAlongEveryAxisIsExactWithScaling) {
  btCapsuleShapeX x(btScalar(0.15), btScalar(1.44));
  btCapsuleShape y(btScalar(0.15), btScalar(1.44));
  btCapsuleShapeZ z(btScalar(0.15), btScalar(1.44));
  btCapsuleShape* const along[] = {&x, &y, &z};
  for (int axis = 0; axis < 3; ++axis) {
    expect_support_of_bullet(*along[axis], 0);
    btVector3 scaling(2, 2, 2);
    scaling[axis] = btScalar(0.5);
    along[axis]->setLocalScaling(scaling);
    expect_support_of_bullet(*along[axis], 0);
  }
  const auto capsule = std::get<Capsule>(shape_of(z));
  EXPECT_NEAR(capsule.length, 0.72 + 0.6, 8 * eps);
  EXPECT_NEAR(capsule.diameter, 0.6, 8 * eps);
}

TEST(ShapeOfBullet, ConeAlongEveryAxisIsItsRadiusAndHeightWithoutTheMargin) {
  btConeShapeX x(btScalar(0.3), btScalar(0.8));
  btConeShape y(btScalar(0.3), btScalar(0.8));
  btConeShapeZ z(btScalar(0.3), btScalar(0.8));
  btConeShape* const along[] = {&x, &y, &z};
  for (int axis = 0; axis < 3; ++axis) {
    expect_support_of_bullet(*along[axis], along[axis]->getMargin());
    along[axis]->setMargin(0);
    expect_support_of_bullet(*along[axis], 0);
    btVector3 scaling(2, 2, 2);
    scaling[axis] = btScalar(0.5);
    along[axis]->setLocalScaling(scaling);
    expect_support_of_bullet(*along[axis], 0);
  }
}

constexpr double grid = 4e-7;  // of a hull of about 3 m: 2^-23 of the extent, and a float's own round-off

TEST(ShapeOfBullet, ConvexHullIsThatOfThePointsWithScalingWithoutTheMargin) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  btConvexHullShape hull;
  btConvexPointCloudShape cloud;
  std::vector<btVector3> points;
  for (int i = 0; i < 60; ++i) {
    points.push_back(to_bullet(Vec3(Vec3(normal(random), normal(random), normal(random)).normalized())));
    hull.addPoint(points.back());
  }
  cloud.setPoints(points.data(), static_cast<int>(points.size()));
  btBU_Simplex1to4 tetrahedron(points[0], points[1], points[2], points[3]);
  for (btPolyhedralConvexShape* shape :
       {static_cast<btPolyhedralConvexShape*>(&hull), static_cast<btPolyhedralConvexShape*>(&cloud),
        static_cast<btPolyhedralConvexShape*>(&tetrahedron)}) {
    EXPECT_EQ(shape->getMargin(), btScalar(0.04));
    expect_support_of_bullet(*shape, shape->getMargin(), grid);
    if (shape == &tetrahedron) continue;  // it has no local scaling
    // The support function of Bullet's point cloud chooses the point before it scales: right for equal scaling only.
    shape->setLocalScaling(shape == &cloud ? btVector3(2, 2, 2) : stretched);
    expect_support_of_bullet(*shape, shape->getMargin(), grid);
  }
}

btTriangleMesh triangles_of(const Mesh& mesh) {
  btTriangleMesh triangles;
  for (const Mesh::Triangle& t : mesh.triangles())
    triangles.addTriangle(to_bullet(mesh.vertices()[t[0]]), to_bullet(mesh.vertices()[t[1]]),
                          to_bullet(mesh.vertices()[t[2]]));
  return triangles;
}

TEST(ShapeOfBullet, ConvexTriangleMeshIsTheHullOfItsVertices) {
  btTriangleMesh triangles = triangles_of(test::angle_mesh());
  btConvexTriangleMeshShape shape(&triangles);
  expect_support_of_bullet(shape, shape.getMargin(), grid);
  shape.setLocalScaling(stretched);
  expect_support_of_bullet(shape, shape.getMargin(), grid);
}

TEST(ShapeOfBullet, MultiSphereIsAHullInsideItByHalfAPerCentOfItsRadiiAtMost) {
  const btVector3 centres[] = {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 2, 0)};
  const btScalar radii[] = {btScalar(0.5), btScalar(0.3), btScalar(0.2)};
  btMultiSphereShape shape(centres, radii, 3);
  const Shape hull = shape_of(shape);
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = Vec3(normal(random), normal(random), normal(random)).normalized();
    const double beyond =
        d.dot(support_point(hull, d)) - d.dot(from_bullet(shape.localGetSupportingVertex(to_bullet(d))));
    EXPECT_LT(beyond, grid);
    EXPECT_GT(beyond, -0.005 * 0.5);
  }
}

TEST(ShapeOfBullet, UniformScalingScalesItsChild) {
  btCylinderShapeX cylinder(btVector3(btScalar(0.5), btScalar(0.2), btScalar(0.2)));
  btUniformScalingShape scaled(&cylinder, 3);
  const Part part = std::get<Compound>(shape_of(scaled)).parts.at(0);
  EXPECT_NEAR(std::get<Cylinder>(part.shape).length, 3, 16 * eps);
  EXPECT_NEAR(std::get<Cylinder>(part.shape).diameter, 1.2, 16 * eps);
}

/// The same triangles as the mesh stretched, in any order.
void expect_stretched(const Shape& shape, const Mesh& mesh, const Vec3& scaling) {
  std::vector<Vec3> vertices;
  for (const Vec3& v : mesh.vertices()) vertices.push_back(v.cwiseProduct(scaling));
  const Mesh expected(vertices, mesh.triangles());
  const auto& got = std::get<Mesh>(shape);
  EXPECT_EQ(got.triangles().size(), expected.triangles().size());
  EXPECT_EQ(got.vertices().size(), expected.vertices().size());
  EXPECT_NEAR(volume(got), volume(expected), 64 * eps * volume(expected));
  EXPECT_LT((centroid(got) - centroid(expected)).norm(), 64 * eps);
  for (const Vec3& p : {Vec3(0.1, 0.2, 0.1), Vec3(-0.3, 0, 0.6), Vec3(0.25, 0, 0.25), Vec3(0, 0, 0)})
    EXPECT_NEAR(closest_point(got, p).distance, closest_point(expected, p).distance, 64 * eps);
}

TEST(ShapeOfBullet, TriangleMeshesAreTheirTrianglesWithScaling) {
  for (const Mesh& mesh : {test::angle_mesh(), test::box_with_cavity(), test::torus_mesh(0.4, 0.15, 24, 16)}) {
    for (const bool quantized : {false, true}) {
      btTriangleMesh triangles = triangles_of(mesh);
      btBvhTriangleMeshShape bvh(&triangles, quantized);
      expect_stretched(shape_of(bvh), mesh, Vec3::Ones());
      btScaledBvhTriangleMeshShape scaled(&bvh, stretched);
      expect_stretched(shape_of(scaled), mesh, from_bullet(stretched));
      bvh.setLocalScaling(btVector3(-1, 2, 1));  // a mirror image
      expect_stretched(shape_of(bvh), mesh, Vec3(-1, 2, 1));
    }
    btTriangleMesh triangles = triangles_of(mesh);
    btGImpactMeshShape gimpact(&triangles);
    gimpact.setLocalScaling(stretched);
    gimpact.updateBound();
    expect_stretched(shape_of(gimpact), mesh, from_bullet(stretched));
  }
}

TEST(ShapeOfBullet, TrianglesWithTwoCornersAtOnePlaceAreLeftOut) {
  const Mesh mesh = test::angle_mesh();
  btTriangleMesh triangles = triangles_of(mesh);
  triangles.addTriangle(to_bullet(mesh.vertices()[0]), to_bullet(mesh.vertices()[0]), to_bullet(mesh.vertices()[1]));
  btBvhTriangleMeshShape bvh(&triangles, true);
  expect_stretched(shape_of(bvh), mesh, Vec3::Ones());
}

TEST(ShapeOfBullet, CompoundPlacesItsChildrenRecursivelyWithScaling) {
  btSphereShape sphere(btScalar(0.2));
  btCapsuleShapeX capsule(btScalar(0.1), btScalar(0.6));
  btCompoundShape inner, outer;
  inner.addChildShape(btTransform(btQuaternion(btVector3(0, 1, 0), btScalar(0.4)), btVector3(0, 0, 1)), &capsule);
  outer.addChildShape(btTransform(btQuaternion(btVector3(0, 0, 1), btScalar(0.3)), btVector3(1, 0, 0)), &inner);
  outer.addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, -1, 0)), &sphere);
  for (const double scale : {1.0, 2.0}) {
    outer.setLocalScaling(btVector3(btScalar(scale), btScalar(scale), btScalar(scale)));
    const auto compound = std::get<Compound>(shape_of(outer));
    ASSERT_EQ(compound.parts.size(), 2u);
    const auto& first = compound.parts[0];
    EXPECT_NEAR(std::get<Capsule>(first.shape).length, 0.8 * scale, 16 * eps);
    const Quat turn = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ())) * Quat(Eigen::AngleAxisd(0.4, Vec3::UnitY()));
    EXPECT_LT((first.orientation * Vec3::UnitZ() - turn * Vec3::UnitX()).norm(), 16 * eps);
    EXPECT_LT((first.position - scale * Vec3(1, 0, 1)).norm(), 16 * eps);
    EXPECT_EQ(compound.parts[1].position, scale * Vec3(0, -1, 0));
    EXPECT_NO_THROW(validate(compound));
  }
}

TEST(ShapeOfBullet, CompoundOfOneChildInPlaceIsThatChild) {
  btSphereShape sphere(btScalar(0.25));
  btCompoundShape compound;
  compound.addChildShape(btTransform::getIdentity(), &sphere);
  EXPECT_EQ(std::get<Sphere>(shape_of(compound)).diameter, 0.5);
}

BodySpec at_rest(const Shape& shape) {
  BodySpec spec;
  spec.shape = shape;
  spec.mass = {1, Vec3::Zero(), Vec3::Ones()};
  return spec;
}

TEST(ShapeOfBullet, GivesBackTheShapeThatABulletBodyWasMadeOf) {
  const Mesh convex = test::box_mesh({0.3, 0.5, 0.7}, {0.1, -0.2, 0.4});
  const std::vector<Shape> shapes = {Sphere{0.3},
                                     Box{{0.2, 0.4, 0.6}},
                                     Cylinder{0.8, 0.3},
                                     Capsule{0.8, 0.3},
                                     Cone{0.8, 0.3},
                                     convex,
                                     Compound{{{Cone{0.8, 0.3}, {0.1, 0.2, 0.3}, Quat(0.8, 0, 0.6, 0)},
                                               {Compound{{{Sphere{0.2}, {0, 0, 1}, Quat(0, 1, 0, 0)}}}, {0, 1, 0}}}}};
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Shape& shape : shapes) {
    BulletBody body(at_rest(shape));
    const Shape again = shape_of(*body.body().getCollisionShape());
    if (!std::holds_alternative<Compound>(shape)) {
      EXPECT_EQ(name(again), name(shape));
    }
    EXPECT_NEAR(volume(again), volume(shape), grid * volume(shape));
    for (int i = 0; i < 100; ++i) {
      const Vec3 p(uniform(random), uniform(random), uniform(random));
      EXPECT_NEAR(closest_point(again, p).distance, closest_point(shape, p).distance, grid) << name(shape);
    }
  }
}

TEST(ShapeOfBullet, OfABodyWhoseCentreOfMassIsOffTheOriginIsPlacedAboutTheCentreOfMass) {
  BodySpec spec = at_rest(Cone{0.8, 0.4});
  spec.mass.centre_of_mass = Vec3(0, 0, -0.2);
  BulletBody body(spec);
  const auto compound = std::get<Compound>(shape_of(*body.body().getCollisionShape()));
  EXPECT_LT((compound.parts.at(0).position - Vec3(0, 0, 0.2)).norm(), eps);
}

std::string refusal(const btCollisionShape& shape) {
  try {
    shape_of(shape);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ShapeOfBullet, WithoutAVolumeOrUnknownIsRefusedByBulletsNameAndWhatIsAllowed) {
  const std::string unknown =
      ": bounds no volume that is known; allowed: sphere, box, cylinder, capsule, cone, convex hull, multi-sphere, "
      "closed triangle mesh, and compounds of these";
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btEmptyShape empty;
  btBox2dShape flat(btVector3(1, 1, 0));
  const float heights[] = {0, 0, 0, 0};
  btHeightfieldTerrainShape terrain(2, 2, heights, btScalar(0), btScalar(1), 2, false);
  btTriangleShape triangle(btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 1, 0));
  EXPECT_EQ(refusal(plane), "Bullet shape \"STATICPLANE\"" + unknown);
  EXPECT_EQ(refusal(empty), "Bullet shape \"Empty\"" + unknown);
  EXPECT_EQ(refusal(flat), "Bullet shape \"Box2d\"" + unknown);
  EXPECT_EQ(refusal(terrain), "Bullet shape \"HEIGHTFIELD\"" + unknown);
  EXPECT_EQ(refusal(triangle), "Bullet shape \"Triangle\"" + unknown);

  btCompoundShape compound;
  EXPECT_EQ(refusal(compound), "Bullet shape \"Compound\": has no parts");
  compound.addChildShape(btTransform::getIdentity(), &plane);
  EXPECT_EQ(refusal(compound), "Bullet shape \"STATICPLANE\"" + unknown);

  btTriangleMesh one;
  one.addTriangle(btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 1, 0));
  btBvhTriangleMeshShape open(&one, true);
  EXPECT_EQ(
      refusal(open),
      "Bullet shape \"BVHTRIANGLEMESH\": mesh: is open: only one triangle has the edge from (0, 0, 0) m to (1, 0, "
      "0) m");
  btConvexHullShape flat_hull;
  for (const btVector3& p : {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 1, 0), btVector3(1, 1, 0)})
    flat_hull.addPoint(p);
  EXPECT_EQ(refusal(flat_hull),
            "Bullet shape \"Convex\": convex hull: the 4 points lie in a plane, must span a volume");
  btSphereShape point(0);
  EXPECT_EQ(refusal(point), "Bullet shape \"SPHERE\": sphere: diameter = 0 m, must be positive and finite");
  btGImpactMeshShape not_updated(&one);
  EXPECT_EQ(refusal(not_updated), "Bullet shape \"GImpactMesh\": mesh: has no triangles");
}

}  // namespace
}  // namespace nilas::rigid
