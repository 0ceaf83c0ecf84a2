// Elastic constants and wave speeds of isotropic ice, derived once from Young's modulus and Poisson's ratio.
#pragma once

#include <cmath>

#include "sph/spec.hpp"

namespace nilas::sph {

struct ElasticConstants {
  double density;        // kg/m3
  double bulk_modulus;   // Pa, K
  double shear_modulus;  // Pa, G

  explicit ElasticConstants(const MaterialSpec& m)
      : density(m.density),
        bulk_modulus(m.young_modulus / (3 * (1 - 2 * m.poisson_ratio))),
        shear_modulus(m.young_modulus / (2 * (1 + m.poisson_ratio))) {}

  double p_wave_modulus() const { return bulk_modulus + 4 * shear_modulus / 3; }  // Pa, K + 4G/3
  double bulk_sound_speed() const { return std::sqrt(bulk_modulus / density); }   // m/s, c_b
  double p_wave_speed() const { return std::sqrt(p_wave_modulus() / density); }   // m/s, c_p
  /// m/s, of a wave along a plate that is thin against its length: sqrt(E / (rho (1 - nu^2)))
  double plate_wave_speed() const {
    return std::sqrt(4 * shear_modulus * (3 * bulk_modulus + shear_modulus) /
                     (density * (3 * bulk_modulus + 4 * shear_modulus)));
  }
  double impedance() const { return density * p_wave_speed(); }  // Pa s/m, rho c_p
};

}  // namespace nilas::sph
