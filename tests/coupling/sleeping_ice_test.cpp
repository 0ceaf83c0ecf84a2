// Ice at rest costs nothing, and a budget of wall time drops nothing.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using rigid::from_bullet;
using rigid::to_bullet;

struct Host {
  Host(const rigid::BodySpec& spec, const sph::IceSpec& ice, const HostOptions& options)
      : body(spec), plugin(ice, options) {
    world.world().addRigidBody(&body.body());
    plugin.attach(body.body(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, spec.name);
    world.world().addAction(&plugin);
  }
  ~Host() {
    world.world().removeAction(&plugin);
    world.world().removeRigidBody(&body.body());
  }
  void run(int steps, double dt) {
    for (int n = 0; n < steps; ++n) world.world().stepSimulation(to_bullet(dt), 0);
  }
  const Body& coupled() const { return plugin.impact().bodies()[0]; }

  rigid::BulletBody body;
  IcePlugin plugin;
  rigid::BulletWorld world;
};

/// On its way to the sheet: 0.3 m, 3 ms away, spinning about its axis.
rigid::BodySpec approaching() {
  rigid::BodySpec spec = test::short_hcc(60);
  spec.position -= 3e-3 * spec.velocity;
  spec.angular_velocity = spec.orientation * Vec3(0.5, 0, 20);
  return spec;
}

TEST(SleepingIce, IsNotStepped) {
  Host host(approaching(), test::small_sheet(), {});
  EXPECT_TRUE(host.plugin.impact().asleep());
  host.run(10, 1e-4);
  EXPECT_TRUE(host.plugin.last_step().asleep);
  EXPECT_EQ(host.plugin.last_step().sub_steps, 0u);
  EXPECT_EQ(host.plugin.impact().last_step().number, 0u);
  EXPECT_NEAR(host.plugin.impact().last_step().time, 1e-3, 1e-15);
  const Vec3 flown = host.coupled().state().position - approaching().position;
  EXPECT_LT((flown - 1e-3 * approaching().velocity).norm(), 1e-12);
}

// The stated bound: round-off, for ice that has never been disturbed.
TEST(SleepingIce, WakesForABodyAndGivesTheRunOfIceThatNeverSlept) {
  sph::IceSpec ice = test::small_sheet();
  ice.numerics.max_step = 5e-6 * (1 + 1e-4);  // both runs cut time alike
  Host sleeper(approaching(), ice, {}), waking(approaching(), ice, {.sleep_speed = 0});
  for (Host* host : {&sleeper, &waking}) host->run(40, 1e-4);
  EXPECT_FALSE(sleeper.plugin.impact().asleep());
  EXPECT_LT(sleeper.plugin.impact().last_step().number, waking.plugin.impact().last_step().number);
  EXPECT_GT(waking.coupled().account().ice_impulse.norm(), 100);
  EXPECT_LT((sleeper.coupled().velocity() - waking.coupled().velocity()).norm(), 1e-8 * 100);
  EXPECT_LT((sleeper.coupled().angular_velocity() - waking.coupled().angular_velocity()).norm(), 1e-8 * 20);
  EXPECT_LT((sleeper.coupled().state().position - waking.coupled().state().position).norm(), 1e-8 * 0.4);
  EXPECT_LT(sleeper.plugin.impact().ledger().momentum_residual, 1e-10);
}

/// Damped elastic ice on a fixed bottom.
sph::IceSpec soft_block() {
  sph::IceSpec ice;
  sph::PieceSpec block;
  block.shape = sph::IceShape::block;
  block.size = Vec3(0.3, 0.3, 0.3);
  block.fixed.faces[4] = true;  // the bottom
  ice.pieces = {block};
  ice.spacing = 0.03;
  ice.material.model = sph::Model::elastic;
  ice.numerics.viscosity_alpha = 2;
  return ice;
}

/// A ball that strikes the top of the block and bounces off.
rigid::BodySpec ball() {
  rigid::BodySpec spec;
  spec.name = "ball";
  spec.shape = rigid::Sphere{0.1};
  spec.boundary_spacing = 0.02;
  spec.mass = rigid::from_mass(spec.shape, 1);
  spec.position = Vec3(0, 0, 0.15 + 0.05 + 0.02);
  spec.velocity = Vec3(0, 0, -5);
  return spec;
}

TEST(SleepingIce, FallsAsleepAgainWhenItIsQuietAndAlone) {
  Host host(ball(), soft_block(), {});
  host.run(60, 1e-3);
  EXPECT_GT(host.coupled().velocity().z(), 1);  // it bounced
  EXPECT_TRUE(host.plugin.impact().asleep());
  EXPECT_LE(host.plugin.impact().ice().fastest(), HostOptions{}.sleep_speed);
  const std::size_t steps = host.plugin.impact().last_step().number;
  EXPECT_GT(steps, 100u);
  host.run(5, 1e-3);
  EXPECT_EQ(host.plugin.impact().last_step().number, steps);
  // And wakes again.
  btRigidBody& bullet = host.body.body();
  bullet.setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), to_bullet(ball().position)));
  bullet.setLinearVelocity(to_bullet(ball().velocity));
  host.run(3, 1e-3);
  EXPECT_GT(host.plugin.impact().last_step().number, steps);
  EXPECT_LT(host.plugin.impact().ledger().momentum_residual, 1e-10);
}

