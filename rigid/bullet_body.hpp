// A rigid body in Bullet's terms: collision shape and btRigidBody. Headers rigid/bullet_* are the only ones of rigid/
// that touch Bullet; they are compiled once per precision, in nilas::coupling and nilas::coupling-f32.
//
// The Bullet body's centre is the centre of mass and its axes are those of the shape's geometry frame, as in
// rigid::State. Bullet's gyroscopic term is off: the free rotation is rigid::drift's (Bullet's own is first order and
// dissipative).
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "rigid/bullet_precision.hpp"
#include "rigid/spec.hpp"

#pragma GCC visibility push(default)

namespace nilas::rigid {
inline namespace NILAS_BULLET {

inline btScalar to_bullet(double s) { return static_cast<btScalar>(s); }
inline btVector3 to_bullet(const Vec3& v) { return {to_bullet(v[0]), to_bullet(v[1]), to_bullet(v[2])}; }
inline Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion to_bullet(const Quat& q) {
  return {to_bullet(q.x()), to_bullet(q.y()), to_bullet(q.z()), to_bullet(q.w())};
}
inline Quat from_bullet(const btQuaternion& q) { return Quat(q.w(), q.x(), q.y(), q.z()); }

/// A btRigidBody with its shape, as specified: pose, velocities, inertia, locks. `fixed` bodies are static (mass 0);
/// `fixed_path` bodies are dynamic with both factors zero, which holds their path exactly under any load. Never sleeps.
/// For Bullet's contacts an HCC is a convex hull that is right to 1 % of its radius, and a mesh its convex hull.
class BulletBody {
 public:
  explicit BulletBody(const BodySpec& spec);
  btRigidBody& body() { return *body_; }

 private:
  std::vector<std::unique_ptr<btCollisionShape>> parts_;
  std::unique_ptr<btCompoundShape> shape_;  // of the parts, placed so that the centre of mass is the origin
  std::unique_ptr<btRigidBody> body_;
};

}  // namespace NILAS_BULLET
}  // namespace nilas::rigid

#pragma GCC visibility pop
