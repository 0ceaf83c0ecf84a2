// Ice and its loads through a host's btIDebugDraw, as lines.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstddef>

#include "coupling/impact.hpp"
#include "rigid/bullet_precision.hpp"

#pragma GCC visibility push(default)

namespace nilas {
inline namespace NILAS_BULLET {

struct DebugDrawing {
  // Red, green, blue, 0 to 1; none is a default colour of Bullet's.
  btVector3 intact{btScalar(0.6), btScalar(0.8), 1};
  btVector3 yielded{1, btScalar(0.6), btScalar(0.1)};
  btVector3 failed{btScalar(0.7), btScalar(0.1), btScalar(0.3)};
  btVector3 traction{1, 0, 1};
  double cross_size = 0.5;           // spacings, tip to tip
  double traction_length = 1e-6;     // spacings per Pa: 1 MPa is a spacing long
  double longest_traction = 20;      // spacings; a line that would be longer is cut there
  std::size_t most_crosses = 20000;  // in larger ice about so many particles are drawn, evenly spread
};

/// Draws each ice particle as three crossed lines along the world axes, coloured by its condition (sph::Condition), and
/// on each boundary particle that carried force in the last sub-step a line that ends there and comes from where the
/// ice presses: against the force, so that it lies outside the body. Which particles are drawn of large ice is a matter
/// of their number in order of creation: the same ones in every frame.
void debug_draw(const Impact& impact, btIDebugDraw& drawer, const DebugDrawing& style = {});

}  // namespace NILAS_BULLET
}  // namespace nilas

#pragma GCC visibility pop
