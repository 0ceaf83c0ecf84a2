// Artificial stress: a repulsion of particles that pull on each other, against clumping under tension (Monaghan 2000;
// Gray, Monaghan and Swift 2001; Cai et al. 2025, Eq. 23-25, signs, densities and exponents put right):
//
//   a_i += SUM_j m f_ij^n (R_i + R_j) grad_i W_ij,   f_ij = W(r_ij) / W(dx)
//   R_i  = -(epsilon / rho_i^2) SUM_k max(sigma_k, 0) q_k (x) q_k     principal stresses sigma_k, directions q_k
//
// f is held at its value at half a spacing for closer pairs. Uncapped it reaches f^n = 3241 at coincidence (n = 8,
// h = 1.3 dx). With the cap a step of 0.6 h/c_b stays below the explicit limit of the stiffest pair for tension up to
// 0.53 K (epsilon = 0.3, n = 4) and 0.028 K (0.15 and 8; uncapped 0.006 K), far beyond what ice carries: no step limit
// of its own.
//
// It slows clumping, and does not end it: by linear theory on a cubic lattice under tension (h = 1.3 dx, uniaxial or
// not) the fastest growth rate falls from 1.76 to 0.68 sqrt(T/K) c_b/dx with epsilon = 0.3, n = 4 and to 0.77 with 0.15
// and 8; a larger epsilon makes columns of particles slip past each other instead.
//
// The forces of a pair are equal and opposite: momentum is kept to round-off. Angular momentum is not, as with the
// stress itself: the force is not along the line between the two. Tensile ice pulls less than its stress says, by
// epsilon f^n for each pair.
#pragma once

#include "sph/kernel.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"
#include "sph/spec.hpp"

namespace nilas::sph {

class ArtificialStress {
 public:
  ArtificialStress(const NumericsSpec& numerics, double spacing, const Period& period);

  /// Adds to particles.stabilisation [m/s2]. Held particles get their share, too.
  void apply(Particles& particles, const Neighbours& neighbours);
  std::size_t bytes() const { return r_.capacity() * sizeof(Sym3); }

 private:
  double epsilon_, exponent_;
  WendlandC2 kernel_;
  double spacing_;
  Period period_;
  std::vector<Sym3> r_;  // m^5/(kg s^2): R of each particle
};

}  // namespace nilas::sph
