// The particles of the ice: one record per quantity, sorted as neighbours.hpp says. All of one mass (one spacing, one
// density).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sph/pair_records.hpp"
#include "sph/symmetric_tensor.hpp"

namespace nilas::sph {

/// What moves a particle: one cache line.
struct alignas(64) Motion {
  Vec3 position;      // m
  double volume;      // m3, mass / density
  Vec3 velocity;      // m/s
  double unused = 0;  // pads to 64 bytes
};

/// intact: nothing irreversible has happened. yielded: plastic strain or damage, no strength lost for good. failed: as
/// Particles::failed; Drucker-Prager ice counts as failed from its first yield on.
enum class Condition { intact, yielded, failed };

struct Particles {
  double mass = 0;  // kg, of every particle
  std::vector<Motion> motion;
  std::vector<Sym3> stress;                // Pa, Cauchy, tension positive
  std::vector<Mat3> velocity_gradient;     // 1/s, L_ab = dv_a/dx_b
  std::vector<Vec3> acceleration;          // m/s2
  std::vector<std::uint8_t> held;          // 1: never moves
  std::vector<std::uint32_t> id;           // index in order of creation
  std::vector<std::uint32_t> piece_begin;  // id of the first particle of each piece of ice; empty: all are of one
  // Only with gradient correction.
  std::vector<Sym3> correction;  // B, inverse moment matrix
  // Only with artificial stress or hourglass control.
  std::vector<Vec3> stabilisation;  // m/s2, their share of the acceleration
  // Only with Drucker-Prager and rate-dependent ice.
  std::vector<double> plastic_strain;  // equivalent plastic strain
  std::vector<std::uint8_t> failed;    // 1: has yielded at least once; rate-dependent: has lost one strength altogether
  // Only with Drucker-Prager and pressure from density, and with rate-dependent ice.
  std::vector<double> bulking;  // plastic volume strain that dilation or opened voids have left behind
  // Only with rate-dependent ice.
  std::vector<double> strain_rate;     // 1/s, relaxed
  std::vector<double> tensile_damage;  // 0..1
  std::vector<double> shear_damage;    // 0..1
  // Only with neo-Hookean ice.
  std::vector<Mat3> deformation_gradient;  // F
  // Only with a quiet speed (quiet_ice.hpp): 0 for particles that are awake; for those that sleep how many blocks of
  // the neighbour list they are from the nearest that is awake, at most kFastAsleep. One number per block.
  std::vector<std::uint8_t> sleep;
  // Copies for the pair loops, in the precision of the run.
  PairRecords<double> pair_records;
  PairRecords<float> single_pair_records;

  static constexpr std::uint8_t kFastAsleep = 3;
  /// One block asleep: awake ice acts on it. Two: that one reads it. Fast asleep: nothing looks at it.
  std::uint8_t sleep_depth(std::size_t i) const { return sleep.empty() ? 0 : sleep[i]; }
  bool awake(std::size_t i) const { return sleep_depth(i) == 0; }

  std::size_t size() const { return motion.size(); }
  double density(std::size_t i) const { return mass / motion[i].volume; }
  /// Number of the piece of ice that particle i belongs to.
  std::size_t piece(std::size_t i) const {
    return static_cast<std::size_t>(std::upper_bound(piece_begin.begin(), piece_begin.end(), id[i]) -
                                    piece_begin.begin());
  }

  Condition condition(std::size_t i) const {
    if (!failed.empty() && failed[i]) return Condition::failed;
    const bool damaged = !tensile_damage.empty() && (tensile_damage[i] > 0 || shear_damage[i] > 0);
    const bool strained = !plastic_strain.empty() && plastic_strain[i] > 0;
    return damaged || strained ? Condition::yielded : Condition::intact;
  }

  /// Puts particle order[i] in place i, for every quantity that is in use but the copies.
  void permute(const std::vector<std::uint32_t>& order);
};

}  // namespace nilas::sph
