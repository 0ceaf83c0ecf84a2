#include "sph/hourglass_control.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "sph/ice.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

constexpr double dx = 0.02, dt = 1e-6;
const ElasticConstants ice{MaterialSpec{}};
const WendlandC2 kernel(1.3 * dx);

/// Particles moved by hand, step by step as Ice moves them, without any force.
struct Cloud {
  Particles p;
  Neighbours neighbours{2.9 * dx, dx, Period::Zero(), Vec3::Zero(), Vec3::Constant(8 * dx), 512};
  HourglassControl control{1, ice, kernel, Period::Zero(), 512};

  explicit Cloud(double jitter = 0.2) : p(test::particles_at(test::jittered_block({8, 8, 8}, dx, jitter), dx)) {
    p.stabilisation.assign(p.size(), Vec3::Zero());
  }
  void rebuild() {
    neighbours.rebuild(p);
    control.follow(neighbours, p);
  }
  void differentiate() {
    const PairConstants k{kernel.smoothing_length(), kernel.gradient_scale(), 0, 0, 0, Period::Zero(), dx * dx * dx};
    ASSERT_EQ(pair_passes({.corrected = true}).velocity_gradient(p, neighbours, k), 0u);
  }
  void step(double length = dt) {
    for (Motion& m : p.motion) m.position += length / 2 * m.velocity;
    p.stabilisation.assign(p.size(), Vec3::Zero());
    control.apply(p, length);
    for (Motion& m : p.motion) m.position += length / 2 * m.velocity;
  }
  /// Acceleration in order of creation.
  std::vector<Vec3> acceleration() const {
    std::vector<Vec3> a(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) a[p.id[i]] = p.stabilisation[i];
    return a;
  }
  double largest_acceleration() const {
    double largest = 0;
    for (const Vec3& a : p.stabilisation) largest = std::max(largest, a.norm());
    return largest;
  }
};

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

TEST(HourglassControl, FeelsNoLinearMotionHoweverDisordered) {
  for (const bool rigid : {true, false}) {
    test::Random random(7);
    const Mat3 any = 1e3 * random.matrix();
    const Mat3 A = rigid ? (any - any.transpose()).eval() : any;
    Cloud cloud, stirred;
    test::disturb(stirred.p, 1e3 * dx, 0);
    for (Cloud* c : {&cloud, &stirred}) c->rebuild();
    for (int n = 0; n < 20; ++n) {
      for (Motion& m : cloud.p.motion) m.velocity = A * m.position + Vec3(10, 20, 30);
      for (Cloud* c : {&cloud, &stirred}) c->differentiate(), c->step();
    }
    EXPECT_LT(cloud.largest_acceleration(), 1e-11 * stirred.largest_acceleration());
  }
}

TEST(HourglassControl, TurnsWithTheIce) {
  Cloud cloud;
  cloud.rebuild();
  test::disturb(cloud.p, 10, 0);
  cloud.differentiate();
  cloud.step(1e-8);
  for (Motion& m : cloud.p.motion) m.velocity.setZero();
  cloud.differentiate();
  cloud.step(1e-8);
  const std::vector<Vec3> before = cloud.acceleration();
  // A quarter turn about an oblique axis in small steps, exact at every mid-step's end.
  const int steps = 100;  // the damping lags by half a step: a share d dt = 0.2 %
  const Vec3 axis = Vec3(1, 2, 2) / 3, centre = Vec3::Constant(4 * dx);
  const double angle = std::numbers::pi / 2 / steps;
  const Mat3 turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  for (int n = 0; n < steps; ++n) {
    for (Motion& m : cloud.p.motion) {
      const Vec3 r = m.position - centre;
      m.velocity = (turn * r - r) / dt;
    }
    cloud.differentiate();
    cloud.step();
  }
  for (Motion& m : cloud.p.motion) m.velocity.setZero();
  cloud.differentiate();
  cloud.step(1e-9);
  const Mat3 quarter = Eigen::AngleAxisd(std::numbers::pi / 2, axis).toRotationMatrix();
  double largest = 0;
  std::vector<Vec3> expected;
  for (const Vec3& a : before) expected.push_back(quarter * a), largest = std::max(largest, a.norm());
  EXPECT_LT(largest_difference(cloud.acceleration(), expected), 0.01 * largest);  // half a step's turn: 0.2 %
}

TEST(HourglassControl, DoesNotActBetweenPieces) {
  for (const bool two_pieces : {true, false}) {
    Cloud cloud;
    if (two_pieces) cloud.p.piece_begin = {0, 256};
    for (std::size_t i = 0; i < 512; ++i) cloud.p.motion[i].velocity = i < 256 ? Vec3(1, 2, 3) : Vec3(-3, 2, 5);
    cloud.rebuild();
    for (int n = 0; n < 3; ++n) cloud.step();
    EXPECT_EQ(cloud.largest_acceleration() == 0, two_pieces);
  }
}

