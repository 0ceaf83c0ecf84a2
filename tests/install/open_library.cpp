// Opens a library by hand and asks what Bullet it was built for. Uses Bullet itself, as a host does.
#include <dlfcn.h>

#include <cstdio>

#include "coupling/bullet_check.hpp"

int main(int, char** arguments) {
  btSphereShape shape(1);
  btRigidBody body(1, nullptr, &shape);
  void* library = dlopen(arguments[1], RTLD_NOW);
  void* symbol = library ? dlsym(library, "nilas_bullet_mismatch") : nullptr;
  if (!symbol) {
    std::printf("%s\n", dlerror());
    return 1;
  }
  const auto mismatch = reinterpret_cast<decltype(&nilas_bullet_mismatch)>(symbol);
  const char* why = mismatch(sizeof(btScalar), sizeof(btRigidBody), BT_BULLET_VERSION);
  std::printf("%s\n", why ? why : "same Bullet");
  return 0;
}
