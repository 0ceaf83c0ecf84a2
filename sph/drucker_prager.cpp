#include "sph/drucker_prager.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace nilas::sph {

double plane_strain_slope(double angle_deg) {
  const double t = std::tan(angle_deg * std::numbers::pi / 180);
  return t / std::sqrt(9 + 12 * t * t);
}

DruckerPragerCone::DruckerPragerCone(const MaterialSpec& m, const ElasticConstants& e)
    : alpha(plane_strain_slope(m.friction_angle_deg)),
      k(0),
      alpha_psi(plane_strain_slope(m.dilation_angle_deg)),
      bulk_modulus(e.bulk_modulus),
      shear_modulus(e.shear_modulus),
      hardening(m.hardening_modulus) {
  const double t = std::tan(m.friction_angle_deg * std::numbers::pi / 180);
  k = 3 * m.cohesion / std::sqrt(9 + 12 * t * t);
}

double DruckerPragerCone::tension_limit() const {
  if (k == 0) return 0;
  return alpha > 0 ? k / (3 * alpha) : std::numeric_limits<double>::infinity();
}

DruckerPragerCone DruckerPragerCone::cohesionless() const {
  DruckerPragerCone cone = *this;
  cone.k = 0;
  cone.alpha_psi = 0;
  cone.hardening = 0;
  return cone;
}

DruckerPragerCone DruckerPragerCone::hardened(double plastic_strain) const {
  DruckerPragerCone cone = *this;
  cone.k += hardening * plastic_strain / std::sqrt(3.0);
  return cone;
}

ReturnedStress DruckerPragerCone::return_map(const Sym3& trial_deviator, double trial_pressure, double strength) const {
  const double a = strength * alpha, ks = strength * k;
  const double G = shear_modulus, K = bulk_modulus;
  // Ice without strength carries no tension whatever its friction angle; von Mises ice has no tension limit.
  const double tension = strength > 0 ? strength * tension_limit() : 0.0;
  const double sqrt_j2 = std::sqrt(second_invariant(trial_deviator));
  ReturnedStress r{trial_deviator, trial_pressure, 0, 0, false};

  const double f = sqrt_j2 - 3 * a * trial_pressure - ks;
  if (f > 0) {
    r.yielded = true;
    // dlam = f/(G + 9 K alpha alpha_psi + H/3);  sqrt(J2) -= G dlam;  p += 3 K alpha_psi dlam
    const double a_psi = strength * alpha_psi;
    const double dlam = f / (G + 9 * K * a * a_psi + hardening / 3);
    const double returned = sqrt_j2 - G * dlam;
    if (returned >= 0 && sqrt_j2 > 0) {
      r.deviator = (returned / sqrt_j2) * trial_deviator;
      r.pressure = trial_pressure + 3 * K * a_psi * dlam;
      r.multiplier = dlam;
    } else {  // apex: S = 0, p = -k/(3 alpha)
      r.deviator = {};
      r.pressure = -(a > 0 ? ks / (3 * a) : -trial_pressure);
      r.multiplier = sqrt_j2 / G;
    }
  }
  if (r.pressure < -tension) {
    r.yielded = true;
    r.pressure = -tension;
  }
  r.plastic_volume = (r.pressure - trial_pressure) / K;
  return r;
}

}  // namespace nilas::sph
