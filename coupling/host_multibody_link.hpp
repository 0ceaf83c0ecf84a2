// A link, or the base, of a btMultiBody: Bullet moves the mechanism, the ice's impulses reach it through its Jacobian.
//
// A link's velocity is no state of its own, so it is not integrated by the plugin. Algorithm, once per Bullet step:
// 1. Bullet has moved the mechanism from q0 to q1 by its velocities. The coordinates are taken back by half a step for
//    the velocity that the link had there, J qd, and for its mobility J H^-1 J^T (velocity per impulse, link axes);
//    then q1 is restored, bit for bit.
// 2. In the sub-steps the link comes from one step back to the pose in which Bullet has left it, the pivot of its joint
//    going straight, the link turning steadily about it; the ice changes its velocity by the mobility, which turns too.
// 3. The ice's impulse becomes coordinate velocities by H^-1 J^T, and its integral over time coordinates. A floating
//    mechanism is then set right by a motion with its joints locked: its centre of mass has gone exactly as the ice's
//    force has it, and it has gained exactly the momentum and angular momentum that the ice gave.
// What ice does to a lone floating base, to a hinge on a fixed base or along a slider is exact at any Bullet step, and
// the momentum that it gives a floating mechanism always is; elsewhere the scheme is of second order. What Bullet does
// stays as Bullet does it: a force acts from the start of its step; the gyroscopic term and the turning of joints,
// which changes a floating mechanism's momentum a little, are of first order; damping is 0.04 by default. Links of one
// multibody that strike ice together, or ice of several plugins, feel each other one Bullet step late. Bullet does not
// wait for ice that is behind (HostOptions::budget): the link then sets out from correspondingly further back.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <string>

#include "coupling/host_body.hpp"
#include "coupling/host_multibody_tree.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

class HostMultibodyLink final : public HostBody {
 public:
  /// Keeps the multibody awake until release(). link: -1 for the base. largest_push [m]: of any point of the link.
  HostMultibodyLink(btMultiBody& multibody, int link, const std::string& name, double largest_push);

  const btCollisionObject& object() const override { return *collider_; }
  /// Throws std::runtime_error when Bullet has clamped a coordinate velocity (btMultiBody::setMaxCoordinateVelocity).
  HostTurn take_over(Body& body, double dt, double behind) override;
  /// Throws std::runtime_error when Bullet would clamp what the ice gave.
  void hand_back(const Body& body) override;
  void release() override;

 private:
  btMultiBody& multibody_;
  int link_;
  const btCollisionObject* collider_;
  std::string name_;
  double largest_push_;
  bool could_sleep_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> response_;  // coordinate velocities per impulse, link axes, in mid-step
  Eigen::VectorXd lost_;                               // coordinate velocities that the host's precision could not hold
};

/// The link as its host made it: mass, principal inertia, pose and velocity are Bullet's, whose link frame has its
/// origin at the link's centre of mass. `shape`: in its geometry frame, axes those of the link, whose point
/// `centre_of_mass` is the link's centre of mass. Throws std::invalid_argument if there is no such link; if it has no
/// btMultiBodyLinkCollider; if any part of the multibody is kinematic or any link static; if a link that can move has
/// no mass or lacks inertia about an axis; and if a coordinate velocity is above 0.9 of Bullet's clamp, which would
/// change the motion in silence.
Body body_of(const btMultiBody& multibody, int link, const rigid::Shape& shape, double boundary_spacing,
             const Vec3& centre_of_mass, const std::string& name);

/// That of a link's collider. Throws std::invalid_argument if there is none.
const btCollisionShape& collision_shape(const btMultiBody& multibody, int link);

}  // namespace NILAS_BULLET
}  // namespace nilas
