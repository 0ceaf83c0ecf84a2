// Elastic solids under large strain fall apart in plain updated-Lagrangian SPH: cases that are about something else
// take the scheme's numerics with hourglass control, if it has none itself.
#pragma once

#include "sph/spec.hpp"

namespace nilas::cases {

inline sph::NumericsSpec stabilised(sph::NumericsSpec numerics) {
  if (numerics.hourglass_control == 0) numerics.hourglass_control = 1;
  return numerics;
}

}  // namespace nilas::cases
