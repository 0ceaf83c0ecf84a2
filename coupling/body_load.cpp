#include "coupling/body_load.hpp"

namespace nilas {

BodyLoad load_since(const BodyAccount& before, const Body& body, double duration) {
  const BodyAccount& now = body.account();
  BodyLoad load;
  load.impulse = now.ice_impulse;
  load.angular_impulse = now.ice_angular_impulse;
  if (duration > 0) {
    load.force = (now.ice_impulse - before.ice_impulse) / duration;
    load.moment = (now.ice_angular_impulse - before.ice_angular_impulse) / duration;
  }
  const double pressed = now.contact_impulse - before.contact_impulse;
  if (pressed > 0) {
    const Vec3 lever_body = (now.contact_impulse_moment_body - before.contact_impulse_moment_body) / pressed;
    load.centre = body.state().position + body.state().orientation * lever_body;
  }
  return load;
}

}  // namespace nilas
