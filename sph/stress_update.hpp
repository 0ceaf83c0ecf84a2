// Advances volume and stress of all particles over dt with the stored velocity gradients.
#pragma once

#include "sph/material.hpp"
#include "sph/particles.hpp"

namespace nilas::sph {

/// Sums over one update. The density of the first particle that went out of range, if any, is reported by its index.
struct StressUpdateSums {
  double work = 0;                                          // J, SUM V (sigma_old + sigma_new)/2 : D dt
  std::size_t failed = 0;                                   // particles that have failed (Particles::failed)
  std::size_t out_of_range = static_cast<std::size_t>(-1);  // lowest index with a density that is not sane
  StressUpdateSums& operator+=(const StressUpdateSums& o);
};

/// V <- V exp(tr(L) dt) (continuity, Cai et al. 2025, Eq. 17); stress turned with the spin (objective_update.hpp), then
/// the material's law. Neo-Hookean ice: F moved on with L, then V = V0 det F and the stress from F; what the work
/// exceeds the stored energy by has gone into Kelvin-Voigt damping.
StressUpdateSums update_stress(Particles& particles, const Material& material, double reference_density, double dt);

/// Turns the correction matrices with the spin over dt. They belong to the positions of the last gradient pass; the
/// force pass half a step later needs them as they are there: then its forces exert no moment in ice that turns
/// rigidly.
void turn_correction(Particles& particles, double dt);

/// Energy stored in elastic strain [J]: SUM V (J2/(2G) + p^2/(2K)), of neo-Hookean ice SUM V0 W.
double elastic_energy(const Particles& particles, const Material& material);

}  // namespace nilas::sph
