#include "sph/ice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/support/particle_clouds.hpp"
#include "tests/support/surfaces.hpp"

namespace nilas::sph {
namespace {

constexpr double dx = 0.02;

IceSpec block(const Vec3& cells, Model model = Model::elastic) {
  IceSpec spec;
  PieceSpec piece;
  piece.shape = IceShape::block;
  piece.size = dx * cells;
  spec.pieces = {piece};
  spec.spacing = dx;
  spec.material.model = model;
  return spec;
}

Vec3 stir(const Vec3& x) {
  return {3 * std::sin(40 * x[1]) + 100 * x[0], 2 * std::cos(30 * x[2]) - 80 * x[1], std::sin(50 * x[0] + 20 * x[2])};
}

void run(Ice& ice, std::vector<Surface>& surfaces, int steps) {
  for (int n = 0; n < steps; ++n) ice.step(surfaces, ice.stable_step().dt);
}
void run(Ice& ice, int steps) {
  std::vector<Surface> none;
  run(ice, none, steps);
}

/// Positions and velocities in order of creation.
std::vector<Vec3> state(const Ice& ice) {
  std::vector<Vec3> s;
  for (const std::uint32_t i : ice.creation_order()) {
    s.push_back(ice.particles().motion[i].position);
    s.push_back(ice.particles().motion[i].velocity);
  }
  return s;
}

/// A ball that a block of ice meets at 100 m/s.
struct Impact {
  std::vector<Surface> ball{test::sphere({0.001, -0.002, -0.155}, 0.1, 0.015)};
  Ice ice;
  explicit Impact(IceSpec spec = block({12, 11, 4}, Model::drucker_prager))
      : ice((test::set_velocity(ball[0], {0, 5, 100}), spec), ball) {}
  void step() {
    const double dt = ice.stable_step().dt;
    ice.drift(dt / 2);
    test::move(ball[0], dt / 2 * Vec3(0, 5, 100));
    ice.interact(ball, dt);
    impulse += dt * ball[0].force;
    ice.kick(dt);
    ice.drift_and_differentiate(dt / 2);
    test::move(ball[0], dt / 2 * Vec3(0, 5, 100));
  }
  void run(int steps) {
    const test::Threads one(1);  // too small to share
    for (int n = 0; n < steps; ++n) step();
  }
  Vec3 impulse = Vec3::Zero();  // N s, on the ball
};

TEST(Ice, UnderNoLoadFliesStraightAndUnstrained) {
  for (const bool corrected : {false, true}) {
    IceSpec spec = block({8, 7, 6}, Model::drucker_prager);
    spec.numerics.gradient_correction = corrected;
    spec.pieces[0].velocity = {300, -200, 100};
    Ice ice(spec);
    const std::vector<Vec3> before = state(ice);
    double time = 0;
    std::vector<Surface> none;
    for (int n = 0; n < 100; ++n) {
      const double dt = ice.stable_step().dt;
      ice.step(none, dt);
      time += dt;
    }
    const std::vector<Vec3> after = state(ice);
    for (std::size_t k = 0; k < after.size(); k += 2) {
      EXPECT_LT((after[k] - before[k] - time * Vec3(300, -200, 100)).norm(), 1e-12);
      EXPECT_EQ(after[k + 1], before[k + 1]);
    }
    for (std::size_t i = 0; i < ice.particles().size(); ++i) {
      EXPECT_EQ(to_matrix(ice.particles().stress[i]), Mat3::Zero());
      EXPECT_EQ(ice.particles().motion[i].volume, dx * dx * dx);
    }
  }
}

TEST(Ice, KeepsItsMomentumToRoundOff) {
  for (const bool corrected : {false, true})
    for (const Model model : {Model::elastic, Model::drucker_prager}) {
      IceSpec spec = block({9, 8, 7}, model);
      spec.numerics.gradient_correction = corrected;
      Ice ice(spec, {}, {.velocity = stir});
      const Vec3 before = ice.ledger().momentum;
      run(ice, 100);
      EXPECT_LT((ice.ledger().momentum - before).norm(), 1e-13 * ice.ledger().momentum_scale);
    }
}

TEST(Ice, KeepsItsMomentumAcrossPeriodicFaces) {
  IceSpec spec = block({8, 7, 9}, Model::elastic);
  spec.periodic = {true, true, true};
  spec.pieces[0].velocity = {50, 20, -700};
  Ice ice(spec, {}, {.velocity = [](const Vec3& x) {
            const double phase = 2 * 3.141592653589793 * x[0] / (8 * dx);
            return Vec3(std::sin(phase), 2 * std::cos(phase), 0);
          }});
  const Vec3 before = ice.ledger().momentum;
  run(ice, 100);
  EXPECT_LT((ice.ledger().momentum - before).norm(), 1e-13 * ice.ledger().momentum_scale);
}

TEST(Ice, PeriodicIceHasNoSurfaces) {
  IceSpec spec = block({8, 7, 9}, Model::elastic);
  spec.periodic = {true, true, true};
  spec.pieces[0].velocity = {900, -300, 100};
  Ice ice(spec);
  run(ice, 200);  // through several periods
  for (const Motion& m : ice.particles().motion) {
    EXPECT_EQ(m.velocity, spec.pieces[0].velocity);
    EXPECT_EQ(m.volume, dx * dx * dx);
  }
}

TEST(Ice, LosesMomentumToItsFixedPartsAndNothingElse) {
  IceSpec spec = block({12, 8, 6}, Model::elastic);
  spec.pieces[0].fixed.faces[0] = true;
  Ice ice(spec, {}, {.velocity = [](const Vec3& x) { return Vec3(-1, 2 * x[2], 30 * x[0]); }});
  const IceLedger before = ice.ledger();
  run(ice, 200);
  const IceLedger after = ice.ledger();
  ASSERT_GT(after.held_impulse.norm(), 0.01 * before.momentum_scale);
  EXPECT_LT((after.momentum - before.momentum - after.held_impulse).norm(), 1e-13 * before.momentum_scale);
}

TEST(Ice, FixedPartsStayWhereTheyAre) {
  IceSpec spec = block({12, 8, 6}, Model::elastic);
  spec.pieces[0].fixed.faces[0] = true;
  Ice ice(spec, {}, {.velocity = stir});
  const std::vector<Vec3> before = state(ice);
  run(ice, 100);
  const std::vector<Vec3> after = state(ice);
  const auto order = ice.creation_order();
  int held = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (!ice.particles().held[order[k]]) continue;
    ++held;
    EXPECT_EQ(after[2 * k], before[2 * k]);
    EXPECT_EQ(after[2 * k + 1], Vec3::Zero());
  }
  EXPECT_EQ(held, 3 * 8 * 6);  // 2h = 2.6 spacings: layers at 0.5, 1.5 and 2.5
}

TEST(Ice, MomentumItGainsTheBodyLoses) {
  Impact impact;
  const IceLedger before = impact.ice.ledger();
  impact.run(150);
  const IceLedger after = impact.ice.ledger();
  ASSERT_GT(impact.impulse.norm(), 1);
  EXPECT_LT((after.momentum - before.momentum + impact.impulse).norm(), 1e-13 * after.momentum_scale);
}

TEST(Ice, EnergyOfElasticIceIsKeptWithoutViscosity) {
  IceSpec spec = block({12, 10, 8}, Model::elastic);
  spec.numerics.viscosity_alpha = 0;
  Ice ice(spec, {}, {.velocity = [](const Vec3& x) -> Vec3 { return 0.01 * stir(x); }});
  const double before = ice.ledger().kinetic;
  run(ice, 400);
  const IceLedger after = ice.ledger();
  EXPECT_GT(after.elastic, 0.05 * before);
  EXPECT_NEAR((after.kinetic + after.elastic) / before, 1, 0.01);
  EXPECT_NEAR((after.kinetic + after.stress_work) / before, 1, 0.01);
  EXPECT_EQ(after.viscous, 0);
}

TEST(Ice, EnergyLedgerOfAnImpactClosesWithinOnePercent) {
  for (const AfterFailure mode : {AfterFailure::plastic, AfterFailure::fluid}) {
    IceSpec spec = block({12, 11, 4}, Model::drucker_prager);
    spec.material.after_failure = mode;
    Impact impact(spec);
    const double before = impact.ice.ledger().kinetic;
    impact.run(200);
    const IceLedger l = impact.ice.ledger();
    ASSERT_GT(l.contact_work, 100);
    EXPECT_GT(l.viscous, 0);
    EXPECT_NEAR((l.kinetic - before + l.stress_work + l.viscous) / l.contact_work, 1, 0.01);
  }
}

TEST(Ice, ResultIsBitIdenticalForOneAndTwoThreadsAndFromRunToRun) {
  const auto result = [](int threads) {
    const test::Threads scope(threads);
    IceSpec spec = block({12, 11, 4}, Model::drucker_prager);
    spec.numerics.gradient_correction = true;
    spec.contact.friction_coefficient = 0.1;
    Impact impact(spec);
    for (int n = 0; n < 80; ++n) impact.step();
    std::vector<Vec3> s = state(impact.ice);
    for (const std::uint32_t i : impact.ice.creation_order()) {
      const Sym3& t = impact.ice.particles().stress[i];
      s.emplace_back(t.xx, t.yy, t.zz), s.emplace_back(t.xy, t.xz, t.yz);
    }
    const IceLedger l = impact.ice.ledger();
    s.insert(s.end(), {impact.impulse, l.momentum, l.angular_momentum, {l.kinetic, l.elastic, l.stress_work}});
    s.emplace_back(l.viscous, l.contact_work, impact.ice.failed_count());
    for (const BoundaryParticle& b : impact.ball[0].particles) s.push_back(b.force);
    return s;
  };
  const std::vector<Vec3> one = result(1);
  EXPECT_EQ(one, result(2));
  EXPECT_EQ(one, result(1));
}

TEST(Ice, SkinChangesNothingBeyondRoundOff) {
  const auto result = [](double skin) {
    IceSpec spec = block({10, 9, 8}, Model::elastic);
    spec.numerics.skin_ratio = skin;
    Ice ice(spec, {}, {.velocity = stir});
    run(ice, 150);
    EXPECT_EQ(ice.rebuilds() > 3, skin < 0.1) << ice.rebuilds();
    return state(ice);
  };
  const std::vector<Vec3> thin = result(0.02), thick = result(0.5);
  for (std::size_t k = 0; k < thin.size(); k += 2) {
    EXPECT_LT((thin[k] - thick[k]).norm(), 1e-12 * dx);
    EXPECT_LT((thin[k + 1] - thick[k + 1]).norm(), 1e-9);
  }
}

TEST(Ice, SkinChangesNothingBeyondRoundOffInAnImpactEither) {
  const auto result = [](double skin) {
    IceSpec spec = block({12, 11, 4}, Model::elastic);
    spec.numerics.skin_ratio = skin;
    spec.contact.friction_coefficient = 0.1;
    Impact impact(spec);
    impact.run(100);
    return state(impact.ice);
  };
  const std::vector<Vec3> thin = result(0.02), thick = result(0.5);
  for (std::size_t k = 0; k < thin.size(); k += 2) {
    EXPECT_LT((thin[k] - thick[k]).norm(), 1e-10 * dx);
    EXPECT_LT((thin[k + 1] - thick[k + 1]).norm(), 1e-7);
  }
}

// V32.
TEST(Ice, ResponseIsTheSameOneKilometreAwayAtOneKilometrePerSecond) {
  const Vec3 shift(1000, -1000, 1000), boost(1000, 0, -1000);
  const auto result = [&](const Vec3& x, const Vec3& v) {
    IceSpec spec = block({9, 8, 7}, Model::drucker_prager);
    spec.pieces[0].centre = x;
    spec.pieces[0].velocity = v;
    spec.numerics.cfl = 0.5;
    Ice ice(spec, {}, {.velocity = [&](const Vec3& at) { return stir(at - x); }});
    const double dt = 4e-6;
    std::vector<Surface> none;
    for (int n = 0; n < 50; ++n) ice.step(none, dt);
    std::vector<Vec3> s = state(ice);
    for (std::size_t k = 0; k < s.size(); k += 2) s[k] -= x + 50 * dt * v, s[k + 1] -= v;
    return s;
  };
  const auto here = result(Vec3::Zero(), Vec3::Zero()), there = result(shift, boost);
  for (std::size_t k = 0; k < here.size(); k += 2) {
    EXPECT_LT((here[k] - there[k]).norm(), 1e-6 * dx);
    EXPECT_LT((here[k + 1] - there[k + 1]).norm(), 1e-6 * 10);
  }
}

TEST(Ice, OneStepIsItsFourParts) {
  IceSpec spec = block({8, 7, 6}, Model::drucker_prager);
  Ice a(spec, {}, {.velocity = stir}), b(spec, {}, {.velocity = stir});
  std::vector<Surface> none;
  for (int n = 0; n < 20; ++n) {
    const double dt = a.stable_step().dt;
    EXPECT_EQ(dt, b.stable_step().dt);
    a.step(none, dt);
    b.drift(dt / 2), b.interact(none, dt), b.kick(dt), b.drift_and_differentiate(dt / 2);
  }
  EXPECT_EQ(state(a), state(b));
}

TEST(Ice, CreationOrderFindsEveryParticleAgain) {
  Ice ice(block({9, 8, 7}), {}, {.velocity = stir});
  run(ice, 50);
  const auto order = ice.creation_order();
  for (std::uint32_t k = 0; k < order.size(); ++k) EXPECT_EQ(ice.particles().id[order[k]], k);
}

TEST(Ice, FailedCountIsTheNumberOfParticlesThatHaveYielded) {
  Impact impact;
  std::size_t before = 0;
  for (int n = 0; n < 20; ++n) {
    impact.run(10);
    const auto& failed = impact.ice.particles().failed;
    EXPECT_EQ(impact.ice.failed_count(), static_cast<std::size_t>(std::count(failed.begin(), failed.end(), 1)));
    EXPECT_GE(impact.ice.failed_count(), before);
    before = impact.ice.failed_count();
  }
  EXPECT_GT(before, 0u);
}

TEST(Ice, NonFiniteParticleStopsTheStepAndIsNamed) {
  Ice ice(block({8, 7, 6}), {}, {.velocity = [](const Vec3& x) {
            return Vec3(x.norm() < 0.8 * dx ? std::numeric_limits<double>::quiet_NaN() : 0, 0, 0);
          }});
  try {
    run(ice, 1);
    FAIL() << "no failure";
  } catch (const NumericalFailure& failure) {
    const std::string what = failure.what();
    EXPECT_NE(what.find("ice particle"), std::string::npos);
    EXPECT_NE(what.find("position"), std::string::npos);
    EXPECT_NE(what.find("velocity"), std::string::npos);
    EXPECT_NE(what.find("neighbours"), std::string::npos);
    EXPECT_EQ(what.find("nan"), std::string::npos);
  }
}

TEST(Ice, UnstableStepEndsInANumericalFailureNotInNans) {
  for (const Model model : {Model::elastic, Model::drucker_prager}) {
    Ice ice(block({8, 7, 6}, model), {}, {.velocity = stir});
    std::vector<Surface> none;
    const double dt = 20 * ice.stable_step().dt;
    bool stopped = false;
    for (int n = 0; n < 1000 && !stopped; ++n) {
      try {
        ice.step(none, dt);
      } catch (const NumericalFailure&) {
        stopped = true;
        break;
      }
      for (const Vec3& v : state(ice)) ASSERT_TRUE(v.allFinite());
    }
    EXPECT_TRUE(stopped);
  }
}

TEST(Ice, SpecWithoutParticlesIsRefused) {
  IceSpec spec = block({1, 1, 1});
  spec.pieces[0].shape = IceShape::sphere;
  spec.pieces[0].diameter = 1.6 * dx;
  EXPECT_THROW(Ice{spec}, std::invalid_argument);
}

bool left_out(const Ice& ice, const std::string& word) {
  const auto terms = ice.terms_left_out();
  return std::any_of(terms.begin(), terms.end(),
                     [&](const std::string& t) { return t.find(word) != std::string::npos; });
}

TEST(TermsLeftOut, AreThoseThatTheSpecDoesNotName) {
  const Ice bare = [] {
    IceSpec spec = block({6, 6, 6}, Model::elastic);
    spec.numerics.viscosity_alpha = 0;
    return Ice(spec);
  }();
  for (const char* term : {"correction", "viscosity", "plasticity", "periodic", "contact", "fixed", "single-precision"})
    EXPECT_TRUE(left_out(bare, term)) << term;

  IceSpec spec = block({8, 8, 8}, Model::drucker_prager);
  spec.numerics.gradient_correction = true;
  spec.numerics.artificial_stress = 0.3;
  spec.numerics.density_diffusion = 0.1;
  spec.numerics.density_reinitialisation = 20;
  spec.numerics.shifting = 0.1;
  spec.numerics.hourglass_control = 1;
  spec.numerics.quiet_speed = 1e-3;
  spec.numerics.precision = Precision::single;
  spec.gravity = {0, 0, -9.81};
  spec.material.pressure = PressureLaw::density;
  spec.material.hardening_modulus = 1e9;
  spec.periodic = {true, false, false};
  spec.pieces[0].fixed.faces[5] = true;
  spec.contact.stick = true;
  const Ice full(spec, {test::sphere({0, 0, -1}, 0.1, 0.015)});
  EXPECT_TRUE(full.terms_left_out().empty());
}

TEST(TermsLeftOut, AreThoseOfTheModelInUse) {
  const auto of = [](Model model) {
    IceSpec spec = block({6, 6, 6}, model);
    spec.material.pressure = PressureLaw::density;
    return Ice(spec);
  };
  EXPECT_TRUE(left_out(of(Model::drucker_prager), "hardening"));
  EXPECT_FALSE(left_out(of(Model::drucker_prager), "Kelvin-Voigt"));
  EXPECT_TRUE(left_out(of(Model::neo_hookean), "Kelvin-Voigt"));
  EXPECT_TRUE(left_out(of(Model::neo_hookean), "plasticity"));
  for (const char* term : {"plasticity", "bulking", "hardening", "Kelvin-Voigt"})
    EXPECT_FALSE(left_out(of(Model::rate_dependent), term)) << term;
}

TEST(TermsLeftOut, StayEmptyThroughARun) {
  Impact impact;
  impact.run(30);
  EXPECT_TRUE(impact.ice.particles().correction.empty());
  EXPECT_TRUE(impact.ice.particles().bulking.empty());
  EXPECT_EQ(impact.ice.correction_fallbacks(), 0u);
}

TEST(Ice, LoneFragmentsAreCountedAsFallbacksOfTheCorrection) {
  IceSpec spec = block({1, 1, 1});
  spec.numerics.gradient_correction = true;
  Ice ice(spec);
  run(ice, 3);
  EXPECT_EQ(ice.correction_fallbacks(), 4u);  // at the start and in every step
}

// Debris must not blow up, however few neighbours a fragment has left.
TEST(Ice, ThinSheetsBreakUpWithoutNumericalFailure) {
  for (const bool corrected : {false, true})
    for (const int layers : {1, 4})
      for (const AfterFailure mode : {AfterFailure::plastic, AfterFailure::fluid}) {
        IceSpec spec = block({10, 10, static_cast<double>(layers)}, Model::drucker_prager);
        spec.numerics.gradient_correction = corrected;
        spec.material.after_failure = mode;
        Impact impact(spec);
        EXPECT_NO_THROW(impact.run(800)) << corrected << " " << layers;
        for (const Vec3& v : state(impact.ice)) ASSERT_TRUE(v.allFinite());
      }
}

}  // namespace
}  // namespace nilas::sph
