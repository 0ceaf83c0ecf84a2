#include "rigid/bullet_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "rigid/bullet_world.hpp"
#include "tests/rigid/meshes.hpp"

namespace nilas::rigid {
namespace {

std::vector<Shape> shapes() {
  return {Hcc{1.8, 0.3, 0.2},
          Sphere{0.3},
          Box{Vec3(0.2, 0.4, 0.6)},
          Cylinder{0.8, 0.3},
          Capsule{0.8, 0.3},
          Cone{0.8, 0.3},
          test::box_mesh({0.3, 0.5, 0.7}, {0.1, -0.2, 0.4})};
}

BodySpec moving(const Shape& shape, Motion motion = Motion::free) {
  BodySpec spec;
  spec.shape = shape;
  spec.boundary_spacing = 0.05;
  spec.mass = from_density(shape, 1500);
  spec.motion = motion;
  spec.position = Vec3(1, -2, 3);
  spec.orientation = Quat(Eigen::AngleAxisd(0.9, Vec3(1, 2, -1).normalized()));
  spec.velocity = Vec3(10, -20, 30);
  spec.angular_velocity = Vec3(0.5, 1, -2);
  return spec;
}

/// One step of a world of its own, after `push` has had its way with the body.
template <class Push>
void step(BulletBody& body, double dt, const Push& push) {
  BulletWorld world;
  world.world().addRigidBody(&body.body());
  push(body.body());
  world.world().stepSimulation(dt, 0);
  world.world().removeRigidBody(&body.body());
}

TEST(BulletWorld, HasNoGravity) {
  BulletBody body(moving(Sphere{0.3}));
  step(body, 0.1, [](btRigidBody&) {});
  EXPECT_EQ(from_bullet(body.body().getLinearVelocity()), Vec3(10, -20, 30));
}

TEST(BulletBody, HasTheStatedPoseVelocitiesMassAndInertia) {
  for (const Shape& shape : shapes()) {
    const BodySpec spec = moving(shape);
    BulletBody bullet(spec);
    btRigidBody& body = bullet.body();
    EXPECT_EQ(from_bullet(body.getCenterOfMassTransform().getOrigin()), spec.position);
    EXPECT_LT(from_bullet(body.getCenterOfMassTransform().getRotation()).angularDistance(spec.orientation), 1e-7);
    EXPECT_EQ(from_bullet(body.getLinearVelocity()), spec.velocity);
    EXPECT_EQ(from_bullet(body.getAngularVelocity()), spec.angular_velocity);
    EXPECT_DOUBLE_EQ(1 / body.getInvMass(), spec.mass.mass);
    // The world inertia is the turned one: R I^-1 R^T.
    const Mat3 R = spec.orientation.toRotationMatrix();
    const Mat3 inverse = R * spec.mass.inertia.cwiseInverse().asDiagonal() * R.transpose();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(body.getInvInertiaTensorWorld()[i][j], inverse(i, j), 1e-12 * inverse.norm()) << name(shape);
  }
}

TEST(BulletBody, NeverSleepsAndHasNoGyroscopicTermAndNoDamping) {
  BulletBody bullet(moving(Hcc{1.8, 0.3, 0.2}));
  EXPECT_EQ(bullet.body().getFlags(), 0);
  EXPECT_EQ(bullet.body().getActivationState(), DISABLE_DEACTIVATION);
  EXPECT_EQ(bullet.body().getLinearDamping(), 0);
  EXPECT_EQ(bullet.body().getAngularDamping(), 0);
}

/// Farthest extent of a compound's only child along a direction of the body frame.
double extent(const btRigidBody& body, const Vec3& direction) {
  const auto& compound = static_cast<const btCompoundShape&>(*body.getCollisionShape());
  const auto& child = static_cast<const btConvexShape&>(*compound.getChildShape(0));
  const btTransform& offset = compound.getChildTransform(0);
  const btVector3 d = to_bullet(direction);
  return (offset * child.localGetSupportingVertex(offset.getBasis().transpose() * d)).dot(d);
}

constexpr double half_width = 0.15;  // m, of all but the box, which is 0.1 at its narrowest

TEST(BulletBody, CollidesAsItsShapeAboutItsCentreOfMassWithinAHundredth) {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  for (const Shape& shape : shapes()) {
    BodySpec spec = moving(shape);
    spec.mass.centre_of_mass += Vec3(0.01, -0.02, 0.03);
    BulletBody bullet(spec);
    for (int n = 0; n < 2000; ++n) {
      const Vec3 d = Vec3(normal(engine), normal(engine), normal(engine)).normalized();
      const double exact = (support_point(shape, d) - spec.mass.centre_of_mass).dot(d);
      EXPECT_NEAR(extent(bullet.body(), d), exact, 0.01 * half_width) << name(shape) << " " << d.transpose();
    }
  }
}

TEST(BulletBody, MovesFreelyByDefault) {
  BulletBody bullet(moving(Sphere{0.3}));
  const double mass = 1 / bullet.body().getInvMass();
  step(bullet, 0.01, [](btRigidBody& body) {
    body.applyCentralForce(btVector3(100, 0, 0));
    body.applyTorque(btVector3(0, 1, 0));
  });
  EXPECT_NEAR(bullet.body().getLinearVelocity().x(), 10 + 1 / mass, 1e-12);
  EXPECT_GT(bullet.body().getAngularVelocity().y(), 1);
}

TEST(BulletBody, OfTranslationOnlyDoesNotTurn) {
  BodySpec spec = moving(Sphere{0.3}, Motion::translation_only);
  spec.angular_velocity = Vec3::Zero();
  BulletBody bullet(spec);
  step(bullet, 0.01, [](btRigidBody& body) {
    body.applyForce(btVector3(100, 0, 0), btVector3(0, 1, 0));
    body.applyImpulse(btVector3(0, 10, 0), btVector3(1, 0, 0));
  });
  EXPECT_TRUE(bullet.body().getAngularVelocity().isZero());
  EXPECT_GT(bullet.body().getLinearVelocity().x(), 10);
  EXPECT_GT(bullet.body().getLinearVelocity().y(), -20);
}

TEST(BulletBody, OfAFixedPathKeepsItUnderForceImpulseAndCollision) {
  const BodySpec spec = moving(Box{Vec3(0.2, 0.4, 0.6)}, Motion::fixed_path);
  BulletBody bullet(spec), obstacle([&] {
    BodySpec other = moving(Sphere{0.3});
    other.position = spec.position + Vec3(0, 0, 0.3);
    other.velocity = Vec3::Zero();
    return other;
  }());
  BulletWorld world;
  world.world().addRigidBody(&bullet.body());
  world.world().addRigidBody(&obstacle.body());
  for (int n = 0; n < 10; ++n) {
    bullet.body().applyForce(btVector3(1e6, 1e6, 1e6), btVector3(0.1, 0, 0));
    bullet.body().applyImpulse(btVector3(1e4, 0, 0), btVector3(0, 0.1, 0));
    world.world().stepSimulation(1e-3, 0);
  }
  EXPECT_EQ(from_bullet(bullet.body().getLinearVelocity()), spec.velocity);
  EXPECT_EQ(from_bullet(bullet.body().getAngularVelocity()), spec.angular_velocity);
  EXPECT_LT(
      (from_bullet(bullet.body().getCenterOfMassTransform().getOrigin()) - spec.position - 0.01 * spec.velocity).norm(),
      1e-14);
  EXPECT_GT(from_bullet(obstacle.body().getLinearVelocity()).norm(), 10);  // it was in the way
  world.world().removeRigidBody(&obstacle.body());
  world.world().removeRigidBody(&bullet.body());
}

TEST(BulletBody, ThatIsFixedIsStatic) {
  BulletBody bullet(moving(Sphere{0.3}, Motion::fixed));
  EXPECT_TRUE(bullet.body().isStaticObject());
  EXPECT_EQ(bullet.body().getInvMass(), 0);
  step(bullet, 0.01, [](btRigidBody& body) { body.applyCentralImpulse(btVector3(100, 0, 0)); });
  EXPECT_EQ(from_bullet(bullet.body().getCenterOfMassTransform().getOrigin()), Vec3(1, -2, 3));
}

}  // namespace
}  // namespace nilas::rigid
