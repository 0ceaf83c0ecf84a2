// Breakable ice in any Bullet world: attach bodies, add the plugin as an action, step the world as before.
//
//     nilas::IcePlugin ice(ice_spec, contact_spec);
//     ice.attach(*body);
//     world.addAction(&ice);
//
// Inside every Bullet step the plugin catches up: it takes what Bullet did to the body (contacts, joints, damping, host
// impulses) at the start of the step, then advances ice and body together by as many sub-steps as the ice needs under
// Bullet's total force and torque, and writes the body's state back. Momentum closes to round-off at any ratio of the
// two steps. While attached, a body's rotation is integrated by rigid::drift, not by Bullet.
//
// The host stays in charge: it may change mass, inertia, locks, pose and velocity of an attached body, make it static
// or kinematic, put it to sleep, take it out of the world and bring it back. The plugin looks at the body in every
// step; of a body that is not in the world it knows only the address, so the host may delete it; a new body at the same
// address would be taken for the old one, so detach what you delete if you add others later.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <btBulletDynamicsCommon.h>

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coupling/body_load.hpp"
#include "coupling/bullet_check.hpp"
#include "coupling/host_body.hpp"
#include "coupling/impact.hpp"

#pragma GCC visibility push(default)

namespace nilas {
inline namespace NILAS_BULLET {

struct HostOptions {
  /// Ice slower than this sleeps when no body is within reach [m/s]; 0: never. See coupling/rest.hpp.
  double sleep_speed = 1e-3;
  /// Wall time that one Bullet step may spend on ice [s]; 0: as long as it takes. When it is spent, ice and attached
  /// bodies stay behind the host's time and catch up in later steps: no time is dropped, HostStep tells how far behind.
  /// What a host does meanwhile (impulses, mass, path of a kinematic body) takes effect at once, before the rest.
  double budget = 0;
};

/// What the plugin did in the last Bullet step.
struct HostStep {
  std::size_t sub_steps = 0;
  double wall_time = 0;    // s
  double time_behind = 0;  // s that ice and attached bodies are behind the host, for want of budget
  bool asleep = false;     // the ice, at the end of the step
};

class IcePlugin final : public btActionInterface {
 public:
  /// The observer is called after every ice sub-step. Throws std::invalid_argument as sph::Ice does, std::runtime_error
  /// if the host's Bullet is not the one that this library was built with.
  explicit IcePlugin(const sph::IceSpec& ice, const HostOptions& options = {}, Impact::Observer observer = {})
      : IcePlugin(SameBullet(), ice, options, std::move(observer)) {}
  IcePlugin(sph::IceSpec ice, const sph::ContactSpec& contact, const HostOptions& options = {},
            Impact::Observer observer = {})
      : IcePlugin(SameBullet(), (ice.contact = contact, ice), options, std::move(observer)) {}

  /// Couples a body that the host owns, at any time. `shape`: in its geometry frame, whose point `centre_of_mass` is
  /// the body's centre; mass, inertia, pose, velocity and locks are the body's own. boundary_spacing [m]: of its
  /// boundary particles. A body without inertia does not turn. Returns its index in impact().bodies(). Throws
  /// std::invalid_argument for a body that is attached already or has inertia about some axes only.
  std::size_t attach(btRigidBody& body, const rigid::Shape& shape, double boundary_spacing, const Vec3& centre_of_mass,
                     const std::string& name = "body");
  /// The same with the centre of mass of the homogeneous shape; boundary_spacing 0: three quarters of the ice's.
  std::size_t attach(btRigidBody& body, const rigid::Shape& shape, double boundary_spacing = 0,
                     const std::string& name = "body");
  /// The same with the body's own collision shape (rigid/bullet_shape.hpp), in the body's frame.
  std::size_t attach(btRigidBody& body, double boundary_spacing = 0, const std::string& name = "body");
  /// Couples a link, or the base (-1), of a multibody of the host, as above: coupling/host_multibody_link.hpp. `shape`:
  /// `centre_of_mass` is the link's, the origin of Bullet's link frame. Throws std::invalid_argument for a link that is
  /// attached already or has no collider, mass or inertia, for kinematic or static links, and for coordinate velocities
  /// near Bullet's clamp; updateAction throws std::runtime_error when the clamp is reached.
  std::size_t attach(btMultiBody& multibody, int link, const rigid::Shape& shape, double boundary_spacing,
                     const Vec3& centre_of_mass, const std::string& name = "link");
  std::size_t attach(btMultiBody& multibody, int link, const rigid::Shape& shape, double boundary_spacing = 0,
                     const std::string& name = "link");
  /// The same with the shape of the link's collider.
  std::size_t attach(btMultiBody& multibody, int link, double boundary_spacing = 0, const std::string& name = "link");
  /// Lets go of a body for good and gives it back as it was handled before (with several plugins on one body: in the
  /// reverse order of attaching). Not for a deleted body, which needs none. Its entry in impact().bodies() stays as it
  /// was. Throws std::invalid_argument if it is not attached.
  void detach(const btCollisionObject& body);

  /// Ice and bodies. Bodies come and go through attach and detach only.
  Impact& impact() { return impact_; }
  const Impact& impact() const { return impact_; }
  const HostStep& last_step() const { return last_step_; }
  /// felt: the ice meets it. unfelt: the host put it into the ice (deeper than half a spacing); it passes through
  /// without load until no ice touches it. away: not in the world.
  Presence presence(std::size_t body) const { return impact_.presence(body); }

  /// The load of the ice on an attached body; means are over the last step. Throws std::invalid_argument for another.
  BodyLoad load(const btCollisionObject& body) const;

  /// Throws sph::NumericalFailure, out of stepSimulation: nothing is written back in that step, and every later step
  /// throws it again.
  void updateAction(btCollisionWorld* world, btScalar dt) override;
  /// In the drawer's wireframe mode: coupling/debug_drawing.hpp.
  void debugDraw(btIDebugDraw* drawer) override;

 private:
  IcePlugin(SameBullet, const sph::IceSpec& ice, const HostOptions& options, Impact::Observer observer);

  struct Guest {
    std::unique_ptr<HostBody> host;  // null once detached
    bool placed;                     // by the host since the ice last met it: may stand in the ice
  };
  /// A stretch of the host's time that is still to be simulated.
  struct Stretch {
    double duration;
    std::vector<ExternalLoad> loads;
  };
  std::size_t admit(std::unique_ptr<HostBody> host, const Body& body);
  ExternalLoad take_over(std::size_t k, const btCollisionWorld* world, double dt);
  void step(const btCollisionWorld* world, double dt);
  double advance(Stretch& stretch, const std::function<bool()>& spent);

  Impact impact_;
  HostOptions options_;
  std::vector<Guest> guests_;
  std::deque<Stretch> undone_;
  HostStep last_step_;
  std::string failure_;                // why the ice cannot go on
  double simulated_ = 0;               // s, in the last step
  std::vector<BodyAccount> accounts_;  // at its start
};

}  // namespace NILAS_BULLET
}  // namespace nilas

#pragma GCC visibility pop
