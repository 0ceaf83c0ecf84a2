// The stable step of the ice and the name of what limits it.
#pragma once

#include "sph/contact.hpp"
#include "sph/elastic_constants.hpp"
#include "sph/spec.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

enum class Limiter {
  sound_speed,
  acceleration,
  viscosity,
  density_diffusion,
  kelvin_voigt,
  hourglass_control,
  contact,
  max_step,
  body_rotation,
  body_speed,
  coupling
};
const char* name(Limiter limiter);

struct StepLimit {
  double dt;  // s
  Limiter limiter;
};

/// The smallest of (h: smoothing length, c: c_b or c_p as the scene asks; Cai et al. 2025, Eq. 29, square root put
/// right)
///   sound speed        cfl h / (c + |v|max)
///   acceleration       cfl sqrt(h / |a|max)
///   viscosity          0.4 cfl h^2 / nu_L,  nu_L = 3 alpha h c_b / 10   (only with artificial viscosity)
///   density diffusion  cfl h / (7 delta c_b)   (only where it is on; at cfl = 1 the explicit limit by Gershgorin's
///   bound,
///                      rates of at most 2 D 2 SUM V |f|, D = delta h c_b, with the kernel integral 7/(2 h^2) for the
///                      sum)
///   Kelvin-Voigt       0.4 cfl h^2 / (chi/rho)                          (only with Kelvin-Voigt damping, chi [Pa s])
///   hourglass control  2 cfl (sqrt(1 + z^2) - z) h / sqrt(1.35 c_p^2 + 7 xi c_s^2),  z = 0.1
///                      (at cfl = 1 the explicit limit of the shortest waves, rho w^2 = M g^2 + xi G (l - g^2) with
///                      damping z; hourglass_control.hpp. Wendland C2 has g^2 h^2 <= 1.35, l h^2 <= 7)
///   contact            2 cfl / (w (sqrt(1 + z^2) + z)),  w = sqrt(k/m), z = damping/(2 m w)
///                      (at cfl = 1 the explicit limit of one ice particle on its penalty spring and dashpot)
///   max_step           as the scene states
/// speed [m/s] and acceleration [m/s2]: largest magnitudes over the ice, speed relative to its mean.
StepLimit stable_step(const NumericsSpec& numerics, const ElasticConstants& elastic, const ContactConstants& contact,
                      double particle_mass, double smoothing_length, double speed, double acceleration,
                      bool has_contact, double kelvin_voigt_viscosity = 0);

}  // namespace nilas::sph

#pragma GCC visibility pop
