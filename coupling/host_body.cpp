#include "coupling/host_body.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

bool HostBody::in(const btCollisionWorld* world) const {
  if (!world) return true;
  const btCollisionObjectArray& all = world->getCollisionObjectArray();
  if (place_ < all.size() && all[place_] == &object()) return true;
  for (place_ = 0; place_ < all.size(); ++place_)
    if (all[place_] == &object()) return true;
  return false;
}

}  // namespace NILAS_BULLET
}  // namespace nilas
