// Re-initialisation of the density by Shepard's interpolation (Shepard 1968; in SPH: Bonet and Lok 1999), itself
// included:
//
//   rho_i <- SUM_j m W_ij / SUM_j V_j W_ij
//
// As every particle keeps its mass, this is V_i <- SUM_j V_j W_ij / SUM_j W_ij: a weighted mean of the volumes around.
// A constant density stays as it is, and no new density lies outside those around it. At a free surface the mean is
// over the ice that there is: the density does not drop there, as it would with SUM_j m W_ij alone. What it does not do
// is restore a density that all neighbours have lost: the mean of a region stays about as it is. Kept exactly: every
// mass; not SUM V. Scattered debris (debris.hpp) takes no part. On the stress it acts as density diffusion does
// (density_diffusion.hpp), likewise in the ledger.
#pragma once

#include "sph/kernel.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"

namespace nilas::sph {

/// Replaces all volumes. solid_volume [m3]: of a particle as solid ice. Holds one number per particle while it runs,
/// none between calls.
void reinitialise_density(Particles& particles, const Neighbours& neighbours, double solid_volume,
                          const WendlandC2& kernel, const Period& period);

}  // namespace nilas::sph
