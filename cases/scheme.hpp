// Numerics by name: the presets of the scene language, which `nilas accuracy` measures too.
#pragma once

#include <string>
#include <vector>

#include "sph/spec.hpp"

namespace nilas::cases {

struct Scheme {
  std::string name;
  sph::NumericsSpec numerics;
  sph::ContactSpec contact;
};

/// What measures best in `nilas accuracy`.
Scheme nilas_scheme();
/// What Cai et al. 2025 state, completed where they are silent.
Scheme cai_2025_scheme();
/// The same with the printed viscosity, which gives 2.3 times the printed force: for the record.
Scheme cai_2025_alpha1_scheme();

}  // namespace nilas::cases
