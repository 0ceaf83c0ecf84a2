#include "sph/artificial_stress.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "sph/ice.hpp"
#include "sph/stress_update.hpp"
#include "tests/support/listed_particles.hpp"
#include "tests/support/pair_sums.hpp"

namespace nilas::sph {
namespace {

using test::jittered_block;
using test::ListedParticles;
using test::Random;

constexpr double dx = 0.02, h = 1.3 * dx;

NumericsSpec numerics(double epsilon = 0.3, double exponent = 4) {
  NumericsSpec n;
  n.artificial_stress = epsilon;
  n.artificial_stress_exponent = exponent;
  return n;
}

/// Accelerations of these particles from artificial stress.
std::vector<Vec3> apply(ListedParticles& set, const NumericsSpec& spec = numerics(), const Period& period = {0, 0, 0}) {
  std::fill(set.particles.stabilisation.begin(), set.particles.stabilisation.end(), Vec3::Zero());
  ArtificialStress(spec, dx, period).apply(set.particles, set.neighbours);
  return set.particles.stabilisation;
}

/// Two particles this far apart along x under this stress; the acceleration of the first, at the smaller x.
Vec3 pair(double distance, const Sym3& stress, const NumericsSpec& spec = numerics()) {
  ListedParticles set({{0.5, 0.5, 0.5}, {0.5 + distance, 0.5, 0.5}}, dx, h);
  set.particles.stress = {stress, stress};
  return apply(set, spec)[set.particles.id[0]];
}

Sym3 turned(const Sym3& s, const Mat3& Q) { return symmetric_part(Q * to_matrix(s) * Q.transpose()); }

TEST(ArtificialStress, IsThePairSumOfItsEquation) {
  for (const Period& period : {Period(0, 0, 0), Period(7 * dx, 0, 8 * dx)}) {
    ListedParticles set(jittered_block({7, 6, 8}, dx, 0.2), dx, h, period);
    test::disturb(set.particles, 0, 1e6);
    const std::vector<Vec3> a = apply(set, numerics(0.2, 5), period);
    const test::PairSums sums(set.particles, h, period);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vec3 expected = sums.artificial_stress(i, 0.2, 5, dx);
      EXPECT_LT((a[i] - expected).norm(), 1e-11 * (1e4 + expected.norm()));
    }
  }
}

TEST(ArtificialStress, VanishesInCompression) {
  ListedParticles set(jittered_block({6, 6, 6}, dx, 0.2), dx, h);
  test::disturb(set.particles, 0, 1e6);
  for (Sym3& s : set.particles.stress) s = add_isotropic(s, -4e6);  // no principal stress of a disturbance exceeds 3e6
  for (const Vec3& a : apply(set)) EXPECT_EQ(a, Vec3::Zero());
}

TEST(ArtificialStress, PushesApartAlongTheStretchedAxisAlone) {
  EXPECT_LT(pair(dx, {1e6, 0, 0, 0, 0, 0})[0], 0);
  EXPECT_LT(pair(dx, {1e6, -5e6, -5e6, 0, 0, 0})[0], 0);
  EXPECT_EQ(pair(dx, {0, 1e6, 1e6, 0, 0, 0}), Vec3::Zero());
  EXPECT_EQ(pair(dx, {-1e6, 1e6, 1e6, 0, 0, 0}), Vec3::Zero());
}

// f = 1 at one spacing, so that the pair force is epsilon times that of the stress itself, the other way.
TEST(ArtificialStress, TakesTheShareEpsilonOfThePullOfANearestNeighbour) {
  ListedParticles set({{0.5, 0.5, 0.5}, {0.5 + dx, 0.5, 0.5}}, dx, h);
  set.particles.stress.assign(2, {1e6, 2e5, 0, 0, 0, 0});
  const Vec3 pull = test::PairSums(set.particles, h).acceleration(0, {}, {});
  EXPECT_LT((apply(set, numerics(0.15, 8))[0] + 0.15 * pull).norm(), 1e-12 * pull.norm());
}

TEST(ArtificialStress, TurnsWithTheFrame) {
  const Mat3 Q = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const std::vector<Vec3> positions = jittered_block({5, 4, 6}, dx, 0.2);
  std::vector<Vec3> elsewhere;
  for (const Vec3& x : positions) elsewhere.push_back(Vec3(0.5, 0.5, 0.5) + Q * x);
  ListedParticles here(positions, dx, h), there(elsewhere, dx, h);
  Random random(4);
  std::vector<Sym3> stress(positions.size());
  for (Sym3& s : stress) s = 1e6 * random.tensor();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    here.particles.stress[i] = stress[here.particles.id[i]];
    there.particles.stress[i] = turned(stress[there.particles.id[i]], Q);
  }
  const std::vector<Vec3> a = apply(here), b = apply(there);
  std::vector<Vec3> a_by_id(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) a_by_id[here.particles.id[i]] = a[i];
  for (std::size_t i = 0; i < b.size(); ++i)
    EXPECT_LT((b[i] - Q * a_by_id[there.particles.id[i]]).norm(), 1e-10 * (1e4 + b[i].norm()));
}