TEST(HourglassControl, IsGoneForGoodOnceAParticleHasFailed) {
  Cloud from_the_start, later;
  for (Cloud* c : {&from_the_start, &later}) {
    c->p.failed.assign(512, 0);
    test::disturb(c->p, 10, 0);
  }
  const auto fail_some = [](Cloud& c) {
    for (std::size_t i = 0; i < 512; ++i)
      if (c.p.id[i] % 5 == 0) c.p.failed[i] = 1;
  };
  fail_some(from_the_start);
  for (Cloud* c : {&from_the_start, &later}) {
    c->rebuild();
    for (int n = 0; n < 3; ++n) c->step();
  }
  EXPECT_GT(largest_difference(from_the_start.acceleration(), later.acceleration()), 0);
  fail_some(later);
  for (const bool rebuilt : {false, true}) {
    for (Cloud* c : {&from_the_start, &later}) {
      if (rebuilt) c->rebuild();
      c->step();
    }
    const std::vector<Vec3> a = later.acceleration();
    EXPECT_LT(largest_difference(from_the_start.acceleration(), a), 1e-12 * later.largest_acceleration());
    for (std::size_t i = 0; i < 512; i += 5) EXPECT_EQ(a[i], Vec3::Zero());
  }
}

TEST(HourglassControl, DropsAPairThatLeavesAndStartsAnewWhenItComesBack) {
  Cloud pair;
  pair.p = test::particles_at({{0, 0, 0}, {dx, 0, 0}}, dx);
  pair.p.stabilisation.assign(2, Vec3::Zero());
  pair.rebuild();
  const auto move = [&](double speed, double time) {
    pair.p.motion[1].velocity = {speed, 0, 0};
    pair.step(time);
    return pair.p.stabilisation[1][0];
  };
  EXPECT_GT(move(-1, 1e-3), 0);
  EXPECT_EQ(move(100, 2.5e-3 * dx / 0.02), 0);  // 12 spacings out; listed still
  EXPECT_EQ(move(0, 1e-3), 0);
  pair.p.motion[1].position = {dx, 0, 0};
  EXPECT_EQ(move(0, 1e-3), 0);
}

/// Ice that wraps onto itself, with a standing transverse wave of velocity along z.
struct Wave {
  Vec3 k;  // 1/m
  IceSpec spec;
  Wave(const Vec3& cells_per_wave, double xi) {
    for (int a = 0; a < 3; ++a) k[a] = cells_per_wave[a] > 0 ? 2 * std::numbers::pi / (cells_per_wave[a] * dx) : 0;
    PieceSpec piece;
    piece.shape = IceShape::block;
    piece.size = Vec3::Constant(8 * dx);
    spec.pieces = {piece};
    spec.spacing = dx;
    spec.periodic = {true, true, true};
    spec.material.model = Model::elastic;
    spec.numerics.viscosity_alpha = 0;
    spec.numerics.hourglass_control = xi;
  }
  Vec3 velocity(const Vec3& x) const {
    return {0, 0, 1e-6 * std::cos(k.dot(x + Vec3::Constant(3.5 * dx)))};  // 1 at a particle
  }
  /// rho/G times the square of the frequency, g^2 + xi (l - g^2), and the part that is damped, xi (l - g^2), summed
  /// over the lattice.
  std::pair<double, double> stiffness() const {
    double l = 0;
    Vec3 g = Vec3::Zero();
    const double V = dx * dx * dx;
    for (int x = -3; x <= 3; ++x)
      for (int y = -3; y <= 3; ++y)
        for (int z = -3; z <= 3; ++z) {
          const Vec3 r(x * dx, y * dx, z * dx);
          const double Vf = V * kernel.gradient_factor(r.norm());
          l -= 2 * Vf * (1 - std::cos(k.dot(r)));
          g += Vf * std::sin(k.dot(r)) * r;
        }
    const double unseen = spec.numerics.hourglass_control * (l - g.squaredNorm());
    return {g.squaredNorm() + unseen, unseen};
  }
};

TEST(HourglassControl, GivesTransverseWavesTheStiffnessOfTheLaplacianByTheShareXi) {
  for (const Vec3& cells : {Vec3(2, 2, 0), Vec3(4, 0, 0), Vec3(4, 2, 0), Vec3(8, 0, 0)})
    for (const double xi : {1.0, 2.0}) {
      Wave wave(cells, xi);
      // x'' + 2 d x' + w^2 x = 0 from x = 0; z = 0.1 at l h^2 = 7 gives the damping time.
      const auto [all, unseen] = wave.stiffness();
      const double c2 = ice.shear_modulus / ice.density, h = kernel.smoothing_length();
      const double d = 0.5 * c2 * unseen * 2 * 0.1 * h / std::sqrt(7 * xi * c2), w = std::sqrt(c2 * all - d * d);
      const double quarter = std::atan2(w, d) / w;
      const int steps = 400;
      wave.spec.numerics.max_step = quarter / steps;
      Ice sheet(wave.spec, {}, {.velocity = [&](const Vec3& x) { return wave.velocity(x); }});
      std::vector<Surface> none;
      const double energy = sheet.ledger().kinetic;
      for (int n = 0; n < steps; ++n) sheet.step(none, quarter / steps);
      EXPECT_LT(std::sqrt(sheet.ledger().kinetic / energy), 0.01) << cells << " " << xi;  // turns round
      for (int n = 0; n < steps; ++n) sheet.step(none, quarter / steps);
      const double t = 2 * quarter, v = std::exp(-d * t) * (std::cos(w * t) - d / w * std::sin(w * t));
      EXPECT_NEAR(sheet.ledger().kinetic / energy, v * v, 0.01) << cells << " " << xi;
      const IceLedger ledger = sheet.ledger();
      EXPECT_NEAR((ledger.kinetic + ledger.stress_work + ledger.stabilisation) / energy, 1, 1e-4);
    }
}

