#include "sph/numerical_failure.hpp"

#include <limits>
#include <sstream>

namespace nilas::sph {

namespace {

/// A vector for a message; no NaN or infinity is ever written, not even there.
std::string text_of(const Vec3& v) {
  if (!v.allFinite()) return "not finite";
  std::ostringstream text;
  text << "[" << v[0] << ", " << v[1] << ", " << v[2] << "]";
  return text.str();
}

}  // namespace

NumericalFailure failure_of(const Particles& particles, const Neighbours& neighbours, const Period& period,
                            std::size_t particle, const std::string& what) {
  std::ostringstream text;
  const Motion& m = particles.motion[particle];
  std::size_t within = 0;
  std::uint32_t nearest = 0;
  double distance = std::numeric_limits<double>::infinity();
  neighbours.for_each_near(particle, [&](std::uint32_t j) {
    const double d = shortest_image(particles.motion[j].position - m.position, period).norm();
    within += d < neighbours.reach();
    if (d < distance) distance = d, nearest = j;
  });
  const double density = particles.density(particle);
  text << "ice particle " << particles.id[particle] << " " << what << ": position " << text_of(m.position)
       << " m, velocity " << text_of(m.velocity) << " m/s, acceleration " << text_of(particles.acceleration[particle])
       << " m/s2, density " << (std::isfinite(density) ? std::to_string(density) : "not finite") << " kg/m3, " << within
       << " neighbours in reach";
  if (std::isfinite(distance)) text << ", nearest is particle " << particles.id[nearest] << " at " << distance << " m";
  return NumericalFailure(text.str());
}

}  // namespace nilas::sph
