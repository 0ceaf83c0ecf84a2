#include "coupling/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using rigid::Motion;

constexpr double kBulletStep = 1e-4;  // s

TEST(Simulation, CreatesABulletWorldOnlyForBodiesThatMoveFreely) {
  const auto has_world = [](std::vector<Motion> motions) {
    std::vector<rigid::BodySpec> bodies;
    for (const Motion motion : motions) bodies.push_back(test::short_hcc(90, motion));
    return Simulation(test::ice_out_of_reach(), bodies, kBulletStep).has_bullet_world();
  };
  EXPECT_FALSE(has_world({}));
  EXPECT_FALSE(has_world({Motion::fixed_path}));
  EXPECT_FALSE(has_world({Motion::fixed_path, Motion::fixed}));
  EXPECT_TRUE(has_world({Motion::free}));
  EXPECT_TRUE(has_world({Motion::translation_only}));
  EXPECT_TRUE(has_world({Motion::fixed, Motion::free}));
}

TEST(Simulation, HoldsAFixedPathExactlyThroughTheIce) {
  const rigid::BodySpec spec = test::short_hcc(60, Motion::fixed_path);
  Simulation simulation(test::small_sheet(), {spec}, kBulletStep);
  simulation.advance_to(1e-3);
  const Body& body = simulation.impact().bodies()[0];
  EXPECT_EQ(body.velocity(), Body(spec).velocity());
  EXPECT_LT((body.state().position - spec.position - 1e-3 * spec.velocity).norm(), 1e-14);
  EXPECT_EQ(body.state().orientation.coeffs(), Body(spec).state().orientation.coeffs());
  EXPECT_GT(body.account().ice_impulse.norm(), 10);
  EXPECT_EQ(body.account().external_impulse, -body.account().ice_impulse);
  EXPECT_LT(simulation.impact().ledger().momentum_residual, 1e-10);
}

TEST(Simulation, KeepsTheAttitudeOfATranslatingBody) {
  const rigid::BodySpec spec = test::short_hcc(60, Motion::translation_only);
  Simulation simulation(test::small_sheet(), {spec}, kBulletStep);
  simulation.advance_to(1e-3);
  const Body& body = simulation.impact().bodies()[0];
  EXPECT_LT((body.state().orientation.coeffs() - spec.orientation.coeffs()).norm(), 1e-15);
  EXPECT_LT(body.velocity().norm(), 99);
  EXPECT_LT(simulation.impact().ledger().momentum_residual, 1e-10);
}

TEST(Simulation, ReachesEveryTimeByWholeBulletStepsAndAShorterLastOne) {
  Simulation simulation(test::ice_out_of_reach(), {test::short_hcc(60)}, kBulletStep);
  for (const double time : {3 * kBulletStep, 3 * kBulletStep, 3.4 * kBulletStep, 11 * kBulletStep, 5 * kBulletStep}) {
    simulation.advance_to(time);
    EXPECT_NEAR(simulation.impact().last_step().time, std::max(time, simulation.impact().last_step().time), 1e-15);
  }
  EXPECT_NEAR(simulation.impact().last_step().time, 11 * kBulletStep, 1e-15);
}

// A free body that meets nothing: position and attitude of rigid::drift, through Bullet's world.
TEST(Simulation, CarriesAFreeBodyByRigidDrift) {
  rigid::BodySpec spec = test::short_hcc(60);
  spec.angular_velocity = Vec3(3, -20, 40);
  Simulation simulation(test::ice_out_of_reach(), {spec}, 1e-2);
  simulation.advance_to(0.1);
  rigid::State expected = Body(spec).state();
  rigid::drift(expected, spec.mass.mass, spec.mass.inertia, 0.1);
  const rigid::State& state = simulation.impact().bodies()[0].state();
  EXPECT_LT((state.position - expected.position).norm(), 1e-11);
  EXPECT_LT((state.orientation.toRotationMatrix() - expected.orientation.toRotationMatrix()).norm(), 1e-11);
  EXPECT_LT((state.angular_momentum - expected.angular_momentum).norm(), 1e-11 * expected.angular_momentum.norm());
}

TEST(Simulation, ObservesEverySubStepOfEitherKind) {
  for (const Motion motion : {Motion::free, Motion::fixed_path}) {
    std::size_t calls = 0;
    Simulation simulation(test::small_sheet(), {test::short_hcc(90, motion)}, kBulletStep,
                          [&](const Impact& impact) { EXPECT_EQ(impact.last_step().number, ++calls); });
    simulation.advance_to(3 * kBulletStep);
    EXPECT_EQ(calls, simulation.impact().last_step().number);
    EXPECT_GT(calls, 3u);
  }
}

// A light plate carried upwards by the ice that strikes it, beside one that cannot move.
TEST(Simulation, MixesFreeAndFixedBodiesInOneLedger) {
  rigid::BodySpec plate, anvil;
  plate.name = "plate";
  plate.shape = rigid::Box{Vec3(0.3, 0.3, 0.1)};
  plate.boundary_spacing = 0.0225;  // at equal spacing the edges of a box make energy: see contact.hpp
  plate.mass = rigid::from_density(plate.shape, 2700);
  plate.position = Vec3(-0.2, 0, -0.21);
  anvil = plate;
  anvil.name = "anvil";
  anvil.motion = Motion::fixed;
  anvil.position.x() = 0.2;
  sph::IceSpec ice = test::small_sheet();
  ice.pieces[0].velocity = Vec3(0, 0, -40);
  Simulation simulation(ice, {plate, anvil}, kBulletStep);
  simulation.advance_to(1e-3);
  const LedgerEntry entry = simulation.impact().ledger();
  EXPECT_LT(simulation.impact().bodies()[0].velocity().z(), -1);
  EXPECT_TRUE(simulation.impact().bodies()[1].velocity().isZero(0));
  EXPECT_LT(simulation.impact().bodies()[1].account().ice_impulse.z(), -10);
  EXPECT_LT(entry.momentum_residual, 1e-10);
  EXPECT_LT(entry.energy_residual, 0.02);
}

}  // namespace
}  // namespace nilas