TEST(SleepingIce, DoesNotSleepWithAMovingBodyBesideIt) {
  rigid::BodySpec spec = ball();
  spec.velocity = Vec3(1e-6, 0, 0);
  Host host(spec, soft_block(), {});
  host.run(3, 1e-4);
  EXPECT_FALSE(host.plugin.impact().asleep());
}

TEST(SleepingIce, RestsOnGroundThatDoesNotMove) {
  rigid::BodySpec ground;
  ground.name = "ground";
  ground.shape = rigid::Box{Vec3(0.6, 0.6, 0.1)};
  ground.boundary_spacing = 0.02;
  ground.mass = rigid::from_density(ground.shape, 1000);
  ground.motion = rigid::Motion::fixed;
  ground.position = Vec3(0, 0, -0.15 - 0.05);
  sph::IceSpec ice = soft_block();
  ice.pieces[0].fixed = {};
  ice.gravity = Vec3(0, 0, -9.81);
  Host host(ground, ice, {});
  EXPECT_FALSE(host.plugin.impact().asleep());  // not yet: its weight has to come to rest
  host.run(200, 1e-3);
  EXPECT_TRUE(host.plugin.impact().asleep());
  host.body.body().setCenterOfMassTransform(
      btTransform(btQuaternion::getIdentity(), to_bullet(Vec3(ground.position - Vec3(0, 0, 0.005)))));
  host.run(1, 1e-3);
  EXPECT_FALSE(host.plugin.impact().asleep());  // the ground was taken away
}

TEST(SleepingIce, WakesWhenItsSupportIsGone) {
  rigid::BodySpec ground;
  ground.name = "ground";
  ground.shape = rigid::Box{Vec3(0.6, 0.6, 0.1)};
  ground.boundary_spacing = 0.02;
  ground.mass = rigid::from_density(ground.shape, 1000);
  ground.motion = rigid::Motion::fixed;
  ground.position = Vec3(0, 0, -0.15 - 0.05);
  sph::IceSpec ice = soft_block();
  ice.pieces[0].fixed = {};
  ice.gravity = Vec3(0, 0, -9.81);
  for (const bool moved : {true, false}) {
    Host host(ground, ice, {});
    host.run(200, 1e-3);
    ASSERT_TRUE(host.plugin.impact().asleep());
    if (moved)
      host.body.body().setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, -1000)));
    else
      host.plugin.detach(host.body.body());
    host.run(20, 1e-3);
    EXPECT_FALSE(host.plugin.impact().asleep());
    EXPECT_NEAR(host.plugin.impact().ice().mean_velocity().z(), -9.81 * 0.02, 0.02);
  }
}

TEST(SleepingIce, DoesNotSleepInMidAir) {
  sph::IceSpec ice = soft_block();
  ice.pieces[0].fixed = {};
  ice.pieces[0].size = Vec3::Constant(0.06);
  ice.spacing = 0.02;
  ice.gravity = Vec3(0, 0, -9.81);
  rigid::BodySpec far = ball();
  far.position.z() = 100;
  Host host(far, ice, {});
  host.run(20, 1e-3);
  EXPECT_NEAR(host.plugin.impact().ice().mean_velocity().z(), -9.81 * 0.02, 1e-6);
}

