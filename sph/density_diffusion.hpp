// Density diffusion of delta-SPH (Molteni and Colagrossi 2009, in the form of Antuono et al. 2010 without their
// gradient term), against noise in the density:
//
//   d rho_i/dt = delta h c_b SUM_j 2 (rho_j - rho_i) (r_j - r_i) . grad_i W_ij / (r_ij^2 + 0.01 h^2) V_j
//
// which approaches delta h c_b Laplace(rho). As every particle keeps its mass, V = m/rho, it is the same as
//
//   d ln V_i/dt = 2 delta h c_b SUM_j (V_j - V_i) w_ij,   w_ij = w_ji >= 0
//
// and done so: a pair changes ln V of its two particles by opposite amounts. Kept to round-off: every mass, and
// SUM ln V (the geometric mean of the densities); SUM V is not. A constant density stays as it is, at free surfaces,
// too: nothing flows through them, and without the gradient term a hydrostatic density is slowly evened out.
//
// Scattered debris (debris.hpp) takes no part: it keeps its volume and passes nothing on.
//
// It acts on the stress only where pressure = "density". With the other pressure law it changes the weights V of the
// pair sums and nothing else. The elastic energy that it evens out appears in the ledger as stress work that is not
// stored, together with what plasticity takes.
#pragma once

#include "sph/kernel.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"

namespace nilas::sph {

class DensityDiffusion {
 public:
  /// diffusivity [m2/s]: delta h c_b. solid_volume [m3]: of a particle as solid ice.
  DensityDiffusion(double diffusivity, double solid_volume, const WendlandC2& kernel, const Period& period);

  /// Advances the volumes by dt [s], explicitly: stable_step() (time_step.hpp) keeps the limit.
  void apply(Particles& particles, const Neighbours& neighbours, double dt);
  std::size_t bytes() const { return rate_.capacity() * sizeof(double); }

 private:
  double diffusivity_, solid_volume_;
  WendlandC2 kernel_;
  Period period_;
  std::vector<double> rate_;  // 1/s, d ln V/dt
};

}  // namespace nilas::sph
