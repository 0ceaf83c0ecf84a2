#include "coupling/bullet_check.hpp"

#include <array>
#include <cstdio>

namespace {

bool is_double(std::size_t scalar_size) { return scalar_size == sizeof(double); }
const char* library_for(std::size_t scalar_size) {
  return is_double(scalar_size) ? "nilas::coupling" : "nilas::coupling-f32";
}
const char* precision(std::size_t scalar_size) { return is_double(scalar_size) ? "double" : "single"; }

}  // namespace

const char* nilas_bullet_mismatch(std::size_t scalar_size, std::size_t rigid_body_size, int version) {
  if (scalar_size == sizeof(btScalar) && rigid_body_size == sizeof(btRigidBody) && version == BT_BULLET_VERSION)
    return nullptr;
  thread_local std::array<char, 320> message;
  const bool other_precision = scalar_size != sizeof(btScalar);
  std::snprintf(message.data(), message.size(),
                "this program was built with Bullet %d.%02d in %s precision (btRigidBody of %zu bytes), %s with Bullet "
                "%d.%02d in %s precision (btRigidBody of %zu bytes): %s %s",
                version / 100, version % 100, precision(scalar_size), rigid_body_size, library_for(sizeof(btScalar)),
                BT_BULLET_VERSION / 100, BT_BULLET_VERSION % 100, precision(sizeof(btScalar)), sizeof(btRigidBody),
                other_precision ? "link" : "build both with the same Bullet and link", library_for(scalar_size));
  return message.data();
}
