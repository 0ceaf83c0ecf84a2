#include "sph/shifting.hpp"

#include <gtest/gtest.h>

#include "sph/ice.hpp"
#include "tests/support/listed_particles.hpp"
#include "tests/support/pair_sums.hpp"

namespace nilas::sph {
namespace {

using test::jittered_block;
using test::ListedParticles;

constexpr double dx = 0.02, h = 1.3 * dx, solid = dx * dx * dx;
const Period none(0, 0, 0), cube = Period::Constant(8 * dx);

void apply(ListedParticles& set, double share, const Period& period = none) {
  Shifting(share, dx, solid, WendlandC2(h), period).apply(set.particles, set.neighbours);
}

double variance_of_concentration(const ListedParticles& set, const Period& period) {
  const test::PairSums sums(set.particles, h, period);
  double sum = 0, squares = 0;
  const double n = static_cast<double>(set.particles.size());
  for (std::size_t i = 0; i < set.particles.size(); ++i) {
    const double c = sums.concentration(i);
    sum += c, squares += c * c;
  }
  return squares / n - sum * sum / (n * n);
}

/// Positions in order of creation.
std::vector<Vec3> positions(const Particles& p) {
  std::vector<Vec3> x(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) x[p.id[i]] = p.motion[i].position;
  return x;
}

TEST(Shifting, FollowsTheGradientOfTheConcentrationUpToATenthOfASpacing) {
  ListedParticles set(jittered_block({8, 8, 8}, dx, 0.4), dx, h, cube);
  const Particles before = set.particles;
  const test::PairSums sums(before, h, cube);
  apply(set, 0.6, cube);
  int limited = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    Vec3 expected = -0.3 * h * h * sums.concentration_gradient(i);
    if (expected.norm() > 0.1 * dx) expected *= 0.1 * dx / expected.norm(), ++limited;
    EXPECT_LT((set.particles.motion[i].position - before.motion[i].position - expected).norm(), 1e-13 * dx);
  }
  EXPECT_GT(limited, 10);
  EXPECT_LT(limited, 500);
}

TEST(Shifting, EvensOutADisorderedLattice) {
  for (const double share : {0.2, 1.0}) {
    ListedParticles set(jittered_block({8, 8, 8}, dx, 0.25), dx, h, cube);
    const double before = variance_of_concentration(set, cube);
    double last = before;
    for (int n = 0; n < 5; ++n) {
      for (int k = 0; k < 4; ++k) apply(set, share, cube), set.rebuild();
      const double now = variance_of_concentration(set, cube);
      EXPECT_LT(now, last);
      last = now;
    }
    EXPECT_LT(last, 0.1 * before);
  }
}

TEST(Shifting, LeavesAPerfectLatticeAlone) {
  ListedParticles set(jittered_block({8, 8, 8}, dx, 0), dx, h, cube);
  const std::vector<Vec3> before = positions(set.particles);
  for (int n = 0; n < 100; ++n) apply(set, 1, cube);
  const std::vector<Vec3> after = positions(set.particles);
  for (std::size_t k = 0; k < before.size(); ++k) EXPECT_LT((after[k] - before[k]).norm(), 1e-10 * dx);
}

// However disordered, the particles within a kernel radius of a face stay, and with them the face.
TEST(Shifting, MovesNoParticleNearAFreeSurface) {
  for (const double jitter : {0.0, 0.2, 0.3}) {
    ListedParticles set(jittered_block({11, 11, 11}, dx, jitter), dx, h);
    const std::vector<Vec3> before = positions(set.particles);
    for (int n = 0; n < 20; ++n) apply(set, 1), set.rebuild();
    const std::vector<Vec3> after = positions(set.particles);
    int moved = 0;
    for (std::size_t k = 0; k < before.size(); ++k) {
      const double depth = std::min(before[k].minCoeff(), 11 * dx - before[k].maxCoeff());
      if (after[k] != before[k]) ++moved;
      if (depth < 2 * dx) {
        EXPECT_EQ(after[k], before[k]) << depth / dx;
      }
    }
    EXPECT_GE(moved, jitter > 0 ? 27 : 0);
  }
}

IceSpec stirred_block() {
  IceSpec spec;
  PieceSpec piece;
  piece.shape = IceShape::block;
  piece.size = dx * Vec3(12, 11, 10);
  spec.pieces = {piece};
  spec.spacing = dx;
  spec.jitter = 0.2;
  spec.material.model = Model::elastic;
  spec.numerics.shifting = 0.5;
  return spec;
}

Vec3 stir(const Vec3& x) { return {3 * std::sin(40 * x[1]), 2 * std::cos(30 * x[2]), std::sin(50 * x[0])}; }

/// 60 steps.
std::vector<Vec3> run(Ice& ice) {
  std::vector<Surface> no_bodies;
  for (int n = 0; n < 60; ++n) ice.step(no_bodies, ice.stable_step().dt);
  return positions(ice.particles());
}

TEST(Shifting, NeitherMovesHeldParticlesNorAddsMomentum) {
  IceSpec spec = stirred_block();
  spec.pieces[0].fixed.faces[0] = true;
  Ice ice(spec, {}, {.velocity = stir});
  const std::vector<Vec3> before = positions(ice.particles());
  const IceLedger start = ice.ledger();
  const std::vector<Vec3> after = run(ice);
  const auto order = ice.creation_order();
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (!ice.particles().held[order[k]]) continue;
    EXPECT_EQ(after[k], before[k]);
  }
  const IceLedger end = ice.ledger();
  EXPECT_LT((end.momentum - start.momentum - end.held_impulse).norm(), 1e-13 * start.momentum_scale);
}

// The list has to allow for the shifts: pairs that it misses show in the velocities first.
TEST(Shifting, SkinOfTheNeighbourListChangesNothingBeyondRoundOff) {
  const auto result = [](double skin) {
    IceSpec spec = stirred_block();
    spec.jitter = 0.3;
    spec.numerics.shifting = 1;
    spec.numerics.skin_ratio = skin;
    Ice ice(spec, {}, {.velocity = stir});
    run(ice);
    std::vector<Vec3> velocities;
    for (const std::uint32_t i : ice.creation_order()) velocities.push_back(ice.particles().motion[i].velocity);
    return velocities;
  };
  const std::vector<Vec3> thin = result(0.02), thick = result(0.5);
  for (std::size_t k = 0; k < thin.size(); ++k) EXPECT_LT((thin[k] - thick[k]).norm(), 1e-9);  // m/s
}

}  // namespace
}  // namespace nilas::sph
