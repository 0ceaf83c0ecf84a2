// The two pair loops of a step: velocity gradient, and acceleration from stress and artificial viscosity.
//
// Each is compiled once per combination of terms (corrected or not, viscous or not, periodic or not), so that a term
// that a scene leaves out costs nothing in the loop, and once per instruction set; the choice is made once per run.
#pragma once

#include "sph/kernel.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"
#include "sph/spec.hpp"

namespace nilas::sph {

/// Which terms the pair loops contain.
struct PairTerms {
  bool corrected = false;
  bool viscous = false;
  bool periodic = false;
  bool single_precision = false;  // the neighbour list must be one for single precision
};

struct PairConstants {
  double smoothing_length;  // m
  double kernel_scale;      // WendlandC2::gradient_scale()
  double sound_speed;       // m/s, c in the artificial viscosity: c_b
  double alpha, beta;       // Monaghan
  Period period;            // m
  double solid_volume;      // m3, of a particle as solid ice
};

/// Sums over a force pass.
struct ForcePassSums {
  double viscous_power = 0;  // W, rate at which viscosity takes kinetic energy, at the mid-step velocity
  ForcePassSums& operator+=(const ForcePassSums& o) {
    viscous_power += o.viscous_power;
    return *this;
  }
};

struct PairPasses {
  /// L_i = SUM_j V_j (v_j - v_i) (x) grad_i W_ij into particles.velocity_gradient; with correction times B_i, which is
  /// stored too. Ice that has yielded is not corrected (B = I): it flows without limit, its neighbours scatter, and a
  /// correction feeds on that until it runs away (measured: Taylor bar, column collapse). Returns the number of other
  /// particles whose moment matrix was too ill-conditioned to invert (B = I there, too).
  std::size_t (*velocity_gradient)(Particles&, const Neighbours&, const PairConstants&);

  /// a_i += SUM_j (V_i V_j / m) (sigma_i + sigma_j) grad_i W_ij - m Pi_ij grad_i W_ij  (Cai et al. 2025, Eq. 18, 21);
  /// with correction (sigma_i B_i + sigma_j B_j). Pairwise antisymmetric: the forces of a pair are equal and opposite.
  /// The net force that the rounding of the sums leaves is 1e-16 of the sum of magnitudes, in single precision 2e-10.
  /// On entry particles.acceleration holds what other terms (contact) contribute. dt [s] serves the viscous power.
  ForcePassSums (*acceleration)(Particles&, const Neighbours&, const PairConstants&, double dt);
};

/// The loops for these terms in the fastest instruction set that this processor has.
PairPasses pair_passes(PairTerms terms);
/// "x86-64-v3" or "baseline".
[[gnu::visibility("default")]] const char* pair_pass_instruction_set();

}  // namespace nilas::sph
