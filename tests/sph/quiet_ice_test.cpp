#include "sph/quiet_ice.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "sph/ice.hpp"
#include "sph/terms.hpp"
#include "tests/support/particle_clouds.hpp"
#include "tests/support/surfaces.hpp"

namespace nilas::sph {
namespace {

constexpr double dx = 0.02;
// So slow that whatever moves at all is faster, but for numbers that no other number notices.
constexpr double kVanishing = 1e-100;

/// A bar along x of ten blocks of the neighbour list.
IceSpec bar() {
  IceSpec spec;
  PieceSpec piece;
  piece.shape = IceShape::block;
  piece.size = dx * Vec3(160, 8, 8);
  spec.pieces = {piece};
  spec.spacing = dx;
  spec.material.model = Model::elastic;
  return spec;
}

IceSpec with_quiet_speed(IceSpec spec, double quiet_speed) {
  spec.numerics.quiet_speed = quiet_speed;
  return spec;
}

/// One end of the bar moves at 1 m/s at the start.
const InitialState pushed{.velocity = [](const Vec3& x) { return Vec3(x[0] < -1.4 ? 1 : 0, 0, 0); }};

void run(Ice& ice, int steps) {
  std::vector<Surface> none;
  for (int n = 0; n < steps; ++n) ice.step(none, ice.stable_step().dt);
}

double largest_difference(const Ice& a, const Ice& b, Vec3 Motion::*quantity) {
  const auto order_a = a.creation_order(), order_b = b.creation_order();
  double largest = 0;
  for (std::size_t k = 0; k < order_a.size(); ++k)
    largest =
        std::max(largest, (a.particles().motion[order_a[k]].*quantity - b.particles().motion[order_b[k]].*quantity)
                              .cwiseAbs()
                              .maxCoeff());
  return largest;
}

using Change = std::function<void(IceSpec&)>;

TEST(QuietIce, OfAVanishingSpeedChangesNothing) {
  const test::Threads one(1);
  for (const Change& change : std::initializer_list<Change>{
           [](IceSpec&) {}, [](IceSpec& s) { s.numerics.viscosity_alpha = 0, s.jitter = 0.1; },
           [](IceSpec& s) { s.numerics.precision = Precision::single; },
           [](IceSpec& s) {
             s.periodic = {true, true, false};
           },
           [](IceSpec& s) {
             s.material.model = Model::drucker_prager, s.pieces[0].fixed.faces = {true, true};
           },
           [](IceSpec& s) { s.material.model = Model::neo_hookean, s.material.kelvin_voigt = 0.1; },
           [](IceSpec& s) {
             s.numerics.gradient_correction = true, s.numerics.hourglass_control = 1;
             s.numerics.artificial_stress = 0.3;
           }}) {
    IceSpec spec = bar();
    change(spec);
    Ice plain(spec, {}, pushed), quiet(with_quiet_speed(spec, kVanishing), {}, pushed);
    run(plain, 12), run(quiet, 12);
    const double asleep = quiet.asleep_fraction();
    EXPECT_GT(asleep, 0.1);
    EXPECT_LE(largest_difference(plain, quiet, &Motion::velocity), kVanishing);
    EXPECT_EQ(largest_difference(plain, quiet, &Motion::position), 0);
    run(plain, 30), run(quiet, 30);
    EXPECT_LT(quiet.asleep_fraction(), asleep);
    EXPECT_LE(largest_difference(plain, quiet, &Motion::velocity), kVanishing);
  }
}

TEST(QuietIce, ChangesVelocitiesByTheOrderOfItsSpeed) {
  const test::Threads one(1);
  IceSpec spec = bar();
  Ice plain(spec, {}, pushed);
  run(plain, 120);
  for (const double v : {1e-5, 1e-3, 1e-1}) {
    Ice quiet(with_quiet_speed(spec, v), {}, pushed);
    run(quiet, 120);
    EXPECT_LT(largest_difference(plain, quiet, &Motion::velocity), 5 * v);
  }
}

TEST(QuietIce, IsWokenBeforeAWaveArrives) {
  const test::Threads one(1);
  constexpr double v = 1e-3;
  Ice ice(with_quiet_speed(bar(), v), {}, pushed);
  EXPECT_GT(ice.asleep_fraction(), 0.5);
  double asleep = 1;
  for (int n = 0; n < 210; ++n) {
    const Particles& p = ice.particles();
    double front = -10, sleeping = 10;  // along the bar
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Motion& m = p.motion[i];
      if (m.velocity.norm() > v) front = std::max(front, m.position[0]);
      if (p.awake(i)) continue;
      sleeping = std::min(sleeping, m.position[0]);
      ASSERT_TRUE(m.velocity.isZero(0));
      ASSERT_EQ(trace(p.stress[i]), 0);
    }
    ASSERT_GT(sleeping - front, 4 * dx);  // neighbours of a neighbour: sites up to twice two spacings away
    EXPECT_LE(ice.asleep_fraction(), asleep);
    asleep = ice.asleep_fraction();
    run(ice, 1);
  }
  EXPECT_EQ(asleep, 0);
}

TEST(QuietIce, MomentumAndEnergyCloseAsInIceThatIsAllAwake) {
  const test::Threads one(1);
  IceSpec spec = bar();
  for (const bool single : {false, true}) {
    if (single) spec.numerics.precision = Precision::single;
    const auto ledgers = [&](double quiet_speed) {
      Ice ice(with_quiet_speed(spec, quiet_speed), {}, pushed);
      const IceLedger before = ice.ledger();
      run(ice, 60);
      return std::pair(before, ice.ledger());
    };
    const auto [before, after] = ledgers(4);  // more than the wave has: it comes back from the sleeping ice
    const double momentum = (after.momentum - before.momentum - after.held_impulse).norm();
    EXPECT_GT(after.held_impulse.norm(), 0.1 * after.momentum_scale);
    EXPECT_LT(momentum, (single ? 1e-8 : 1e-13) * after.momentum_scale);
    const auto energy_error = [](const auto& entries) {
      const auto& [start, end] = entries;
      return std::abs(end.kinetic + end.elastic + end.viscous - start.kinetic);
    };
    EXPECT_LT(energy_error(std::pair(before, after)), 1.5 * energy_error(ledgers(0)));
  }
}

TEST(QuietIce, IsBitIdenticalForOneAndTwoThreads) {
  const auto after = [](int threads) {
    const test::Threads limit(threads);
    Ice ice(with_quiet_speed(bar(), 1e-2), {}, pushed);
    run(ice, 60);
    return ice;
  };
  const Ice one = after(1), two = after(2);
  EXPECT_GT(one.asleep_fraction(), 0);
  EXPECT_EQ(one.asleep_fraction(), two.asleep_fraction());
  EXPECT_EQ(largest_difference(one, two, &Motion::position), 0);
  EXPECT_EQ(largest_difference(one, two, &Motion::velocity), 0);
}

/// Two cubes half a metre apart, and a ball that meets the first.
struct TwoPieces {
  std::vector<Surface> ball;
  Ice ice;
  explicit TwoPieces(double quiet_speed) : ball{struck()}, ice(with_quiet_speed(spec(), quiet_speed), ball) {}
  static Surface struck() {
    Surface ball = test::sphere({0.001, -0.002, -0.255}, 0.1, 0.015);
    test::set_velocity(ball, {0, 5, 100});
    return ball;
  }
  static IceSpec spec() {
    IceSpec spec = bar();
    spec.pieces[0].size = Vec3::Constant(0.3);
    spec.pieces.push_back(spec.pieces[0]);
    spec.pieces[1].centre = Vec3(0.8, 0, 0);
    spec.material.model = Model::drucker_prager;
    return spec;
  }
  void run(int steps) {
    for (int n = 0; n < steps; ++n) {
      const double dt = ice.stable_step().dt;
      ice.drift(dt / 2);
      test::move(ball[0], dt / 2 * Vec3(0, 5, 100));
      ice.interact(ball, dt);
      impulse += dt * ball[0].force;
      ice.kick(dt);
      ice.drift_and_differentiate(dt / 2);
      test::move(ball[0], dt / 2 * Vec3(0, 5, 100));
    }
  }
  Vec3 impulse = Vec3::Zero();  // N s, on the ball
};

TEST(QuietIce, WokenByContactGivesTheForceOfIceThatIsAllAwake) {
  const test::Threads one(1);
  TwoPieces plain(0), quiet(kVanishing);
  EXPECT_EQ(quiet.ice.asleep_fraction(), 1);
  plain.run(60), quiet.run(60);
  EXPECT_GT(quiet.impulse.norm(), 0);
  EXPECT_EQ(quiet.impulse, plain.impulse);
}

TEST(QuietIce, APieceThatNothingReachesSleepsOn) {
  const test::Threads one(1);
  TwoPieces scene(1e-3);
  const double size = static_cast<double>(scene.ice.particles().size()), half = size / 2;
  for (int n = 0; n < 40; ++n) {
    scene.run(10);
    // All of it but the blocks, of at most 1024 particles, that it shares with the struck piece and with its debris.
    EXPECT_GE(scene.ice.asleep_fraction(), (half - 2 * 1024) / size);
  }
  EXPECT_LT(scene.ice.asleep_fraction(), 0.5);
  EXPECT_GT(scene.ice.rebuilds(), 3u);
  const auto order = scene.ice.creation_order();
  for (std::size_t k = order.size() / 2; k < order.size(); ++k)
    EXPECT_TRUE(scene.ice.particles().motion[order[k]].velocity.isZero(0));
}

TEST(QuietIce, DoesNotExistWhereSomethingWorksOnIceAtRest) {
  for (const Change& change : std::initializer_list<Change>{
           [](IceSpec& s) { s.numerics.quiet_speed = 0; }, [](IceSpec& s) { s.gravity = Vec3(0, 0, -9.81); },
           [](IceSpec& s) { s.numerics.density_diffusion = 0.1; }, [](IceSpec& s) { s.numerics.shifting = 0.1; },
           [](IceSpec& s) { s.numerics.density_reinitialisation = 20; }}) {
    IceSpec spec = with_quiet_speed(bar(), 1);
    change(spec);
    EXPECT_FALSE(has_quiet_ice(spec));
    const Ice ice(spec);
    EXPECT_EQ(ice.asleep_fraction(), 0);
    EXPECT_EQ(ice.particles().sleep.capacity(), 0u);
  }
  EXPECT_EQ(Ice(with_quiet_speed(bar(), 1)).asleep_fraction(), 1);
}

TEST(QuietIce, IsAwakeWhereItMovesAtTheStart) {
  const auto slowly = [](const Vec3&) { return Vec3(0, 1e-9, 0); };
  EXPECT_EQ(Ice(with_quiet_speed(bar(), 1), {}, {.velocity = slowly}).asleep_fraction(), 0);
}

}  // namespace
}  // namespace nilas::sph
