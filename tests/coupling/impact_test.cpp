#include "coupling/impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "coupling/stability_number.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using rigid::Motion;

constexpr double kDuration = 2e-3;  // s: the nose is through half of the sheet

Vec3 mirrored(const Vec3& v) { return {v.x(), -v.y(), v.z()}; }
Vec3 mirrored_axial(const Vec3& v) { return {-v.x(), v.y(), -v.z()}; }

TEST(Advance, EndsExactlyAndObservesEveryEqualSubStep) {
  std::vector<StepRecord> steps;
  Impact impact(test::small_sheet(), {Body(test::short_hcc(90))},
                [&](const Impact& i) { steps.push_back(i.last_step()); });
  const double limit = impact.stable_step().dt, duration = 7.3 * limit;
  impact.advance(duration);
  ASSERT_GE(steps.size(), 8u);
  EXPECT_NEAR(steps.back().time, duration, 1e-15 * 10);
  for (std::size_t n = 0; n < steps.size(); ++n) {
    EXPECT_EQ(steps[n].number, n + 1);
    EXPECT_LE(steps[n].dt, limit * (1 + 1e-12));
  }
  // Nothing has touched: no reason for steps of different length.
  EXPECT_NEAR(steps.front().dt, steps.back().dt, 1e-12 * limit);
}

TEST(Advance, ResolvesTheRotationOfAFastSpinningBody) {
  rigid::BodySpec spinning = test::short_hcc(90);
  spinning.angular_velocity = Vec3(0, 0, 3e4);
  const Impact impact(test::small_sheet(), {Body(spinning)});
  EXPECT_EQ(impact.stable_step().limiter, sph::Limiter::body_rotation);
  EXPECT_NEAR(impact.stable_step().dt, 0.05 / 3e4, 1e-12);
}

TEST(Advance, MovesASurfaceByAtMostAQuarterOfASpacingAlongItsNormal) {
  rigid::BodySpec fast = test::short_hcc(90);
  fast.velocity *= 30;
  const sph::IceSpec ice = test::small_sheet();
  const Impact impact(ice, {Body(fast)});
  const sph::StepLimit limit = impact.stable_step();
  EXPECT_EQ(limit.limiter, sph::Limiter::body_speed);
  // The boundary particle next to the tip faces forward within a spacing over the radius of the nose.
  EXPECT_NEAR(limit.dt * 3000 / (0.25 * ice.spacing), 1, 0.02);
  // Ice that moves along, however fast, is not met.
  sph::IceSpec carried = ice;
  carried.pieces[0].velocity = Vec3(0, 0, 2950);
  EXPECT_NE(Impact(carried, {Body(fast)}).stable_step().limiter, sph::Limiter::body_speed);
}

TEST(Advance, KeepsTheCouplingNumberThatTheSceneAllows) {
  rigid::BodySpec light = test::short_hcc(90);
  light.mass.mass *= 1e-2;
  light.mass.inertia *= 1e-2;
  sph::IceSpec ice = test::small_sheet();
  const sph::ElasticConstants elastic(ice.material);
  const double unlimited = Impact(ice, {Body(light)}).stable_step().dt;
  ASSERT_GT(stability_number(Body(light), elastic, false, unlimited).largest(), 0.5);
  ice.numerics.max_coupling_number = 0.5;
  const sph::StepLimit limit = Impact(ice, {Body(light)}).stable_step();
  EXPECT_EQ(limit.limiter, sph::Limiter::coupling);
  EXPECT_NEAR(stability_number(Body(light), elastic, false, limit.dt).largest(), 0.5, 1e-12);
  ice.numerics.max_coupling_number = 1e9;
  EXPECT_EQ(Impact(ice, {Body(light)}).stable_step().dt, unlimited);
}

// The momentum that passes through ice at rest grows for ever; round-off is measured against that.
TEST(Ledger, ClosesWhileIceLiesOnAPlate) {
  sph::IceSpec ice = test::ice_out_of_reach();
  ice.material.model = sph::Model::elastic;
  ice.pieces[0].size = Vec3::Constant(0.3);
  ice.pieces[0].centre = Vec3(0, 0, 0.15);
  ice.gravity = Vec3(0, 0, -9.81);
  rigid::BodySpec plate;
  plate.name = "plate";
  plate.shape = rigid::Box{Vec3(0.6, 0.6, 0.1)};
  plate.boundary_spacing = 0.075;
  plate.mass = rigid::from_density(plate.shape, 1000);
  plate.motion = Motion::fixed;
  plate.position = Vec3(0, 0, -0.05);
  Impact impact(ice, {Body(plate)});
  double largest = 0;
  for (int n = 0; n < 20; ++n) {
    impact.advance(0.005);
    largest = std::max(largest, impact.ledger().momentum_residual);
  }
  EXPECT_GT(impact.last_step().number, 2000u);
  EXPECT_LT(largest, 1e-12);
}

