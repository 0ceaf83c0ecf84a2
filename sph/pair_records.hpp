// What the pair loops read of the particles, in the precision of the run, group by group: for each quantity the numbers
// of a group's particles stand next to each other, so that a pack of them is one load. All state stays in Particles and
// in double; these are copies, made anew before every pass.
//
//   motion   x, y, z, V, u, v, w
//   stress   sigma: xx, yy, zz, xy, xz, yz; with gradient correction T = sigma B: xx, xy, xz, yx, yy, yz, zx, zy, zz
//
// Empty places of a group have no volume and the position of its first particle: they add nothing to any sum.
//
// In single precision a pack holds twice the neighbours. There positions are taken from the mean position and in units
// of a given length, volumes in units of its cube, velocities [m/s] from the mean velocity; in double they are as they
// are (SI). Means and differences are formed in double, so neither a far origin nor a fast frame costs digits; what is
// lost is 6e-8 of the distance to the mean position (2^-24: 3e-7 m at 5 m). The unit of length keeps every number of
// the loops far from the ends of the range of floats, whatever the spacing.
#pragma once

#include <cstddef>
#include <vector>

namespace nilas::sph {

class Neighbours;
struct Particles;

/// One quantity of the particles of a group: as many as fit into 32 bytes.
template <class Real>
struct alignas(32) GroupOf {
  static constexpr std::size_t kPlaces = 32 / sizeof(Real);
  Real place[kPlaces];
};

/// Per group: motion, then stress.
template <class Real>
struct PairRecords {
  static constexpr std::size_t kMotion = 7, kStress = 6, kCorrectedStress = 9;  // quantities
  /// Quantities per group. With correction one is left over, because groups a power of two apart would share a few
  /// lines of the cache.
  static constexpr std::size_t stride(bool corrected) {
    return corrected ? kMotion + kCorrectedStress + 1 : kMotion + kStress;
  }
  std::vector<GroupOf<Real>> quantities;

  std::size_t bytes() const { return quantities.capacity() * sizeof(GroupOf<Real>); }
};

/// Copies position, volume and velocity, and with_stress the stress, or with correction its product with that.
/// length [m] is the unit in single precision and ignored in double.
template <class Real>
void record(Particles& particles, const Neighbours& neighbours, double length, bool corrected, bool with_stress);

}  // namespace nilas::sph
