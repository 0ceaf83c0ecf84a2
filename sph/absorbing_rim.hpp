// The circumference of a disc that stands for a wider sheet: what reaches it leaves, as through a sheet without end.
//
// Lysmer & Kuhlemeyer 1969 (J. Eng. Mech. Div. ASCE 95, 859): a plane wave that arrives with velocity v passes a
// boundary without echo if the boundary answers with the traction of the medium beyond it,
//
//     t = -rho (c_l v_n + c_s v_t)         c_s = sqrt(G/rho)
//
// c_l is the speed of the wave that a sheet carries along its plane, sqrt(E / (rho (1 - nu^2))), as what arrives is
// long against the thickness. The traction is spread over a layer of depth d: every particle in it loses velocity at
// the rates c_l/d and c_s/d, v *= exp(-c dt / d), exact and stable for any step. Oblique and bending waves are absorbed
// in part.
#pragma once

#include <cstdint>
#include <vector>

#include "sph/elastic_constants.hpp"
#include "sph/particles.hpp"
#include "sph/spec.hpp"

namespace nilas::sph {

/// What the rim took since the start. World frame, moments about the origin.
struct RimAccount {
  double energy = 0;                    // J
  Vec3 impulse = Vec3::Zero();          // N s, on the ice
  Vec3 angular_impulse = Vec3::Zero();  // N m s, on the ice
  RimAccount& operator+=(const RimAccount& o);
};

/// Whether any piece asks for one.
bool has_absorbing_rim(const IceSpec& spec);

class AbsorbingRim {
 public:
  /// particles: as created. depth [m] of the layer within the circumference. Throws std::invalid_argument unless the
  /// ice is a single disc.
  AbsorbingRim(const IceSpec& spec, const ElasticConstants& elastic, const Particles& particles, double depth);

  /// To be called whenever the particles have been sorted anew.
  void follow(const Particles& particles);

  /// Damps the layer's velocities over dt [s] and books what that takes.
  void apply(Particles& particles, double dt);

  const RimAccount& account() const { return account_; }
  std::size_t bytes() const;

 private:
  Vec3 centre_;                           // m
  double normal_rate_, tangential_rate_;  // 1/s
  std::vector<std::uint8_t> in_layer_;    // by id
  std::vector<std::uint32_t> layer_;      // indices now
  RimAccount account_;
};

}  // namespace nilas::sph
