// What a host may do with its bodies while they are attached.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using rigid::from_bullet;
using rigid::Motion;
using rigid::Quat;
using rigid::to_bullet;

constexpr double kStep = 1e-4;  // s, of the host

/// A world with ice and, for a start, one attached body.
struct Host {
  explicit Host(const rigid::BodySpec& spec, const sph::IceSpec& ice = test::small_sheet(),
                const HostOptions& options = {.sleep_speed = 0})
      : body(std::make_unique<rigid::BulletBody>(spec)), plugin(ice, options) {
    world.world().addRigidBody(&bullet());
    plugin.attach(bullet(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, spec.name);
    world.world().addAction(&plugin);
  }
  ~Host() {
    world.world().removeAction(&plugin);
    if (body) world.world().removeRigidBody(&bullet());
  }
  btRigidBody& bullet() { return body->body(); }
  void run(int steps) {
    for (int n = 0; n < steps; ++n) world.world().stepSimulation(to_bullet(kStep), 0);
  }
  const Body& coupled() const { return plugin.impact().bodies()[0]; }
  double residual() { return plugin.impact().ledger().momentum_residual; }
  void put(const Vec3& position) {
    btTransform pose = bullet().getCenterOfMassTransform();
    pose.setOrigin(to_bullet(position));
    bullet().setCenterOfMassTransform(pose);
  }

  std::unique_ptr<rigid::BulletBody> body;
  IcePlugin plugin;
  rigid::BulletWorld world;
};

/// At rest well below the sheet.
rigid::BodySpec waiting() {
  rigid::BodySpec spec = test::short_hcc(90);
  spec.velocity = Vec3::Zero();
  spec.position.z() -= 1;
  return spec;
}

// The collision shape of rigid::BulletBody is a compound about the centre of mass.
TEST(OwnShapes, AreWhatTheIceMeets) {
  rigid::BodySpec spec = test::short_hcc(90);
  spec.shape = rigid::Capsule{0.6, 0.3};
  spec.mass = rigid::from_density(spec.shape, 900);
  spec.position = Vec3(0, 0, -0.15 - 0.02 - 0.3);
  const auto run = [&](bool own) {
    rigid::BulletBody body(spec);
    rigid::BulletWorld world;
    IcePlugin plugin(test::small_sheet(), HostOptions{.sleep_speed = 0});
    world.world().addRigidBody(&body.body());
    if (own)
      plugin.attach(body.body(), 0.02);
    else
      plugin.attach(body.body(), spec.shape, 0.02);
    world.world().addAction(&plugin);
    for (int n = 0; n < 8; ++n) world.world().stepSimulation(to_bullet(kStep), 0);
    world.world().removeAction(&plugin);
    world.world().removeRigidBody(&body.body());
    return plugin.impact().bodies()[0].velocity();
  };
  const Vec3 own = run(true), given = run(false);
  EXPECT_LT(given.z(), 99.5);
  EXPECT_LT((own - given).norm(), 1e-9 * 100);
}

TEST(LateBodies, MeetTheIceFromWhenTheyAreAttached) {
  Host host(waiting());
  host.run(3);
  const rigid::BodySpec spec = test::short_hcc(60);
  rigid::BulletBody late(spec);
  host.world.world().addRigidBody(&late.body());
  EXPECT_EQ(host.plugin.attach(late.body(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, "late"), 1u);
  host.run(10);
  EXPECT_GT(host.plugin.impact().bodies()[1].account().ice_impulse.norm(), 100);
  EXPECT_LT(host.residual(), 1e-10);
  host.world.world().removeRigidBody(&late.body());
}

TEST(LateBodies, GiveTheRunOfABodyThatWasThereFromTheStart) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Host early(spec);
  early.run(10);
  Host host(waiting());
  host.run(3);
  rigid::BulletBody late(spec);
  host.world.world().addRigidBody(&late.body());
  host.plugin.attach(late.body(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, "late");
  host.run(10);
  EXPECT_LT((host.plugin.impact().bodies()[1].velocity() - early.coupled().velocity()).norm(), 1e-10 * 100);
  host.world.world().removeRigidBody(&late.body());
}

TEST(LateBodies, CannotBeAttachedTwice) {
  Host host(waiting());
  EXPECT_THROW(host.plugin.attach(host.bullet(), rigid::Sphere{0.2}, 0.05), std::invalid_argument);
}

TEST(RemovedBodies, AreNotTouchedAndStayAsTheyWere) {
  Host host(test::short_hcc(60));
  host.run(5);
  const Vec3 position = host.coupled().state().position, loaded = host.coupled().account().ice_impulse;
  host.world.world().removeRigidBody(&host.bullet());
  host.body.reset();  // an address sanitizer would see any access
  host.run(5);
  EXPECT_EQ(host.plugin.presence(0), Presence::away);
  EXPECT_EQ(host.coupled().state().position, position);
  EXPECT_EQ(host.coupled().account().ice_impulse, loaded);
  EXPECT_LT(host.residual(), 1e-10);
}

TEST(RemovedBodies, MayComeBackWhereverTheHostPutsThem) {
  Host host(waiting());
  host.run(2);
  host.world.world().removeRigidBody(&host.bullet());
  host.run(2);
  EXPECT_EQ(host.plugin.presence(0), Presence::away);
  const rigid::BodySpec strike = test::short_hcc(60);
  host.bullet().setCenterOfMassTransform(btTransform(to_bullet(strike.orientation), to_bullet(strike.position)));
  host.bullet().setLinearVelocity(to_bullet(strike.velocity));
  host.world.world().addRigidBody(&host.bullet());
  host.run(8);
  EXPECT_EQ(host.plugin.presence(0), Presence::felt);
  EXPECT_GT(host.coupled().account().ice_impulse.norm(), 100);
  EXPECT_LT(host.residual(), 1e-10);
}

TEST(DetachedBodies, AreGivenBackAsTheirHostHadThem) {
  const rigid::BodySpec spec = waiting();
  rigid::BulletBody source(spec);
  btRigidBody body(spec.mass.mass, nullptr, source.body().getCollisionShape(), to_bullet(spec.mass.inertia));
  body.setActivationState(ACTIVE_TAG);
  const int flags = body.getFlags();
  IcePlugin plugin(test::ice_out_of_reach());
  plugin.attach(body, spec.shape);
  EXPECT_NE(body.getFlags(), flags);
  plugin.detach(body);
  EXPECT_EQ(body.getFlags(), flags);
  EXPECT_EQ(body.getActivationState(), ACTIVE_TAG);
  EXPECT_THROW(plugin.detach(body), std::invalid_argument);
  plugin.attach(body, spec.shape);  // and may come back
}

TEST(Displacements, OfLessThanAQuarterSpacingAreAPush) {
  Host host(test::short_hcc(60));
  host.run(3);
  host.put(host.coupled().state().position + Vec3(0, 0, 0.006));
  host.run(1);
  EXPECT_EQ(host.plugin.presence(0), Presence::felt);
  EXPECT_LT(host.residual(), 1e-10);
}

TEST(Displacements, IntoTheIceAreNotFeltUntilTheBodyIsClearOfIt) {
  rigid::BodySpec spec = waiting();
  Host host(spec);
  host.run(2);
  host.put(Vec3::Zero());  // into the middle of the sheet
  host.bullet().setLinearVelocity(btVector3(0, 0, -200));
  host.run(2);
  EXPECT_EQ(host.plugin.presence(0), Presence::unfelt);
  EXPECT_TRUE(host.coupled().account().ice_impulse.isZero(0));
  EXPECT_EQ(host.plugin.impact().ice().fastest(), 0);
  host.run(60);  // 12 mm per ms: out below
  EXPECT_EQ(host.plugin.presence(0), Presence::felt);
  EXPECT_TRUE(host.coupled().account().ice_impulse.isZero(0));
  EXPECT_LT(host.residual(), 1e-10);
}

TEST(Displacements, InTheOpenAreTakenAtOnce) {
  Host host(waiting());
  host.run(2);
  const rigid::BodySpec strike = test::short_hcc(60);
  host.bullet().setCenterOfMassTransform(btTransform(to_bullet(strike.orientation), to_bullet(strike.position)));
  host.bullet().setLinearVelocity(to_bullet(strike.velocity));
  host.run(8);
  EXPECT_EQ(host.plugin.presence(0), Presence::felt);
  EXPECT_GT(host.coupled().account().ice_impulse.norm(), 100);
  EXPECT_LT(host.residual(), 1e-10);
}

TEST(ChangedBodies, HaveTheMassAndInertiaOfNow) {
  Host host(test::short_hcc(60));
  host.run(4);
  const Vec3 velocity = host.coupled().velocity(), spin = host.coupled().angular_velocity();
  const double mass = host.coupled().spec().mass.mass;
  const Vec3 inertia = host.coupled().spec().mass.inertia;
  host.bullet().setMassProps(to_bullet(3 * mass), to_bullet(Vec3(4 * inertia)));
  host.bullet().updateInertiaTensor();
  const Vec3 before = host.coupled().account().ice_impulse, booked = host.coupled().account().external_impulse;
  host.run(1);
  const double eps = 16 * std::numeric_limits<btScalar>::epsilon();
  EXPECT_NEAR(host.coupled().spec().mass.mass, 3 * mass, eps * mass);
  EXPECT_LT((host.coupled().spec().mass.inertia - 4 * inertia).norm(), eps * inertia.norm());
  EXPECT_LT(
      (host.coupled().velocity() - velocity - (host.coupled().account().ice_impulse - before) / (3 * mass)).norm(),
      eps * 100);
  EXPECT_LT((host.coupled().account().external_impulse - booked - 2 * mass * velocity).norm(), eps * mass * 100);
  EXPECT_LT((host.coupled().angular_velocity() - spin).norm(), 1);
  host.run(4);
  EXPECT_LT(host.residual(), 1e-10);
}

TEST(ChangedBodies, KeepToLocksThatComeLater) {
  Host host(test::short_hcc(60));
  host.run(4);
  host.bullet().setLinearFactor(btVector3(0, 1, 1));
  host.bullet().setAngularFactor(btVector3(0, 0, 0));
  const Vec3 spin = host.coupled().angular_velocity();
  const double across = host.coupled().velocity().x();
  host.run(4);
  EXPECT_EQ(host.coupled().velocity().x(), across);
  EXPECT_LT((host.coupled().angular_velocity() - spin).norm(), 1e-12);
  EXPECT_LT(host.residual(), 1e-10);
}

TEST(ChangedBodies, MayBecomeStaticAndDynamicAgain) {
  Host host(test::short_hcc(60));
  host.run(4);
  const double mass = host.coupled().spec().mass.mass;
  const btVector3 inertia = to_bullet(host.coupled().spec().mass.inertia);
  host.bullet().setMassProps(0, btVector3(0, 0, 0));
  const Vec3 position = from_bullet(host.bullet().getCenterOfMassTransform().getOrigin());
  host.run(3);
  EXPECT_EQ(host.coupled().state().position, position);
  EXPECT_TRUE(host.coupled().velocity().isZero(0));
  host.bullet().setMassProps(to_bullet(mass), inertia);
  host.bullet().updateInertiaTensor();
  host.bullet().setLinearVelocity(btVector3(0, 0, 50));
  host.run(3);
  EXPECT_GT(host.coupled().velocity().z(), 30);
  EXPECT_LT(host.residual(), 1e-10);
}

TEST(DisabledBodies, StandWhereTheyAreAndTakeTheLoad) {
  Host host(test::short_hcc(60));
  host.run(4);
  const Vec3 position = host.coupled().state().position;
  host.bullet().forceActivationState(DISABLE_SIMULATION);
  host.run(4);
  EXPECT_EQ(host.coupled().state().position, position);
  host.bullet().forceActivationState(DISABLE_DEACTIVATION);
  host.run(2);
  EXPECT_GT((host.coupled().state().position - position).norm(), 1e-3);  // with the velocity that Bullet kept
  EXPECT_LT(host.residual(), 1e-10);
}

TEST(DisabledBodies, MayBeAttachedAsTheyAre) {
  const rigid::BodySpec spec = test::short_hcc(60);
  rigid::BulletBody body(spec);
  body.body().forceActivationState(DISABLE_SIMULATION);
  rigid::BulletWorld world;
  IcePlugin plugin(test::small_sheet(), HostOptions{.sleep_speed = 0});
  world.world().addRigidBody(&body.body());
  plugin.attach(body.body(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, spec.name);
  world.world().addAction(&plugin);
  for (int n = 0; n < 5; ++n) world.world().stepSimulation(to_bullet(kStep), 0);
  EXPECT_EQ(plugin.impact().bodies()[0].state().position, spec.position);
  EXPECT_EQ(from_bullet(body.body().getLinearVelocity()), spec.velocity);
  world.world().removeAction(&plugin);
  world.world().removeRigidBody(&body.body());
}

TEST(SleepingBodies, AreWokenByIceThatPressesOnThem) {
  sph::IceSpec ice = test::small_sheet();
  ice.pieces[0].velocity = Vec3(0, 0, -60);
  rigid::BodySpec spec = test::short_hcc(90);
  spec.velocity = Vec3::Zero();
  Host host(spec, ice);
  host.bullet().forceActivationState(ISLAND_SLEEPING);
  host.run(10);
  EXPECT_TRUE(host.bullet().isActive());
  EXPECT_LT(host.coupled().velocity().z(), -1);
  EXPECT_LT(host.residual(), 1e-10);
}

/// A plate of Bullet's that its host moves as it likes.
rigid::BodySpec plate() {
  rigid::BodySpec spec;
  spec.name = "plate";
  spec.shape = rigid::Box{Vec3(0.8, 0.8, 0.1)};
  spec.boundary_spacing = 0.02;
  spec.mass = rigid::from_density(spec.shape, 1000);
  spec.motion = Motion::fixed;
  spec.position = Vec3(0, 0, -0.15 - 0.05 - 0.02);
  return spec;
}

TEST(KinematicBodies, PushTheIceAlongTheirPath) {
  for (const int steps_per_call : {1, 4}) {
    Host host(plate());
    host.bullet().setCollisionFlags(host.bullet().getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    const Vec3 start = host.coupled().state().position;
    const double speed = 40;
    for (int n = 1; n <= 8; ++n) {
      host.put(start + n * steps_per_call * kStep * speed * Vec3::UnitZ());
      host.world.world().stepSimulation(to_bullet(steps_per_call * kStep), steps_per_call, to_bullet(kStep));
    }
    const double time = 8 * steps_per_call * kStep;
    EXPECT_LT((host.coupled().state().position - start - time * speed * Vec3::UnitZ()).norm(), 1e-9);
    EXPECT_NEAR(host.coupled().velocity().z(), speed, 1e-6);
    EXPECT_EQ(host.plugin.presence(0), Presence::felt);
    // The ice is carried along: at most as fast as an elastic collision makes it.
    const double carried = host.plugin.impact().ice().mean_velocity().z();
    EXPECT_GT(carried, 2);
    EXPECT_LT(carried, 2 * speed);
    EXPECT_LT(host.residual(), 1e-10);
  }
}

TEST(StaticBodies, MayBeMovedByHand) {
  rigid::BodySpec spec = plate();
  Host host(spec);
  host.run(1);
  const Vec3 there(0, 0, -3);
  host.put(there);
  host.run(1);
  EXPECT_EQ(host.coupled().state().position, there);
  EXPECT_TRUE(host.coupled().velocity().isZero(0));
  EXPECT_LT(host.residual(), 1e-10);
}

}  // namespace
}  // namespace nilas
