// All verification cases, by the numbers V1-V41 of the project's physics reference.
#pragma once

#include "cases/accuracy/verification_case.hpp"

namespace nilas::cases {

// Waves and vibration.
VerificationCase elastic_pulse();         // V9
VerificationCase colliding_bars();        // V10
VerificationCase viscous_damping();       // V11
VerificationCase kelvin_voigt_damping();  // V11
VerificationCase spall();                 // V12
VerificationCase oscillating_plate();     // V13
VerificationCase breathing_sphere();      // V15
VerificationCase spinning_disc();         // V16
VerificationCase spinning_cube();         // V16
VerificationCase colliding_rings();       // V17

// Plastic flow.
VerificationCase taylor_bar();       // V19
VerificationCase column_collapse();  // V26

// Invariance.
VerificationCase galilean_invariance();  // V32
VerificationCase mirror_symmetry();      // V33
VerificationCase rotated_impact();       // V34

// Contact, coupling and penetration.
VerificationCase st_venant();          // V20
VerificationCase mass_on_fixed_bar();  // V21
VerificationCase hertz_plane();        // V22
VerificationCase hertz_spheres();      // V23
VerificationCase added_mass();         // V24
VerificationCase penetration();        // V25
VerificationCase strengthless_ball();  // V29

// Rigid bodies.
VerificationCase off_centre_impulse();  // V36
VerificationCase euler_top();           // V37
VerificationCase dzhanibekov();         // V38
VerificationCase symmetric_top();       // V39
VerificationCase constant_load();       // V40
VerificationCase yawed_flight();        // V41

/// Every case, in the order of the numbers.
std::vector<VerificationCase> verification_cases();

}  // namespace nilas::cases
