// Bullet's two precisions share most of their symbol names: a host and a nilas built for different ones, or for
// different versions, can meet in one process, and then crash. This finds out before anything else is called.
//
// IcePlugin asks by itself. A host that opens a library with nilas in it by hand asks before it calls anything of it:
//
//     void* library = dlopen("./plugin.so", RTLD_NOW);
//     const auto mismatch = reinterpret_cast<decltype(&nilas_bullet_mismatch)>(dlsym(library,
//     "nilas_bullet_mismatch")); if (const char* why = mismatch(sizeof(btScalar), sizeof(btRigidBody),
//     BT_BULLET_VERSION)) ...
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstddef>
#include <stdexcept>

#include "rigid/bullet_precision.hpp"

#pragma GCC visibility push(default)

/// Compares the caller's Bullet with the one that this nilas was built with. Null if they agree; otherwise one sentence
/// that says what each has and what to link, which lives until the thread's next call. Does not touch Bullet.
extern "C" const char* nilas_bullet_mismatch(std::size_t scalar_size, std::size_t rigid_body_size, int version);

#pragma GCC visibility pop

namespace nilas {
inline namespace NILAS_BULLET {

/// Exists only where the including program's Bullet is the library's; throws std::runtime_error otherwise. Always
/// compiled into the program: the library's own copy would compare it with itself.
struct SameBullet {
  [[gnu::always_inline]] SameBullet() {
    if (const char* why = nilas_bullet_mismatch(sizeof(btScalar), sizeof(btRigidBody), BT_BULLET_VERSION))
      throw std::runtime_error(why);
  }
};

}  // namespace NILAS_BULLET
}  // namespace nilas
