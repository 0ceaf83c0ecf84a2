// A btRigidBody of the host: what Bullet did to it in a step, found by comparison with what the plugin last wrote.
#pragma once

#include <string>

#include "coupling/host_body.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

class HostRigidBody final : public HostBody {
 public:
  /// Takes charge of the body: its gyroscopic flags are cleared and it is kept awake.
  explicit HostRigidBody(btRigidBody& bullet);

  const btCollisionObject& object() const override { return bullet_; }
  ExternalLoad take_over(Body& body, double dt) override;
  void hand_back(const Body& body) override;

 private:
  btRigidBody& bullet_;
  // What the plugin last wrote, in double whatever the host's precision.
  Vec3 position_, velocity_, angular_velocity_;
  rigid::Quat orientation_;
};

/// The body as its host made it: mass, inertia, pose, velocity and locks (linear and angular factors, static bodies) are
/// the host's. `shape`: in its geometry frame, whose point `centre_of_mass` is the body's centre. A body without inertia
/// does not turn. Throws std::invalid_argument for a kinematic body or one with inertia about some axes only.
Body body_of(const btRigidBody& bullet, const rigid::Shape& shape, double boundary_spacing, const Vec3& centre_of_mass,
             const std::string& name);

}  // namespace NILAS_BULLET
}  // namespace nilas
