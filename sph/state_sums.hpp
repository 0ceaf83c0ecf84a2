// Kinetic energy and momentum of all particles. World frame, moments about the origin.
#pragma once

#include "sph/particles.hpp"

namespace nilas::sph {

struct StateSums {
  double kinetic = 0;                    // J
  double momentum_scale = 0;             // N s, SUM m |v|
  Vec3 momentum = Vec3::Zero();          // N s
  Vec3 angular_momentum = Vec3::Zero();  // N m s
  StateSums& operator+=(const StateSums& o);
};

StateSums state_sums(const Particles& particles);

}  // namespace nilas::sph
