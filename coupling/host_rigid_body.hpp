// A btRigidBody of the host: what Bullet and the host did to it in a step, found by comparison with what the plugin
// last wrote (algorithm D: everything but the total force is applied at the start of the step; spread over the step it
// would leave a penetration that Bullet turns into a bounce).
//
// A displacement beyond the body's own motion is a push (split impulses of Bullet's contacts) up to a quarter of the
// ice's spacing, which contact can answer, and a jump from there on.
#pragma once

#include <string>

#include "coupling/host_body.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

class HostRigidBody final : public HostBody {
 public:
  /// Takes charge of the body: its gyroscopic flags are cleared and it is kept awake, until release().
  /// largest_push [m]: of any point of the body.
  HostRigidBody(btRigidBody& bullet, double largest_push);

  const btCollisionObject& object() const override { return bullet_; }
  HostTurn take_over(Body& body, double dt, double behind) override;
  void hand_back(const Body& body) override;
  void release() override;

  /// How the host has the body move. free: dynamic. held: dynamic, but asleep or disabled. still: static, moved by hand
  /// if at all. animated: kinematic.
  enum class Drive { free, held, still, animated };

 private:
  /// What a host may change while the body is attached.
  struct Facts {
    Drive drive;
    double inverse_mass;
    Vec3 inverse_inertia, linear_factor, angular_factor;
    bool operator==(const Facts&) const = default;
  };
  static Facts facts_of(const btRigidBody& bullet);
  bool refit(Body& body);
  bool place(Body& body, const Vec3& push, const rigid::Quat& turn) const;
  HostTurn follow_flight(Body& body, double dt);
  HostTurn follow_animation(Body& body, double dt);
  HostTurn follow_pose(Body& body);

  btRigidBody& bullet_;
  double largest_push_;
  int flags_, activation_;  // as the host had them
  Facts facts_;
  Vec3 ice_impulse_ = Vec3::Zero();  // N s, so far
  // What the plugin last wrote, in double whatever the host's precision.
  Vec3 position_, velocity_, angular_velocity_;
  rigid::Quat orientation_;
};

/// The body as its host made it: mass, inertia, pose, velocity and locks (linear and angular factors, static bodies)
/// are the host's. `shape`: in its geometry frame, whose point `centre_of_mass` is the body's centre. A body without
/// inertia does not turn. Throws std::invalid_argument for a body with inertia about some axes only.
Body body_of(const btRigidBody& bullet, const rigid::Shape& shape, double boundary_spacing, const Vec3& centre_of_mass,
             const std::string& name);

}  // namespace NILAS_BULLET
}  // namespace nilas
