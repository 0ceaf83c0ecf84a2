#include "cases/accuracy/catalogue.hpp"

namespace nilas::cases {

std::vector<VerificationCase> verification_cases() {
  return {
      elastic_pulse(), st_venant(),     mass_on_fixed_bar(), hertz_plane(),        hertz_spheres(),
      added_mass(),    penetration(),   strengthless_ball(), off_centre_impulse(), euler_top(),
      dzhanibekov(),   symmetric_top(), constant_load(),     yawed_flight(),
  };
}

}  // namespace nilas::cases