TEST(ArtificialStress, KeepsMomentumToRoundOff) {
  const Period period(7 * dx, 0, 8 * dx);
  ListedParticles set(jittered_block({7, 6, 8}, dx, 0.3), dx, h, period);
  test::disturb(set.particles, 0, 1e6);
  Vec3 sum = Vec3::Zero();
  double scale = 0;
  for (const Vec3& a : apply(set, numerics(), period)) sum += a, scale += a.norm();
  ASSERT_GT(scale, 0);
  EXPECT_LT(sum.norm(), 1e-14 * scale);
}

TEST(ArtificialStress, DependsContinuouslyOnTheStressWherePrincipalStressesCoincide) {
  Random random(5);
  for (const Sym3& diagonal : {Sym3{1e6, 1e6, 1e6, 0, 0, 0}, Sym3{1e6, 1e6, 0, 0, 0, 0}, Sym3{1e6, 1e6, -1e6, 0, 0, 0},
                               Sym3{1e6, 0, 0, 0, 0, 0}, Sym3{1e-300, 1e-300, 1e-300, 0, 0, 0}, Sym3{}}) {
    const Mat3 Q = Eigen::AngleAxisd(random(), random.vector().normalized()).toRotationMatrix();
    const Sym3 stress = turned(diagonal, Q);
    const Vec3 a = pair(dx, stress), nearby = pair(dx, stress + 1e-3 * random.tensor());
    EXPECT_TRUE(a.allFinite());
    EXPECT_LT((a - nearby).norm(), 1e-8 * pair(dx, {1e6, 0, 0, 0, 0, 0}).norm());
    const double tension = std::max(0.0, diagonal.xx);
    EXPECT_LE(a.norm(), (1 + 1e-12) * tension / 1e6 * pair(dx, {1e6, 0, 0, 0, 0, 0}).norm());
  }
}

TEST(ArtificialStress, ClosePairsArePushedNoHarderThanAtHalfASpacing) {
  for (const double exponent : {4.0, 8.0}) {
    const NumericsSpec spec = numerics(0.3, exponent);
    const Sym3 tension{1e6, 1e6, 1e6, 0, 0, 0};
    const double largest = pair(0.5 * dx, tension, spec).norm();
    EXPECT_GT(largest, pair(0.6 * dx, tension, spec).norm());
    for (const double r : {0.49, 0.3, 0.1, 1e-3, 1e-12}) {
      const Vec3 a = pair(r * dx, tension, spec);
      EXPECT_LT(a.norm(), largest);
      EXPECT_LE(a[0], 0);
    }
    EXPECT_EQ(pair(0, tension, spec), Vec3::Zero());
  }
}

/// Displacement of a lattice site [spacings].
using Disturbance = std::function<Vec3(const Vec3& site)>;

/// Elastic ice that wraps along all axes, 6 particles each, under isotropic tension of 2 % of K: the smallest distance
/// [spacings] after this many steps of the solver's own scheme, without viscosity.
double smallest_distance_under_tension(double epsilon, const Disturbance& disturbance, int steps) {
  const ElasticConstants elastic{MaterialSpec{}};
  MaterialSpec material;
  material.model = Model::elastic;
  const Material law = make_material(material, dx, 1.3 * dx);
  const Period period = Period::Constant(6 * dx);
  std::vector<Vec3> positions = jittered_block({6, 6, 6}, dx, 0);
  for (Vec3& x : positions) x += dx * disturbance(x / dx);
  ListedParticles set(positions, dx, h, period);
  Particles& p = set.particles;
  const double tension = 0.02 * elastic.bulk_modulus;
  p.stress.assign(p.size(), {tension, tension, tension, 0, 0, 0});
  const PairPasses passes = pair_passes({false, false, true});
  const PairConstants k{h, WendlandC2(h).gradient_scale(), elastic.bulk_sound_speed(), 0, 0, period, dx * dx * dx};
  ArtificialStress term(numerics(epsilon), dx, period);
  const double dt = 0.6 * h / elastic.bulk_sound_speed();
  const auto move = [&] {
    for (Motion& m : p.motion) m.position += 0.5 * dt * m.velocity;
  };
  for (int n = 0; n < steps; ++n) {
    set.rebuild();
    move();
    update_stress(p, law, elastic.density, 0.5 * dt);
    std::fill(p.stabilisation.begin(), p.stabilisation.end(), Vec3::Zero());
    term.apply(p, set.neighbours);
    p.acceleration = p.stabilisation;
    passes.acceleration(p, set.neighbours, k, dt);
    for (std::size_t i = 0; i < p.size(); ++i) p.motion[i].velocity += dt * p.acceleration[i];
    move();
    passes.velocity_gradient(p, set.neighbours, k);
    update_stress(p, law, elastic.density, 0.5 * dt);
  }
  double smallest = 1e300;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      smallest = std::min(smallest, shortest_image(p.motion[i].position - p.motion[j].position, period).norm());
  return smallest / dx;
}

