#include "sph/density_reinitialisation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sph/ice.hpp"
#include "tests/support/listed_particles.hpp"
#include "tests/support/pair_sums.hpp"

namespace nilas::sph {
namespace {

using test::jittered_block;
using test::ListedParticles;
using test::Random;

constexpr double dx = 0.02, h = 1.3 * dx, solid = dx * dx * dx;
const Period none(0, 0, 0);

void disturb_volumes(Particles& p, double size) {
  Random random(7);
  for (Motion& m : p.motion) m.volume = solid * (1 + size * random());
}

void apply(ListedParticles& set, const Period& period = none) {
  reinitialise_density(set.particles, set.neighbours, solid, WendlandC2(h), period);
}

/// Smallest and largest volume.
std::pair<double, double> range(const Particles& p) {
  const auto less = [](const Motion& a, const Motion& b) { return a.volume < b.volume; };
  const auto [low, high] = std::minmax_element(p.motion.begin(), p.motion.end(), less);
  return {low->volume, high->volume};
}

TEST(DensityReinitialisation, IsShepardsSum) {
  for (const Period& period : {none, Period(0, 6 * dx, 8 * dx)}) {
    ListedParticles set(jittered_block({7, 6, 8}, dx, 0.2), dx, h, period);
    disturb_volumes(set.particles, 0.2);
    const Particles before = set.particles;
    const test::PairSums sums(before, h, period);
    apply(set, period);
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_NEAR(set.particles.density(i) / sums.shepard_density(i), 1, 1e-13);
  }
}

TEST(DensityReinitialisation, LeavesAConstantDensityAtSurfacesToo) {
  ListedParticles set(jittered_block({6, 5, 4}, dx, 0.3), dx, h);
  for (Motion& m : set.particles.motion) m.volume = 1.01 * solid;
  apply(set);
  for (const Motion& m : set.particles.motion) EXPECT_EQ(m.volume, 1.01 * solid);
}

TEST(DensityReinitialisation, RecoversAConstantWithinWhatWasThereBefore) {
  ListedParticles set(jittered_block({5, 5, 5}, dx, 0.2), dx, h);
  disturb_volumes(set.particles, 0.1);
  auto [low, high] = range(set.particles);
  const double wide = high - low;
  for (int n = 0; n < 100; ++n) {
    apply(set);
    const auto [lower, upper] = range(set.particles);
    ASSERT_GE(lower, low);
    ASSERT_LE(upper, high);
    low = lower, high = upper;
  }
  EXPECT_LT(high - low, 1e-3 * wide);
}

TEST(DensityReinitialisation, LeavesScatteredDebrisOut) {
  ListedParticles set(jittered_block({4, 4, 4}, dx, 0), dx, h);
  for (Motion& m : set.particles.motion) m.volume = m.position[0] < 2 * dx ? solid : 20 * solid;
  const std::vector<Motion> before = set.particles.motion;
  apply(set);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(set.particles.motion[i].volume, before[i].volume);
}

/// ln V and tr(L) in order of creation.
std::vector<std::pair<double, double>> volumes(const Ice& ice) {
  std::vector<std::pair<double, double>> list;
  for (const std::uint32_t i : ice.creation_order())
    list.emplace_back(std::log(ice.particles().motion[i].volume), ice.particles().velocity_gradient[i].trace());
  return list;
}

// In every other step ln V follows from continuity alone, exp(tr(L) dt/2) with L before and after the step.
TEST(DensityReinitialisation, HappensEveryNthStepAndNoOther) {
  for (const int every : {0, 1, 3}) {
    IceSpec spec;
    PieceSpec piece;
    piece.shape = IceShape::block;
    piece.size = dx * Vec3(7, 6, 5);
    spec.pieces = {piece};
    spec.spacing = dx;
    spec.material.model = Model::elastic;
    spec.numerics.density_reinitialisation = every;
    Ice ice(spec, {}, {.velocity = [](const Vec3& x) { return Vec3(3 * std::sin(200 * x[1]) + 100 * x[0], 0, 0); }});
    std::vector<Surface> no_bodies;
    for (int n = 1; n <= 10; ++n) {
      const auto before = volumes(ice);
      const double dt = ice.stable_step().dt;
      ice.step(no_bodies, dt);
      const auto after = volumes(ice);
      double departure = 0;
      for (std::size_t k = 0; k < before.size(); ++k) {
        const double continuity = 0.5 * dt * (before[k].second + after[k].second);
        departure = std::max(departure, std::abs(after[k].first - before[k].first - continuity));
      }
      if (every > 0 && n % every == 0) {
        EXPECT_GT(departure, 1e-6) << every << " " << n;
      } else {
        EXPECT_LT(departure, 1e-13) << every << " " << n;
      }
    }
  }
}

}  // namespace
}  // namespace nilas::sph
