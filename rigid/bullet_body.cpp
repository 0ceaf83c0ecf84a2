#include "rigid/bullet_body.hpp"

#include <algorithm>

namespace nilas::rigid {

namespace {

std::unique_ptr<btCollisionShape> collision_shape(const Sphere& s) {
  return std::make_unique<btSphereShape>(0.5 * s.diameter);
}
std::unique_ptr<btCollisionShape> collision_shape(const Box& b) {
  return std::make_unique<btBoxShape>(to_bullet(Vec3(0.5 * b.size)));
}
std::unique_ptr<btCollisionShape> collision_shape(const Cylinder& c) {
  const double r = 0.5 * c.diameter;
  return std::make_unique<btCylinderShapeZ>(btVector3(r, r, 0.5 * c.length));
}
/// Convex hull of samples of the surface: the HCC is convex. A quarter of the radius keeps the hull within 1 % of it.
std::unique_ptr<btCollisionShape> collision_shape(const Hcc& h) {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const SurfacePoint& p : surface_points(h, h.diameter / 8)) hull->addPoint(to_bullet(p.position), false);
  hull->recalcLocalAabb();
  return hull;
}

}  // namespace

BulletBody::BulletBody(const BodySpec& spec)
    : shape_(std::visit([](const auto& s) { return collision_shape(s); }, spec.shape)),
      offset_(std::make_unique<btCompoundShape>()) {
  offset_->addChildShape(btTransform(btQuaternion::getIdentity(), to_bullet(Vec3(-spec.mass.centre_of_mass))),
                         shape_.get());
  const bool still = spec.motion == Motion::fixed;
  btRigidBody::btRigidBodyConstructionInfo info(still ? 0 : spec.mass.mass, nullptr, offset_.get(),
                                                still ? btVector3(0, 0, 0) : to_bullet(spec.mass.inertia));
  info.m_startWorldTransform = btTransform(to_bullet(spec.orientation), to_bullet(spec.position));
  body_ = std::make_unique<btRigidBody>(info);
  body_->setFlags(0);
  body_->setActivationState(DISABLE_DEACTIVATION);
  if (still) return;
  if (spec.motion != Motion::free) body_->setAngularFactor(0);
  if (spec.motion == Motion::fixed_path) body_->setLinearFactor(btVector3(0, 0, 0));
  body_->setLinearVelocity(to_bullet(spec.velocity));
  body_->setAngularVelocity(to_bullet(spec.angular_velocity));
  body_->updateInertiaTensor();
}

}  // namespace nilas::rigid
