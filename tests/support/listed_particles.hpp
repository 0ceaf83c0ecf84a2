// Particles with their neighbour list, for tests of one pair loop at a time.
#pragma once

#include "sph/neighbours.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph::test {

/// Sorted, and listed up to a tenth beyond the kernel radius.
struct ListedParticles {
  Particles particles;
  Neighbours neighbours;

  ListedParticles(const std::vector<Vec3>& positions, double spacing, double h, const Period& period = Period::Zero())
      : particles(particles_at(positions, spacing)),
        neighbours(2.2 * h, spacing, period, Vec3::Zero(), Vec3::Ones(), positions.size()) {
    particles.stabilisation.assign(particles.size(), Vec3::Zero());
    neighbours.rebuild(particles);
  }
  void rebuild() { neighbours.rebuild(particles); }
};

}  // namespace nilas::sph::test
