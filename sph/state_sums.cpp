#include "sph/state_sums.hpp"

#include "sph/chunked_sum.hpp"

namespace nilas::sph {

StateSums& StateSums::operator+=(const StateSums& o) {
  kinetic += o.kinetic;
  momentum_scale += o.momentum_scale;
  momentum += o.momentum;
  angular_momentum += o.angular_momentum;
  return *this;
}

StateSums state_sums(const Particles& particles) {
  return chunked_sum<StateSums>(particles.size(), [&](std::size_t i, StateSums& sums) {
    const Motion& m = particles.motion[i];
    const Vec3 p = particles.mass * m.velocity;
    sums.kinetic += 0.5 * p.dot(m.velocity);
    sums.momentum_scale += p.norm();
    sums.momentum += p;
    sums.angular_momentum += m.position.cross(p);
  });
}

}  // namespace nilas::sph
