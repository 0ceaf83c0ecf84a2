// Single precision in the pair loops only: mirrors of what the loops read of a particle, in records of eight floats, so
// that a pack holds twice the neighbours and a record is half as long. All state stays in double.
//
//   motion      x, y, z, V, u, v, w, 0     position from the mean position, in units of a given length; volume in units
//                                          of its cube; velocity [m/s] from the mean velocity
//   stress      xx, yy, zz, xy, xz, yz, 0, 0     [Pa]
//   correction  as the stress, only with gradient correction
//
// Means and differences are formed in double, so neither a far origin nor a fast frame costs digits; what is lost is
// 6e-8 of the distance to the mean position (2^-24: 3e-7 m at 5 m). The unit of length keeps every number of the loops
// far from the ends of the range of floats, whatever the spacing.
#pragma once

#include "sph/particles.hpp"

namespace nilas::sph {

/// Makes room for the mirrors of these particles.
void add_mirrors(Particles& particles);
/// Copies position, volume and velocity; length [m] is the unit.
void mirror_motion(Particles& particles, double length);
/// Copies stress and, if there is one, correction.
void mirror_stress(Particles& particles);

}  // namespace nilas::sph
