#include "coupling/host_body.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

bool HostBody::in(const btCollisionWorld* world) const {
  if (!world) return true;
  const btCollisionObjectArray& all = world->getCollisionObjectArray();
  for (int n = 0; n < all.size(); ++n)
    if (all[n] == &object()) return true;
  return false;
}

}  // namespace NILAS_BULLET
}  // namespace nilas
