// Neo-Hookean ice with Kelvin-Voigt damping (Cai et al. 2025, Eq. 4-9 and 29-31 put right; Simo and Hughes 1998) in
// updated-Lagrangian form: each particle carries its deformation gradient F, moved on with the current L = dv/dx.
//
//   F_{n+1} = (I - dt L/2)^-1 (I + dt L/2) F_n,   J = det F,   b = F F^T,   bbar = J^(-2/3) b
//   W   = K/2 [(J^2 - 1)/2 - ln J] + G/2 (tr bbar - 3)              J per m3 of undeformed ice
//   tau = K/2 (J^2 - 1) I + G dev(bbar) + chi/2 (L b + b L^T),      sigma = tau / J
//
// The paper mixes total- and updated-Lagrangian forms and has two density laws; here volume follows from J alone.
#pragma once

#include "sph/elastic_constants.hpp"
#include "sph/symmetric_tensor.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

/// Damping viscosity chi = kelvin_voigt rho c_b h / 2 [Pa s]; 0 for the other models. In one dimension and small strain
/// the stress is chi times the strain rate, and a sine of wavenumber k decays as exp(-(c_b h k^2/4) t) at 1.
double kelvin_voigt_viscosity(const MaterialSpec& spec, double smoothing_length);

struct NeoHookean {
  ElasticConstants constants;
  double damping;  // Pa s, chi

  NeoHookean(const MaterialSpec& spec, double smoothing_length)
      : constants(spec), damping(kelvin_voigt_viscosity(spec, smoothing_length)) {}

  /// F after dt of L. A step that turns the ice inside out gives det F <= 0: the caller checks it.
  static Mat3 advance(const Mat3& F, const Mat3& velocity_gradient, double dt);

  /// W [J/m3 of undeformed ice]; det F > 0.
  double energy(const Mat3& F) const;
  /// Elastic part of the Kirchhoff stress [Pa]; det F > 0.
  Sym3 elastic_kirchhoff(const Mat3& F) const;
  /// Damping part of the Kirchhoff stress [Pa] at velocity gradient L [1/s].
  Sym3 damping_kirchhoff(const Mat3& F, const Mat3& velocity_gradient) const;
};

}  // namespace nilas::sph

#pragma GCC visibility pop
