#include "coupling/clearance.hpp"

#include <algorithm>
#include <limits>

namespace nilas {

double clearance(const sph::Ice& ice, const Body& body) {
  const Vec3& centre = body.spec().mass.centre_of_mass;
  const double reach = body.enclosing_radius() + ice.spacing();
  const Mat3 to_body = body.state().orientation.toRotationMatrix().transpose();
  double least = std::numeric_limits<double>::infinity();
  for (const sph::Motion& m : ice.particles().motion) {
    const Vec3 lever = m.position - body.state().position;
    if (lever.squaredNorm() > reach * reach) continue;
    least = std::min(least, rigid::closest_point(body.spec().shape, to_body * lever + centre).distance);
  }
  return least;
}

}  // namespace nilas
