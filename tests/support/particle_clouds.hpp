// Particles for tests of the ice solver: jittered blocks and random clouds, with every random number from a fixed seed.
#pragma once

#include <omp.h>

#include <array>
#include <random>

#include "sph/particles.hpp"

namespace nilas::sph::test {

/// Numbers in [-1, 1).
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double operator()() { return std::ldexp(static_cast<double>(generator_() >> 11), -52) - 1; }
  Vec3 vector() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }
  Mat3 matrix() {
    Mat3 m;
    for (int k = 0; k < 9; ++k) m(k / 3, k % 3) = (*this)();
    return m;
  }
  Sym3 tensor() { return symmetric_part(matrix()); }

 private:
  std::mt19937_64 generator_;
};

/// Stress-free particles at rest at these positions, of density 900 kg/m3, with the fields for gradient correction.
inline Particles particles_at(const std::vector<Vec3>& positions, double spacing) {
  Particles p;
  const double volume = spacing * spacing * spacing;
  p.mass = 900 * volume;
  for (const Vec3& x : positions) p.motion.push_back({x, volume, Vec3::Zero()});
  p.stress.assign(p.size(), {});
  p.velocity_gradient.assign(p.size(), Mat3::Zero());
  p.acceleration.assign(p.size(), Vec3::Zero());
  p.held.assign(p.size(), 0);
  p.correction.assign(p.size(), {1, 1, 1, 0, 0, 0});
  for (std::uint32_t i = 0; i < p.size(); ++i) p.id.push_back(i);
  return p;
}

/// Cubic lattice of n particles along each axis, from half a spacing on; each particle moved by up to jitter * spacing
/// along each axis.
inline std::vector<Vec3> jittered_block(const std::array<int, 3>& n, double spacing, double jitter,
                                        std::uint64_t seed = 1) {
  Random random(seed);
  std::vector<Vec3> positions;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k)
        positions.push_back(spacing * (Vec3(i + 0.5, j + 0.5, k + 0.5) + jitter * random.vector()));
  return positions;
}

/// Random velocities [m/s], stresses [Pa] and volumes (10 %).
inline void disturb(Particles& p, double speed, double stress, std::uint64_t seed = 2) {
  Random random(seed);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.motion[i].velocity = speed * random.vector();
    p.motion[i].volume *= 1 + 0.1 * random();
    p.stress[i] = stress * random.tensor();
  }
}

/// Sets the number of OpenMP threads while it lives.
class Threads {
 public:
  explicit Threads(int n) : before_(omp_get_max_threads()) { omp_set_num_threads(n); }
  ~Threads() { omp_set_num_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  int before_;
};

}  // namespace nilas::sph::test
