// Particle shifting by Fick's law (Lind et al. 2012, without their tensile term), against disorder: particles move from
// where they are many to where they are few,
//
//   delta r_i = -s (h^2 / 2) grad C_i,   grad C_i = SUM_j V_j grad_i W_ij,   |delta r_i| <= dx / 10
//
// s = 1 is the largest share that Lind et al. find stable. No particle moves that is held or within a kernel radius of
// a free surface, where grad C would drive it outwards: sheets thinner than about seven layers are not shifted at all.
// A particle counts as free surface where -SUM_j V0 r_ij . grad_i W_ij, V0 its volume as solid ice, is below 0.75 of
// its value 3 inside solid ice (flat faces: 0.68; inside, at random displacements of 0.3 spacings along each axis: 0.86
// or more; h = 1.3 dx).
//
// Positions alone change: velocities, volumes and stresses are carried along, without the terms that would account for
// the flow through the moving particles. Kept: mass, momentum, kinetic and stored energy. Not kept: angular momentum,
// the centre of mass, and every field's place, by at most the shift.
#pragma once

#include "sph/kernel.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"

namespace nilas::sph {

class Shifting {
 public:
  static constexpr double kLargest = 0.1;  // spacings, per call

  /// share: s above. solid_volume [m3]: V0.
  Shifting(double share, double spacing, double solid_volume, const WendlandC2& kernel, const Period& period);

  /// The neighbour list has to be valid before, and stays so if it allows for kLargest.
  void apply(Particles& particles, const Neighbours& neighbours);
  std::size_t bytes() const { return shift_.capacity() * sizeof(Vec3) + surface_.capacity(); }

 private:
  bool near_surface(const Particles& particles, const Neighbours& neighbours, std::size_t i) const;

  double diffusivity_, largest_, solid_volume_;  // m2 per call, m, m3
  WendlandC2 kernel_;
  Period period_;
  std::vector<Vec3> shift_;            // m
  std::vector<std::uint8_t> surface_;  // 1: free surface
};

}  // namespace nilas::sph