/// Growth rate [per step] of planes normal to x that pair up, displaced by +a and -a in turn, on a lattice under this
/// tension: no velocity gradient sees them. From the pair force P = T (1 - epsilon f^n) dW/dr,
///   s^2 = (2 V / rho) SUM (1 - cos(pi x)) d(P x/r)/dx.
double pairing_rate(double epsilon) {
  const ElasticConstants elastic{MaterialSpec{}};
  const double step = 1e-6 * dx;
  const auto force = [&](const Vec3& x) {
    const double r = x.norm(), f = test::kernel_value(r, h) / test::kernel_value(dx, h);
    return (1 - epsilon * std::pow(f, 4)) * test::kernel_slope(r, h) * x[0] / r;
  };
  double sum = 0;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k)
        if (i % 2) {
          const Vec3 x = dx * Vec3(i, j, k), nudge(step, 0, 0);
          sum += 2 * (force(x + nudge) - force(x - nudge)) / (2 * step);
        }
  const double dt = 0.6 * h / elastic.bulk_sound_speed();
  return dt * std::sqrt(2 * dx * dx * dx / elastic.density * 0.02 * elastic.bulk_modulus * sum);
}

// The tensile instability (Swegle, Hicks and Attaway 1995), and what the term makes of it.
TEST(ArtificialStress, SlowsThePairingOfPlanesOfStretchedIceAsLinearTheorySays) {
  const double a = 1e-5;
  const Disturbance planes = [&](const Vec3& site) { return Vec3(std::lround(site[0] - 0.5) % 2 ? a : -a, 0, 0); };
  for (const double epsilon : {0.0, 0.3}) {
    const int steps = 25;  // from rest, a cosh(s n)
    const double grown = 0.5 * (1 - smallest_distance_under_tension(epsilon, planes, steps));
    EXPECT_NEAR(std::acosh(grown / a) / steps / pairing_rate(epsilon), 1, 0.01);
  }
  EXPECT_LT(pairing_rate(0.3), 0.4 * pairing_rate(0));
}

TEST(ArtificialStress, SlowsTheClumpingOfStretchedIceThatIsDisturbedAtRandom) {
  const auto departure = [](double epsilon) {
    Random random(1);
    const Disturbance at_random = [&](const Vec3&) -> Vec3 { return 1e-3 * random.vector(); };
    return 1 - smallest_distance_under_tension(epsilon, at_random, 100);
  };
  EXPECT_LT(departure(0.3), 0.25 * departure(0));
}

IceSpec block(const Vec3& cells) {
  IceSpec spec;
  PieceSpec piece;
  piece.shape = IceShape::block;
  piece.size = dx * cells;
  spec.pieces = {piece};
  spec.spacing = dx;
  spec.material.model = Model::elastic;
  spec.numerics.artificial_stress = 0.3;
  return spec;
}

TEST(ArtificialStress, LedgerOfIceClosesWithItsWork) {
  IceSpec spec = block({12, 8, 6});
  spec.numerics.viscosity_alpha = 0;
  spec.numerics.cfl = 0.3;
  spec.pieces[0].fixed.faces[0] = true;
  Ice ice(spec, {}, {.velocity = [](const Vec3& x) { return Vec3(100 * x[0], 2 * x[2], 30 * x[0]); }});
  const IceLedger before = ice.ledger();
  std::vector<Surface> none;
  double largest = 0, worst = 0;
  for (int n = 0; n < 200; ++n) {
    ice.step(none, ice.stable_step().dt);
    const IceLedger l = ice.ledger();
    largest = std::max(largest, std::abs(l.stabilisation));
    worst = std::max(worst, std::abs((l.kinetic + l.stress_work + l.stabilisation) / before.kinetic - 1));
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_GT(largest, 0.02 * before.kinetic);  // it would be seen
  const IceLedger after = ice.ledger();
  EXPECT_LT((after.momentum - before.momentum - after.held_impulse).norm(), 1e-13 * before.momentum_scale);
}

}  // namespace
}  // namespace nilas::sph
