// A body of the host as the plugin meets it, once per Bullet step.
#pragma once

#include <btBulletDynamicsCommon.h>

#include "coupling/body.hpp"
#include "rigid/bullet_precision.hpp"

#pragma GCC visibility push(default)

namespace nilas {
inline namespace NILAS_BULLET {

class HostBody {
 public:
  virtual ~HostBody() = default;
  /// What stands for the body in its world's list of collision objects.
  virtual const btCollisionObject& object() const = 0;
  /// Start of the ice's turn: Bullet has just moved the body by dt [s]. Applies to `body` what Bullet and the host did
  /// to it in this step beyond their total force, and returns that force and torque, constant over the step.
  virtual ExternalLoad take_over(Body& body, double dt) = 0;
  /// End of the ice's turn: writes the body's state back to Bullet.
  virtual void hand_back(const Body& body) = 0;
};

}  // namespace NILAS_BULLET
}  // namespace nilas

#pragma GCC visibility pop