TEST(SleepingIce, SaysSoWhenTheHostGivesABodyWhatIsNotANumber) {
  Host host(approaching(), test::small_sheet(), {});
  host.run(1, 1e-4);
  const Vec3 position = host.coupled().state().position;
  host.body.body().setLinearVelocity(btVector3(std::numeric_limits<btScalar>::quiet_NaN(), 0, 0));
  EXPECT_THROW(host.run(1, 1e-4), sph::NumericalFailure);
  EXPECT_EQ(host.coupled().state().position, position);
  EXPECT_THROW(host.run(1, 1e-4), sph::NumericalFailure);  // and in every later step
}

TEST(Budget, OfABodyThatComesLaterIsItsOwn) {
  const rigid::BodySpec spec = approaching();
  Host host(spec, test::small_sheet(), {.sleep_speed = 0, .budget = 1e-9});
  host.run(10, 1e-4);
  EXPECT_GT(host.plugin.last_step().time_behind, 5e-4);
  rigid::BodySpec second = spec;
  second.position.y() += 5;
  rigid::BulletBody late(second);
  host.world.world().addRigidBody(&late.body());
  host.plugin.attach(late.body(), second.shape, second.boundary_spacing, second.mass.centre_of_mass, "late");
  host.run(1, 1e-4);
  EXPECT_EQ(host.plugin.impact().bodies()[1].state().position, second.position);  // its time has not come yet
  host.world.world().removeRigidBody(&late.body());
}

TEST(Budget, ThatIsSpentLeavesTheRestForLaterAndSaysSo) {
  const rigid::BodySpec spec = test::short_hcc(60);
  // A nanosecond: one sub-step per host step.
  Host host(spec, test::small_sheet(), {.sleep_speed = 0, .budget = 1e-9});
  double expected = 0;
  for (int n = 1; n <= 20; ++n) {
    host.run(1, 1e-4);
    const HostStep& step = host.plugin.last_step();
    EXPECT_EQ(step.sub_steps, 1u);
    expected += 1e-4 - host.plugin.impact().last_step().dt;
    EXPECT_NEAR(step.time_behind, expected, 1e-12);
    EXPECT_NEAR(host.plugin.impact().last_step().time + step.time_behind, n * 1e-4, 1e-12);
  }
  EXPECT_LT(host.plugin.impact().ledger().momentum_residual, 1e-10);
}

TEST(Budget, ChangesWhenIceAndBodyMoveAndNotHow) {
  const rigid::BodySpec spec = test::short_hcc(60);
  sph::IceSpec ice = test::small_sheet();
  ice.numerics.max_step = 5e-6 * (1 + 1e-4);
  Host slow(spec, ice, {.sleep_speed = 0, .budget = 1e-9}), free(spec, ice, {.sleep_speed = 0});
  for (Host* host : {&slow, &free}) host->body.body().setGravity(btVector3(0, 0, -1000));
  free.run(3, 1e-4);
  slow.run(60, 1e-4);  // one sub-step of 5 us in each
  EXPECT_NEAR(slow.plugin.impact().last_step().time, free.plugin.impact().last_step().time, 1e-12);
  EXPECT_LT((slow.coupled().velocity() - free.coupled().velocity()).norm(), 1e-9 * 100);
  EXPECT_LT((slow.coupled().state().position - free.coupled().state().position).norm(), 1e-9 * 0.03);
  EXPECT_GT(free.coupled().account().ice_impulse.norm(), 50);
}

TEST(Budget, ThatSufficesLeavesNothingBehind) {
  Host host(test::short_hcc(60), test::small_sheet(), {.sleep_speed = 0, .budget = 1e3});
  host.run(5, 1e-4);
  EXPECT_EQ(host.plugin.last_step().time_behind, 0);
  EXPECT_GT(host.plugin.last_step().sub_steps, 5u);
}

}  // namespace
}  // namespace nilas