TEST(Advance, MovesABodyOutOfTouchAsAFreeBodyUnderItsLoad) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Impact impact(test::ice_out_of_reach(), {Body(spec)});
  const Vec3 force(100, -200, 300);
  const double time = 0.05;
  impact.advance(time, {{force, Vec3::Zero()}});
  const Body& body = impact.bodies()[0];
  const Vec3 a = force / spec.mass.mass;
  EXPECT_LT((body.velocity() - spec.velocity - time * a).norm(), 1e-12 * 100);
  EXPECT_LT((body.state().position - spec.position - time * spec.velocity - 0.5 * time * time * a).norm(), 1e-12);
}

// The books of a real impact: V31.
class LedgerOfAnImpact : public testing::TestWithParam<Motion> {};

TEST_P(LedgerOfAnImpact, Closes) {
  for (const bool held : {false, true}) {
    sph::IceSpec ice = test::small_sheet();
    ice.pieces[0].fixed.rim = held;
    Impact impact(ice, {Body(test::short_hcc(60, GetParam()))});
    const double before = impact.ledger().kinetic_bodies;
    LedgerEntry entry;
    for (int n = 0; n < 4; ++n) {
      impact.advance(kDuration / 4);
      entry = impact.ledger();
      EXPECT_LT(entry.momentum_residual, 1e-10);
      EXPECT_LT(entry.angular_momentum_residual, 1e-3);
    }
    EXPECT_LT(entry.energy_residual, 0.02);
    // It was an impact: the ice has failed and taken up energy.
    EXPECT_GT(impact.ice().failed_count(), impact.ice().particles().size() / 2);
    EXPECT_GT(entry.kinetic_ice, 0.01 * before);
    EXPECT_EQ(entry.held_impulse.norm() > 0, held);
  }
}
INSTANTIATE_TEST_SUITE_P(EveryMotion, LedgerOfAnImpact,
                         testing::Values(Motion::free, Motion::translation_only, Motion::fixed_path));

TEST(Ledger, ClosesWithAnAbsorbingRim) {
  sph::IceSpec ice = test::small_sheet();
  ice.pieces[0].absorbing_rim = true;
  Impact impact(ice, {Body(test::short_hcc(60))});
  impact.advance(kDuration);
  const LedgerEntry entry = impact.ledger();
  EXPECT_GT(entry.absorbed, 0.01 * entry.kinetic_ice);
  EXPECT_GT(entry.held_impulse.norm(), 0);
  EXPECT_LT(entry.momentum_residual, 1e-10);
  EXPECT_LT(entry.angular_momentum_residual, 1e-3);
  EXPECT_LT(entry.energy_residual, 0.02);
}

TEST(Ledger, TakesTheMomentumThatTheBodyLostFromTheIceAndTheRimWithoutAccounts) {
  sph::IceSpec ice = test::small_sheet();
  Impact impact(ice, {Body(test::short_hcc(60))});
  const Vec3 before = test::total_momentum(impact);
  impact.advance(kDuration);
  EXPECT_LT((test::total_momentum(impact) - before).norm(), 1e-10 * before.norm());
  EXPECT_GT((impact.bodies()[0].state().momentum - before).norm(), 0.01 * before.norm());
}

// Stress work and stored energy differ by products of strain only, and the strain of a blow at v is about v/c_p.
TEST(Ledger, HasNoPlasticTermWhenTheIceIsElastic) {
  Impact impact(test::elastic_sheet(), {Body(test::short_hcc(60))});
  const double strain = 100 / impact.ice().elastic_constants().p_wave_speed();
  double elastic = 0, plastic = 0;
  for (int n = 0; n < 20; ++n) {
    impact.advance(kDuration / 20);
    const LedgerEntry entry = impact.ledger();
    elastic = std::max(elastic, entry.elastic);
    plastic = std::max(plastic, std::abs(entry.plastic));
    EXPECT_EQ(entry.viscous, 0);
    EXPECT_LT(entry.momentum_residual, 1e-10);
    EXPECT_LT(entry.energy_residual, 0.02);
  }
  ASSERT_GT(elastic, 0);
  EXPECT_LT(plastic, strain * elastic);
}

// V33.
TEST(Ledger, CountsEnergyThatContactMakesAsError) {
  // A body of some grams: the explicit exchange is unstable and throws it away with energy that nobody put in.
  rigid::BodySpec feather = test::short_hcc(90);
  feather.mass.mass *= 1e-4;
  feather.mass.inertia *= 1e-4;
  Impact impact(test::small_sheet(), {Body(feather)});
  const double energy = impact.bodies()[0].kinetic_energy();
  impact.advance(1e-3);
  const LedgerEntry entry = impact.ledger();
  ASSERT_GT(entry.kinetic_bodies, 2 * energy);
  EXPECT_LT(entry.contact, 0);
  EXPECT_GT(entry.energy_residual, 0.5);
  EXPECT_LT(entry.momentum_residual, 1e-10);
}

