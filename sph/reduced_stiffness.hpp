// Reduced stiffness: ice made softer by a stated factor for a larger step, which follows from the speed of sound.
//
// With the scale s, Young's modulus goes with s^2 and every sound speed with s. Poisson's ratio, density, strengths,
// friction, hardening, fracture energy and the coefficients of the contact stay as stated, and so do
//   viscosity         alpha (and Kelvin-Voigt damping) goes with 1/s, which keeps alpha c_b: viscosity is no stiffness,
//                     and carries much of the force where failed ice is a fluid
//   toughness         goes with s, because K_IC^2 = E G_f and G_f is kept: fragments, whose size has K_IC/(rho c_p),
//                     and with them the strain of failure stay, and a crack takes G_f (rate-dependent ice)
// What changes with the stiffness:
//   step              1/s, where sound or contact limit it and bodies and ice are slow beside c_b; never past the limit
//                     of the viscosity, which stays
//   elastic strain    1/s^2 at the same stress, at yield, too: bodies move further before ice fails
//   first contact     rho c_p v goes with s, until strength or the contact's own rise time caps it: so do raw peaks
//   contact           stiffness, a share of the P-wave modulus, with s^2 (deeper penetration); damping, a share of the
//                     impedance, with s
//   rate memory       7 dx/c_b with 1/s, as the lattice's own vibrations do (rate-dependent ice)
//   other terms       density diffusion with s, hourglass control with s^2
// The Mach number of an impact grows with 1/s: nothing of this holds for ice that is struck near c_b.
#pragma once

#include "sph/spec.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

/// The ice that is simulated in place of the stated one: softened by numerics.sound_speed_scale, which is 1 in the
/// result. With a scale of 1 the ice itself, to the last bit. Throws std::invalid_argument unless 0 < s <= 1.
IceSpec with_reduced_stiffness(IceSpec ice);

}  // namespace nilas::sph

#pragma GCC visibility pop
