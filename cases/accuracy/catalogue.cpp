#include "cases/accuracy/catalogue.hpp"

namespace nilas::cases {

std::vector<VerificationCase> verification_cases() {
  return {
      elastic_pulse(),
      colliding_bars(),
      viscous_damping(),
      kelvin_voigt_damping(),
      spall(),
      oscillating_plate(),
      breathing_sphere(),
      spinning_disc(),
      spinning_cube(),
      colliding_rings(),
      taylor_bar(),
      st_venant(),
      mass_on_fixed_bar(),
      hertz_plane(),
      hertz_spheres(),
      added_mass(),
      penetration(),
      column_collapse(),
      strengthless_ball(),
      galilean_invariance(),
      mirror_symmetry(),
      rotated_impact(),
      off_centre_impulse(),
      euler_top(),
      dzhanibekov(),
      symmetric_top(),
      constant_load(),
      yawed_flight(),
  };
}

}  // namespace nilas::cases
