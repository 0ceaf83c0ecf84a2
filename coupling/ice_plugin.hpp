// Breakable ice in any btDiscreteDynamicsWorld: attach bodies, add the plugin as an action, step the world as before.
//
//     nilas::IcePlugin ice(ice_spec, contact_spec);
//     ice.attach(*body, nilas::hcc(1.8, 0.3, 0.2));
//     world.addAction(&ice);
//
// Inside every Bullet step the plugin catches up: it takes what Bullet did to the body (contacts, joints, damping, host
// impulses) at the start of the step, then advances ice and body together by as many sub-steps as the ice needs under
// Bullet's total force and torque, and writes the body's state back. Momentum closes to round-off at any ratio of the
// two steps. While attached, a body's rotation is integrated by rigid::drift, not by Bullet.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <string>
#include <vector>

#include "coupling/bullet_check.hpp"
#include "coupling/host_body.hpp"
#include "coupling/impact.hpp"

#pragma GCC visibility push(default)

namespace nilas {
inline namespace NILAS_BULLET {

class IcePlugin final : public btActionInterface {
 public:
  /// The observer is called after every ice sub-step. Throws std::runtime_error if the host's Bullet is not the one
  /// that this library was built with.
  explicit IcePlugin(sph::IceSpec ice, Impact::Observer observer = {})
      : IcePlugin(SameBullet(), std::move(ice), std::move(observer)) {}
  IcePlugin(sph::IceSpec ice, const sph::ContactSpec& contact, Impact::Observer observer = {})
      : IcePlugin(std::move(ice), std::move(observer)) {
    ice_spec_.contact = contact;
  }

  /// Couples a body that the host owns and has added to its world. `shape`: in its geometry frame, whose point
  /// `centre_of_mass` is the body's centre; mass, inertia, pose, velocity and locks (linear and angular factors, static
  /// bodies) are the body's own. boundary_spacing [m]: of its boundary particles. Before the first step only.
  /// The body must outlive the plugin's last step; its gyroscopic flags are cleared and it is kept awake. A body
  /// without inertia does not turn. Throws std::invalid_argument for a kinematic body or one with inertia about some
  /// axes only.
  void attach(btRigidBody& body, const rigid::Shape& shape, double boundary_spacing, const Vec3& centre_of_mass,
              const std::string& name = "body");
  /// The same with the centre of mass of the homogeneous shape; boundary_spacing 0: three quarters of the ice's.
  void attach(btRigidBody& body, const rigid::Shape& shape, double boundary_spacing = 0,
              const std::string& name = "body");

  /// Ice and bodies; built at the first call, after which nothing can be attached.
  Impact& impact();

  void updateAction(btCollisionWorld* world, btScalar dt) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  IcePlugin(SameBullet, sph::IceSpec ice, Impact::Observer observer);

  sph::IceSpec ice_spec_;
  Impact::Observer observer_;
  std::vector<Body> bodies_;  // until impact_ takes them
  std::vector<std::unique_ptr<HostBody>> hosts_;
  std::unique_ptr<Impact> impact_;
};

}  // namespace NILAS_BULLET
}  // namespace nilas

#pragma GCC visibility pop
