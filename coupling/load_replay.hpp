// A recorded load of the ice, played back on a body in any btDiscreteDynamicsWorld, without ice:
//
//     nilas::LoadReplay replay(nilas::read_load_record("loads.csv"), *body);
//     world.addAction(&replay);
//
// The body is taken over and handed back in every Bullet step as IcePlugin does it (coupling/host_body.hpp), and
// advanced in the record's own steps under what the host does to it. Set up as in the recorded run, it moves as there;
// set up otherwise, it meets the same load: the ice does not answer.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>

#include "coupling/bullet_check.hpp"
#include "coupling/host_body.hpp"
#include "coupling/load_record.hpp"

#pragma GCC visibility push(default)

namespace nilas {
inline namespace NILAS_BULLET {

class LoadReplay final : public btActionInterface {
 public:
  /// The record's first row is the moment of the first Bullet step that the replay sees; between rows the force is
  /// constant; after the last there is none. While the body is out of the world the record waits. Mass, inertia, pose,
  /// velocity and locks are the body's own, its centre that of mass. The body must outlive the replay's last step and
  /// is held as by IcePlugin::attach: no gyroscopic flags, never asleep. Throws std::invalid_argument for a body that
  /// IcePlugin would not take.
  LoadReplay(LoadRecord record, btRigidBody& body) : LoadReplay(SameBullet(), std::move(record), body) {}

  /// The body in double precision, with the account of what reached it.
  const Body& body() const { return body_; }
  /// On the record's clock [s].
  double time() const { return time_; }

  void updateAction(btCollisionWorld* world, btScalar dt) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  LoadReplay(SameBullet, LoadRecord record, btRigidBody& body);
  void advance_to(double time, const ExternalLoad& load);

  LoadRecord record_;
  Body body_;
  std::unique_ptr<HostBody> host_;
  double time_;           // s
  std::size_t next_ = 1;  // the first row after time_
};

}  // namespace NILAS_BULLET
}  // namespace nilas

#pragma GCC visibility pop
