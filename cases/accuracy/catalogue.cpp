#include "cases/accuracy/catalogue.hpp"

namespace nilas::cases {

std::vector<VerificationCase> verification_cases() {
  return {
      elastic_pulse(),     colliding_bars(),   viscous_damping(),     kelvin_voigt_damping(), spall(),
      oscillating_plate(), breathing_sphere(), spinning_disc(),       spinning_cube(),        colliding_rings(),
      taylor_bar(),        column_collapse(),  galilean_invariance(), mirror_symmetry(),      rotated_impact(),
  };
}

}  // namespace nilas::cases
