// Drucker-Prager plasticity with non-associated flow, cone and apex return (Bui et al. 2008 in form; constants of the
// plane-strain fit, Cai et al. 2025, Eq. 34-36). Tension positive, I1 = tr(sigma) = -3p.
//
//   f = sqrt(J2) + alpha I1 - k,   alpha = tan(phi)/sqrt(9 + 12 tan^2 phi),   k = 3c/sqrt(9 + 12 tan^2 phi)
//   g = sqrt(J2) + alpha_psi I1,   alpha_psi = tan(psi)/sqrt(9 + 12 tan^2 psi)
//
// With hardening, k grows by H eps_p/sqrt(3), eps_p = lambda/sqrt(3): without friction (von Mises) the uniaxial flow
// stress sqrt(3) k grows by H per equivalent plastic strain. With friction k grows in the same way, and with it the
// whole cone moves outwards, tension limit included; angles stay.
//
// alpha_psi deviates from Bui's printed 3 sin(psi), which is nine times as large at psi = 12 deg.
#pragma once

#include "sph/elastic_constants.hpp"
#include "sph/symmetric_tensor.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

/// tan(a)/sqrt(9 + 12 tan^2 a): slope of the plane-strain fit for an angle in degrees.
double plane_strain_slope(double angle_deg);

/// Deviator and pressure (compression positive) after a return, and how far the plastic flow went.
struct ReturnedStress {
  Sym3 deviator;          // Pa
  double pressure;        // Pa
  double multiplier;      // plastic multiplier lambda; equivalent plastic strain = multiplier / sqrt(3)
  double plastic_volume;  // plastic volume strain, positive in dilation
  bool yielded;
};

struct DruckerPragerCone {
  double alpha;          // friction
  double k;              // Pa, cohesion
  double alpha_psi;      // dilation
  double bulk_modulus;   // Pa
  double shear_modulus;  // Pa
  double hardening;      // Pa, H; 0: perfect plasticity

  DruckerPragerCone(const MaterialSpec& m, const ElasticConstants& e);

  /// Hydrostatic tension that the ice can carry, k/(3 alpha) [Pa]; infinite for cohesive ice without friction.
  double tension_limit() const;

  /// f(trial) <= 0 and nothing else.
  double yield_function(double sqrt_j2, double pressure) const { return sqrt_j2 - 3 * alpha * pressure - k; }

  /// Return of a trial state to the surface scaled by `strength` in [0, 1]: alpha, k, alpha_psi and the tension limit.
  /// Total: defined for every finite trial, phi = 0 (von Mises, no apex) included. With hardening, k is that before the
  /// step (see hardened) and the returned state lies on the surface of k after it; the apex is that before the step.
  ReturnedStress return_map(const Sym3& trial_deviator, double trial_pressure, double strength = 1) const;

  /// The cone after an equivalent plastic strain.
  DruckerPragerCone hardened(double plastic_strain) const;

  /// Crushed ice: the same friction, no cohesion, no tension, no further dilation (critical state).
  DruckerPragerCone cohesionless() const;
};

}  // namespace nilas::sph

#pragma GCC visibility pop
