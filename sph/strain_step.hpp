// One step of one particle, as the constitutive laws see it.
#pragma once

#include "sph/symmetric_tensor.hpp"

namespace nilas::sph {

struct StrainStep {
  Sym3 strain;             // D dt
  double compression = 0;  // rho/rho0 - 1, at the end of the step
  double dt = 0;           // s; 0 for a law without rates
};

}  // namespace nilas::sph