TEST(HourglassControl, IsStableAtTheStepItAsksFor) {
  for (const double xi : {1.0, 4.0, 20.0}) {
    Wave wave({2, 2, 2}, xi);
    wave.spec.numerics.cfl = 1;
    test::Random random(3);
    Ice sheet(wave.spec, {}, {.velocity = [&](const Vec3&) { return Vec3(1e-6 * random.vector()); }});
    ASSERT_EQ(sheet.stable_step().limiter, Limiter::hourglass_control);
    std::vector<Surface> none;
    const double energy = sheet.ledger().kinetic;
    for (int n = 0; n < 300; ++n) {
      sheet.step(none, sheet.stable_step().dt);
      ASSERT_LT(sheet.ledger().kinetic, energy);
    }
  }
}

TEST(HourglassControl, IsAllThatResistsAZigZag) {
  for (const double xi : {0.0, 1.0}) {
    const Wave wave({2, 2, 2}, xi);
    Ice sheet(wave.spec, {}, {.velocity = [&](const Vec3& x) { return wave.velocity(x); }});
    std::vector<Surface> none;
    const double energy = sheet.ledger().kinetic;
    double least = energy;
    for (int n = 0; n < 20; ++n) {
      sheet.step(none, sheet.stable_step().dt);
      least = std::min(least, sheet.ledger().kinetic);
    }
    EXPECT_EQ(least<0.2 * energy, xi> 0);
  }
}

IceSpec tumbling_block() {
  IceSpec spec;
  PieceSpec piece;
  piece.shape = IceShape::block;
  piece.size = dx * Vec3(9, 8, 7);
  piece.velocity = {30, -20, 10};
  spec.pieces = {piece};
  spec.spacing = dx;
  spec.jitter = 0.1;
  spec.numerics.hourglass_control = 1;
  return spec;
}

Vec3 stir(const Vec3& x) {
  return {3 * std::sin(40 * x[1]) + 100 * x[0], 2 * std::cos(30 * x[2]) - 80 * x[1], std::sin(50 * x[0] + 20 * x[2])};
}

TEST(HourglassControl, KeepsMomentumToRoundOff) {
  for (const bool corrected : {false, true})
    for (const Model model : {Model::elastic, Model::drucker_prager}) {
      IceSpec spec = tumbling_block();
      spec.material.model = model;
      spec.numerics.gradient_correction = corrected;
      Ice block(spec, {}, {.velocity = [](const Vec3& x) { return Vec3(0.05 * stir(x)); }});
      std::vector<Surface> none;
      const Vec3 before = block.ledger().momentum;
      for (int n = 0; n < 100; ++n) block.step(none, block.stable_step().dt);
      EXPECT_LT((block.ledger().momentum - before).norm(), 1e-13 * block.ledger().momentum_scale);
      EXPECT_NE(block.ledger().stabilisation, 0);
    }
}

TEST(HourglassControl, FollowsItsPairsThroughEverySorting) {
  std::vector<std::vector<Vec3>> ends;
  std::vector<std::size_t> rebuilds;
  for (const double skin : {0.01, 0.5}) {
    IceSpec spec = tumbling_block();
    spec.material.model = Model::elastic;
    spec.numerics.skin_ratio = skin;
    Ice block(spec, {}, {.velocity = stir});
    std::vector<Surface> none;
    for (int n = 0; n < 200; ++n) block.step(none, 4e-6);
    ends.emplace_back();
    for (const std::uint32_t i : block.creation_order()) ends.back().push_back(block.particles().motion[i].velocity);
    rebuilds.push_back(block.rebuilds());
  }
  EXPECT_GT(rebuilds[0], 10 * rebuilds[1]);
  EXPECT_LT(largest_difference(ends[0], ends[1]), 1e-9);
}

TEST(HourglassControl, HoldsMemoryOnlyWhenOn) {
  IceSpec spec = tumbling_block();
  const Ice on(spec);
  spec.numerics.hourglass_control = 0;
  const Ice off(spec);
  EXPECT_TRUE(off.particles().stabilisation.empty());
  EXPECT_GT(on.bytes(), off.bytes() + 504 * 26 * sizeof(Vec3));  // at least the nearest neighbours of most
}

}  // namespace
}  // namespace nilas::sph
