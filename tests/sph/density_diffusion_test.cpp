#include "sph/density_diffusion.hpp"

#include <gtest/gtest.h>

#include "sph/elastic_constants.hpp"
#include "sph/time_step.hpp"
#include "tests/support/listed_particles.hpp"
#include "tests/support/pair_sums.hpp"

namespace nilas::sph {
namespace {

using test::jittered_block;
using test::ListedParticles;
using test::Random;

constexpr double dx = 0.02, h = 1.3 * dx, solid = dx * dx * dx, diffusivity = 0.1 * h * 3196.5;
const Period none(0, 0, 0), cube = Period::Constant(6 * dx);

/// Departures of the volumes from that of solid ice, relative, largest magnitude `size`.
void disturb_volumes(Particles& p, double size) {
  Random random(7);
  for (Motion& m : p.motion) m.volume = solid * (1 + size * random());
}

void apply(ListedParticles& set, double dt, const Period& period = none) {
  DensityDiffusion(diffusivity, solid, WendlandC2(h), period).apply(set.particles, set.neighbours, dt);
}

TEST(DensityDiffusion, HasTheRateOfThePrintedPairSum) {
  for (const Period& period : {none, Period(0, 6 * dx, 8 * dx)}) {
    ListedParticles set(jittered_block({7, 6, 8}, dx, 0.2), dx, h, period);
    disturb_volumes(set.particles, 0.1);
    const Particles before = set.particles;
    const test::PairSums sums(before, h, period);
    const double dt = 1e-12;  // the exponential is a straight line to 1e-8
    apply(set, dt, period);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double expected = sums.density_rate(i, diffusivity) / before.density(i);
      EXPECT_NEAR(std::log(before.motion[i].volume / set.particles.motion[i].volume) / dt, expected, 1e-3)
          << expected;  // round-off of the volumes over dt; rates are 1e3 and more
    }
  }
}

// On a lattice the checkerboard is an eigenvector: its rate is a sum over the sites that can be written down.
TEST(DensityDiffusion, DampsACheckerboardAtTheRateOfItsLatticeSum) {
  ListedParticles set(jittered_block({6, 6, 6}, dx, 0), dx, h, cube);
  const auto sign = [](const Vec3& x) { return std::lround((x / dx).sum() - 1.5) % 2 ? -1.0 : 1.0; };
  const double amplitude = 1e-5;
  for (Motion& m : set.particles.motion) m.volume = solid * (1 + amplitude * sign(m.position));
  double sum = 0;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k) {
        const double r = dx * std::sqrt(i * i + j * j + k * k);
        if (r > 0 && (i + j + k) % 2) sum -= 2 * solid * test::kernel_slope(r, h) * r / (r * r + 0.01 * h * h);
      }
  const double rate = 2 * diffusivity * sum, dt = 0.01 / rate;
  for (int n = 0; n < 100; ++n) apply(set, dt, cube);
  for (const Motion& m : set.particles.motion)
    EXPECT_NEAR((m.volume / solid - 1) * sign(m.position) / (amplitude * std::pow(0.99, 100)), 1, 1e-3);
}

TEST(DensityDiffusion, LeavesAConstantDensityAtSurfacesToo) {
  ListedParticles set(jittered_block({6, 5, 4}, dx, 0.3), dx, h);
  for (Motion& m : set.particles.motion) m.volume = 0.98 * solid;
  for (int n = 0; n < 10; ++n) apply(set, 1e-6);
  for (const Motion& m : set.particles.motion) EXPECT_EQ(m.volume, 0.98 * solid);
}

TEST(DensityDiffusion, KeepsTheGeometricMeanOfTheDensities) {
  ListedParticles set(jittered_block({6, 5, 7}, dx, 0.3), dx, h);
  disturb_volumes(set.particles, 0.2);
  const auto log_sum = [&] {
    double sum = 0;
    for (const Motion& m : set.particles.motion) sum += std::log(m.volume / solid);
    return sum;
  };
  const auto spread = [&] {
    double largest = 0;
    for (const Motion& m : set.particles.motion) largest = std::max(largest, std::abs(m.volume / solid - 1));
    return largest;
  };
  const double before = log_sum(), wide = spread();
  for (int n = 0; n < 100; ++n) apply(set, 1e-6);
  EXPECT_LT(spread(), 0.8 * wide);
  EXPECT_NEAR(log_sum(), before, 1e-11);  // 21 000 changes of order 1e-1 at most
}

TEST(DensityDiffusion, TakesNothingFromScatteredDebrisAndGivesItNothing) {
  ListedParticles set(jittered_block({4, 4, 4}, dx, 0), dx, h);
  for (Motion& m : set.particles.motion) m.volume = m.position[0] < 2 * dx ? solid : 20 * solid;
  const std::vector<Motion> before = set.particles.motion;
  apply(set, 1e-6);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(set.particles.motion[i].volume, before[i].volume);
}

// No disturbance of a lattice, and of a disordered one, grows at the limit (cfl = 1).
TEST(DensityDiffusion, IsStableAtItsStepLimit) {
  const ElasticConstants elastic{MaterialSpec{}};
  NumericsSpec numerics;
  numerics.viscosity_alpha = 0;
  numerics.cfl = 1;
  numerics.density_diffusion = 2;
  const ContactConstants contact({}, elastic, dx);
  const StepLimit limit = stable_step(numerics, elastic, contact, 900 * solid, h, 0, 0, false);
  ASSERT_EQ(limit.limiter, Limiter::density_diffusion);
  for (const double jitter : {0.0, 0.2}) {
    ListedParticles set(jittered_block({6, 6, 6}, dx, jitter), dx, h, cube);
    disturb_volumes(set.particles, 1e-6);
    DensityDiffusion term(2 * h * elastic.bulk_sound_speed(), solid, WendlandC2(h), cube);
    const auto norm = [&] {
      double sum = 0;
      for (const Motion& m : set.particles.motion) sum += std::pow(m.volume / solid - 1, 2);
      return std::sqrt(sum);
    };
    double last = norm();
    for (int n = 0; n < 200; ++n) {
      term.apply(set.particles, set.neighbours, limit.dt);
      ASSERT_LE(norm(), last * (1 + 1e-5));
      last = norm();
    }
  }
}

}  // namespace
}  // namespace nilas::sph
