// Compiled for one precision of Bullet and linked, against all advice, with the other one's library: prints why not.
#include <cstdio>

#include "coupling/bullet_check.hpp"

int main() {
  try {
    nilas::SameBullet();
  } catch (const std::runtime_error& why) {
    std::printf("%s\n", why.what());
  }
}
