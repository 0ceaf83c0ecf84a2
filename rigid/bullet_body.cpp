#include "rigid/bullet_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nilas::rigid {
inline namespace NILAS_BULLET {

namespace {

constexpr double outer_margin = 0.005;  // of the smallest radius: Bullet adds its margin around a cone and a hull

std::unique_ptr<btCollisionShape> collision_shape(const Sphere& s) {
  return std::make_unique<btSphereShape>(to_bullet(0.5 * s.diameter));
}
std::unique_ptr<btCollisionShape> collision_shape(const Box& b) {
  return std::make_unique<btBoxShape>(to_bullet(Vec3(0.5 * b.size)));
}
std::unique_ptr<btCollisionShape> collision_shape(const Cylinder& c) {
  const double r = 0.5 * c.diameter;
  auto shape = std::make_unique<btCylinderShapeZ>(to_bullet(Vec3(r, r, 0.5 * c.length)));
  shape->setMargin(to_bullet(0.02 * std::min(r, 0.5 * c.length)));  // its edges are rounded by the margin
  return shape;
}
/// Convex hull of support points: rings of the nose, the last one at the shoulder, and the rim of the tail. The hull's
/// sides lie up to half a per cent of the radius inside the shape; the margin, which Bullet adds around a hull (4 cm by
/// default), brings them out by as much.
std::unique_ptr<btCollisionShape> collision_shape(const Hcc& h) {
  constexpr int kSides = 32, kRings = 16;
  constexpr double kShoulder = 0.499 * std::numbers::pi, kRim = 0.75 * std::numbers::pi;  // polar angles of the normal
  auto hull = std::make_unique<btConvexHullShape>();
  const auto add_ring = [&](double polar) {
    for (int n = 0; n < kSides; ++n) {
      const double azimuth = 2 * std::numbers::pi * n / kSides;
      const Vec3 normal(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
      hull->addPoint(to_bullet(support_point(h, normal)), false);
    }
  };
  for (int ring = 1; ring <= kRings; ++ring) add_ring(kShoulder * ring / kRings);
  add_ring(kRim);
  hull->setMargin(to_bullet(0.0025 * h.diameter));
  hull->recalcLocalAabb();
  return hull;
}

std::unique_ptr<btCollisionShape> collision_shape(const Capsule& c) {
  return std::make_unique<btCapsuleShapeZ>(to_bullet(0.5 * c.diameter), to_bullet(c.length - c.diameter));
}
std::unique_ptr<btCollisionShape> collision_shape(const Cone& c) {
  auto shape = std::make_unique<btConeShapeZ>(to_bullet(0.5 * c.diameter), to_bullet(c.length));
  shape->setMargin(to_bullet(outer_margin * std::min(0.5 * c.diameter, c.length)));
  return shape;
}
std::unique_ptr<btCollisionShape> collision_shape(const Mesh& m) {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& vertex : m.vertices()) hull->addPoint(to_bullet(vertex), false);
  const double least = enclosing_radii(m, centroid(m)).minCoeff();
  hull->setMargin(to_bullet(outer_margin * least));
  hull->recalcLocalAabb();
  return hull;
}

/// Adds the shape at a place, a compound part by part.
void add(btCompoundShape& all, std::vector<std::unique_ptr<btCollisionShape>>& owned, const Shape& shape,
         const Vec3& position, const Quat& orientation) {
  const auto add_one = [&](const auto& s) {
    if constexpr (std::is_same_v<decltype(s), const Compound&>) {
      for (const Part& part : s.parts)
        add(all, owned, part.shape, position + orientation * part.position, orientation * part.orientation);
    } else {
      owned.push_back(collision_shape(s));
      all.addChildShape(btTransform(to_bullet(orientation), to_bullet(position)), owned.back().get());
    }
  };
  std::visit(add_one, shape);
}

}  // namespace

BulletBody::BulletBody(const BodySpec& spec) : shape_(std::make_unique<btCompoundShape>()) {
  add(*shape_, parts_, spec.shape, -spec.mass.centre_of_mass, Quat::Identity());
  const bool still = spec.motion == Motion::fixed;
  btRigidBody::btRigidBodyConstructionInfo info(still ? 0 : to_bullet(spec.mass.mass), nullptr, shape_.get(),
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

}  // namespace NILAS_BULLET
}  // namespace nilas::rigid
