// A body of the host as the plugin meets it, once per Bullet step.
#pragma once

#include <btBulletDynamicsCommon.h>

#include "coupling/body.hpp"
#include "rigid/bullet_precision.hpp"

#pragma GCC visibility push(default)

namespace nilas {
inline namespace NILAS_BULLET {

/// What a host did to a body in one step.
struct HostTurn {
  ExternalLoad load;      // constant over the step
  bool refitted = false;  // mass, inertia or locks have changed
  bool jumped = false;    // the host put the body elsewhere
};

class HostBody {
 public:
  virtual ~HostBody() = default;
  /// What stands for the body in its world's list of collision objects.
  virtual const btCollisionObject& object() const = 0;
  /// Whether the world (null: one that cannot be asked) has the body. By address only: it may have been deleted.
  bool in(const btCollisionWorld* world) const;
  /// Start of the ice's turn: Bullet has just moved the body by dt [s]. Applies to `body` what Bullet and the host did
  /// to it in this step beyond their total force, and returns that force and torque, constant over the step.
  /// behind [s]: of earlier steps that the ice, and `body` with it, has still to catch up with.
  virtual HostTurn take_over(Body& body, double dt, double behind) = 0;
  /// End of the ice's turn: writes the body's state back to Bullet.
  virtual void hand_back(const Body& body) = 0;
  /// Gives the body back to its host as it was handled before.
  virtual void release() {}

 private:
  mutable int place_ = 0;  // where it was found last
};

}  // namespace NILAS_BULLET
}  // namespace nilas

#pragma GCC visibility pop
