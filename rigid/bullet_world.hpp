// A btDiscreteDynamicsWorld with the parts it needs, without gravity (Bullet's default is (0, -10, 0)).
#pragma once

#include <btBulletDynamicsCommon.h>

#include "rigid/bullet_precision.hpp"

#pragma GCC visibility push(default)

namespace nilas::rigid {
inline namespace NILAS_BULLET {

class BulletWorld {
 public:
  BulletWorld() { world_.setGravity(btVector3(0, 0, 0)); }
  btDiscreteDynamicsWorld& world() { return world_; }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

}  // namespace NILAS_BULLET
}  // namespace nilas::rigid

#pragma GCC visibility pop
