#include "sph/reduced_stiffness.hpp"

#include <stdexcept>

namespace nilas::sph {

IceSpec with_reduced_stiffness(IceSpec ice) {
  const double s = ice.numerics.sound_speed_scale;
  if (!(s > 0 && s <= 1))
    throw std::invalid_argument("numerics.sound_speed_scale = " + std::to_string(s) + "; allowed: > 0 and <= 1");
  ice.material.young_modulus *= s * s;
  ice.material.rate_dependent.fracture_toughness *= s;
  ice.material.kelvin_voigt /= s;
  ice.numerics.viscosity_alpha /= s;
  ice.numerics.sound_speed_scale = 1;
  return ice;
}

}  // namespace nilas::sph
