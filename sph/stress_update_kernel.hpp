// The stress update of four particles at once, for ice that stays elastic over the step: most of it, most of the time.
// One copy per instruction set; what yields or has failed is left to the law, particle by particle (stress_update.cpp).
#pragma once

#include "sph/particles.hpp"

namespace nilas::sph {

struct ElasticPackConstants {
  double bulk_modulus, shear_modulus;  // Pa
  /// Elastic while sqrt(J2) <= k + 3 alpha p: Drucker-Prager cone; k infinite where nothing yields.
  double alpha, k;
  double reference_volume;  // m3, of a particle as solid ice
  double smallest_volume;   // m3, below which a particle has collapsed
};

/// Advances particles i to i + 3 over dt as update_stress does, and adds their work to `work` [J], if all four stay
/// elastic, sane and strain by little; otherwise changes nothing and returns false.
using ElasticPackUpdate = bool (*)(Particles&, std::size_t i, const ElasticPackConstants&, double dt, double& work);

namespace baseline {
ElasticPackUpdate select_elastic_update(bool pressure_from_density);
}
namespace v3 {
ElasticPackUpdate select_elastic_update(bool pressure_from_density);
}

}  // namespace nilas::sph