TEST(Symmetry, AVerticalImpactGivesNoSideForceAndNoSpin) {
  double largest = 0, side = 0, spin = 0;
  Impact impact(test::small_sheet(), {Body(test::short_hcc(90))}, [&](const Impact& i) {
    const sph::Surface& surface = i.surfaces()[0];
    largest = std::max(largest, std::abs(surface.force.z()));
    side = std::max({side, std::abs(surface.force.x()), std::abs(surface.force.y())});
    spin = std::max(spin, i.bodies()[0].angular_velocity().norm());
    EXPECT_LE(side, 1e-9 * largest) << i.last_step().time;
  });
  impact.advance(2 * kDuration);
  EXPECT_GT(largest, 1e5);
  // A spin is a side force at a lever of the body's length; |F| dt L / I is rad/s in one step.
  EXPECT_LT(spin, 1e-9 * 100 / 0.6);
}

TEST(Symmetry, AMirroredImpactGivesTheMirroredResult) {
  const rigid::BodySpec spec = test::short_hcc(60);
  rigid::BodySpec image = spec;
  image.position = mirrored(spec.position);
  image.velocity = mirrored(spec.velocity);
  image.orientation = rigid::orientation_along(mirrored(test::heading(60)));
  Impact impact(test::small_sheet(), {Body(spec)}), mirror(test::small_sheet(), {Body(image)});
  impact.advance(kDuration);
  mirror.advance(kDuration);
  const Body &a = impact.bodies()[0], &b = mirror.bodies()[0];
  EXPECT_GT(a.angular_velocity().norm(), 1);
  EXPECT_LT((a.velocity() - mirrored(b.velocity())).norm(), 1e-9 * 100);
  EXPECT_LT((a.state().position - mirrored(b.state().position)).norm(), 1e-9);
  EXPECT_LT((a.angular_velocity() - mirrored_axial(b.angular_velocity())).norm(), 1e-9 * a.angular_velocity().norm());
}

/// Histories of a run seen from `origin` moving at `drift`, where it takes place.
struct History {
  std::vector<Vec3> force, velocity, position;
};
History history(const Vec3& origin, const Vec3& drift, double duration) {
  sph::IceSpec ice = test::small_sheet();
  rigid::BodySpec spec = test::short_hcc(60);
  ice.pieces[0].centre += origin;
  ice.pieces[0].velocity += drift;
  spec.position += origin;
  spec.velocity += drift;
  History h;
  Impact impact(ice, {Body(spec)}, [&](const Impact& i) {
    const Body& body = i.bodies()[0];
    h.force.push_back(i.surfaces()[0].force);
    h.velocity.push_back(body.velocity() - drift);
    h.position.push_back(body.state().position - origin - i.last_step().time * drift);
  });
  impact.advance(duration);
  return h;
}

// V32.
TEST(Galilei, ADistantOriginAndAFastFrameGiveTheSameResponse) {
  const double duration = kDuration / 2;
  const History here = history(Vec3::Zero(), Vec3::Zero(), duration);
  double largest = 0;
  for (const Vec3& f : here.force) largest = std::max(largest, f.norm());
  const Vec3 far(1000, -500, 250), fast(1000, 300, -200);
  for (const auto& [origin, drift] :
       {std::pair(far, Vec3(0, 0, 0)), std::pair(Vec3(0, 0, 0), fast), std::pair(far, fast)}) {
    const History there = history(origin, drift, duration);
    ASSERT_EQ(there.force.size(), here.force.size());
    for (std::size_t n = 0; n < here.force.size(); ++n) {
      EXPECT_LT((there.force[n] - here.force[n]).norm(), 1e-6 * largest) << n;
      EXPECT_LT((there.velocity[n] - here.velocity[n]).norm(), 1e-6 * 100) << n;
      EXPECT_LT((there.position[n] - here.position[n]).norm(), 1e-6 * 0.1) << n;
    }
  }
}

TEST(SeveralBodies, ShareOneIceAndOneLedger) {
  rigid::BodySpec below = test::short_hcc(60), above = test::short_hcc(90);
  above.name = "above";
  above.position.z() *= -1;
  above.position.y() += 0.1;
  above.orientation = rigid::orientation_along(Vec3(0, 0, -1));
  above.velocity = Vec3(0, 0, -60);
  Impact impact(test::small_sheet(), {Body(below), Body(above, Vec3(0, 0, 1), Vec3::Zero())});
  impact.advance(kDuration);
  const LedgerEntry entry = impact.ledger();
  EXPECT_LT(entry.momentum_residual, 1e-10);
  EXPECT_LT(entry.angular_momentum_residual, 1e-3);
  EXPECT_LT(entry.energy_residual, 0.02);
  EXPECT_LT(impact.bodies()[0].velocity().norm(), 99);
  EXPECT_GT(impact.bodies()[1].velocity().z(), -59.5);
  EXPECT_TRUE(impact.bodies()[1].velocity().head<2>().isZero(0));
}

}  // namespace
}  // namespace nilas
