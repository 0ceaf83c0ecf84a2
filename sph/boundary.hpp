// Boundary particles: the surface of a rigid body as the ice sees it. The only thing that ice and bodies share.
#pragma once

#include <vector>

#include "sph/vector.hpp"

namespace nilas::sph {

/// One sample of a body's surface. World frame, SI. The owner of the body writes position, velocity and normal before
/// every step; the ice writes `force`, what it exerts on this particle over that step (mean over the step).
struct BoundaryParticle {
  Vec3 position;  // m
  Vec3 velocity;  // m/s
  Vec3 normal;    // unit, out of the body
  double area;    // m2
  Vec3 force;     // N, of the ice on the body; traction = force / area
};

/// The boundary particles of one body.
struct Surface {
  double spacing = 0;   // m
  bool present = true;  // false: the ice does not meet it
  std::vector<BoundaryParticle> particles;
  Vec3 reference = Vec3::Zero();  // m, point about which `moment` is taken: the body's centre of mass
  Vec3 force = Vec3::Zero();      // N, of the ice on the body over the last step
  /// N m, of the same force about `reference`. Each interaction acts at its ice particle, so that what the ice loses in
  /// angular momentum the body gains to round-off.
  Vec3 moment = Vec3::Zero();
};

}  // namespace nilas::sph
