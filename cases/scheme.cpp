#include "cases/scheme.hpp"

namespace nilas::cases {

Scheme cai_2025_scheme() { return {"cai-2025", {}, {}}; }

Scheme cai_2025_alpha1_scheme() {
  Scheme scheme = cai_2025_scheme();
  scheme.name = "cai-2025-alpha1";
  scheme.numerics.viscosity_alpha = 1;
  return scheme;
}

Scheme nilas_scheme() {
  Scheme scheme = cai_2025_scheme();
  scheme.name = "nilas";
  // Exact for linear fields in intact ice, its surfaces included; at h = 1.3 spacings and plain it is 2.1 % low.
  scheme.numerics.gradient_correction = true;
  // The rise of a force takes 2 pi dx / (c_p sqrt(stiffness)): a stiffer penalty is sharper.
  scheme.contact.stiffness = 1;
  return scheme;
}

}  // namespace nilas::cases
