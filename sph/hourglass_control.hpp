// Hourglass control: resists the part of the motion that the velocity gradient does not see, such as a zig-zag of
// neighbouring particles, which causes no stress and therefore grows unopposed. After Zhang, Wu, Lourenco & Hu (2024,
// arXiv 2409.11474), re-derived.
//
// A pair's relative velocity is compared with what the gradients of its two particles predict, and the difference is
// accumulated as the pair's own displacement u_ij, turned with the mean spin w of the two:
//
//     du_ij/dt = v_ij - (L_i + L_j)/2 r_ij + w x u_ij,       v_ij = v_i - v_j,  r_ij = r_i - r_j
//     F_ij     = 2 xi G V_i V_j f u_ij,                      grad_i W_ij = f r_ij,  f <= 0
//
// xi has a meaning: SUM_j 2 V_j f u_ij is the usual SPH Laplacian, and on a lattice a wave exp(i k.r) meets the
// stiffness xi G (l - g^2), with l(k) = SUM_j 2 V_j |f| (1 - cos k.r) of the Laplacian and g(k) = |SUM_j V_j f r sin
// k.r| of the gradient, g^2 <= l. At xi = 1 a transverse wave, G g^2 from the stress, thus has the stiffness G l of the
// Laplacian form of an isotropic solid, at every wavelength; long waves, l = g^2 = k^2, feel nothing. The paper's 4 is
// xi = 2 here.
//
// What differs from the paper: it accumulates the acceleration of each particle. That outlives the neighbours it came
// from, acts between bodies that only touch, does not turn with the ice, and need not sum to zero over the particles
// once their masses per volume differ. Here what is stored belongs to a pair, and goes with it: zero when the pair
// comes within 2h, dropped when it leaves or when either particle has failed, and never there between two pieces of
// ice. u_ji = -u_ij to the last bit, so that momentum closes to round-off. The forces are not central: like those of
// the stress they keep the angular momentum only as far as the ice is resolved.
#pragma once

#include "sph/elastic_constants.hpp"
#include "sph/kernel.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"

namespace nilas::sph {

/// Four pairs of one particle; the last four are filled up with the particle itself, which adds nothing.
struct HourglassPairs {
  std::uint32_t neighbour[4];
  double x[4] = {}, y[4] = {}, z[4] = {};  // m, u_ij
};

/// What the pair loop needs beside particles and pairs.
struct HourglassStep {
  double strength;        // Pa/m5, 2 xi G f at t = 1 (kernel.hpp)
  double half_inverse_h;  // 1/m
  Period period;          // m
  double elapsed;         // s, since the displacements were brought up to date
  double half_step;       // s, since the velocity gradients were
};

/// The pair loop; `first` as in HourglassControl.
using HourglassPass = void (*)(Particles&, const std::vector<std::uint64_t>& first, std::vector<HourglassPairs>&,
                               const HourglassStep&);

class HourglassControl {
 public:
  /// xi > 0: strength. Pairs are listed from the first `follow` on.
  HourglassControl(double xi, const ElasticConstants& elastic, const WendlandC2& kernel, const Period& period,
                   std::size_t particles);

  /// Takes over a rebuilt neighbour list; pairs that were listed before keep their displacement, though the particles
  /// have been sorted anew.
  void follow(const Neighbours& neighbours, const Particles& particles);

  /// Brings the pairs' displacements from the last mid-step to this one and adds the acceleration they cause to
  /// particles.stabilisation [m/s2]. On entry: positions at n + 1/2, velocities and their gradients at n; dt [s] is the
  /// whole step.
  void apply(Particles& particles, double dt);

  std::size_t bytes() const;

 private:
  HourglassStep step_;
  HourglassPass pass_;
  std::vector<std::uint64_t> first_;  // of each particle's pairs; one past the end last
  std::vector<HourglassPairs> pairs_;
  std::vector<std::uint32_t> index_of_id_;  // of each particle, in order of creation, at the last `follow`
};

}  // namespace nilas::sph
