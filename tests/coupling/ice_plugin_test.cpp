#include "coupling/ice_plugin.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using rigid::from_bullet;
using rigid::Motion;
using rigid::Quat;
using rigid::to_bullet;

constexpr double kEnd = 1e-3;  // s, a whole number of all host steps below

/// A host's world with one attached body; more bodies and constraints are the host's own.
class Host {
 public:
  Host(const sph::IceSpec& ice, const rigid::BodySpec& spec)
      : body_(spec), plugin_(ice, HostOptions{.sleep_speed = 0}) {
    world().addRigidBody(&body());
    plugin_.attach(body(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, spec.name);
    world().addAction(&plugin_);
  }
  ~Host() {
    world().removeAction(&plugin_);
    for (const auto& joint : joints_) world().removeConstraint(joint.get());
    for (const auto& other : others_) world().removeRigidBody(&other->body());
    world().removeRigidBody(&body());
  }

  btDiscreteDynamicsWorld& world() { return world_.world(); }
  btRigidBody& body() { return body_.body(); }
  Impact& impact() { return plugin_.impact(); }
  const Body& coupled() { return impact().bodies()[0]; }

  /// A body that only Bullet knows.
  btRigidBody& add(const rigid::BodySpec& spec) {
    others_.push_back(std::make_unique<rigid::BulletBody>(spec));
    world().addRigidBody(&others_.back()->body());
    return others_.back()->body();
  }
  /// A second body that the ice meets.
  btRigidBody& attach(const rigid::BodySpec& spec) {
    btRigidBody& bullet = add(spec);
    plugin_.attach(bullet, spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, spec.name);
    return bullet;
  }
  void join(btRigidBody& other, const btVector3& pivot_world) {
    const btVector3 a = body().getCenterOfMassTransform().inverse() * pivot_world;
    const btVector3 b = other.getCenterOfMassTransform().inverse() * pivot_world;
    joints_.push_back(std::make_unique<btPoint2PointConstraint>(body(), other, a, b));
    world().addConstraint(joints_.back().get());
  }
  void step(double dt) { world().stepSimulation(dt, 0); }
  void run(double time, double dt) {
    for (int n = 0; n < std::lround(time / dt); ++n) step(dt);
  }
  /// Of ice, coupled body and the host's own bodies, as their owners state it.
  Vec3 momentum() {
    Vec3 p = impact().ice().ledger().momentum + from_bullet(body().getLinearVelocity()) / body().getInvMass();
    for (const auto& other : others_)
      if (other->body().getInvMass() > 0)
        p += from_bullet(other->body().getLinearVelocity()) / other->body().getInvMass();
    return p;
  }

 private:
  rigid::BulletBody body_;
  IcePlugin plugin_;
  std::vector<std::unique_ptr<rigid::BulletBody>> others_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
  rigid::BulletWorld world_;
};

/// The small sheet with a step that divides all of the host's: every host then cuts time in the same sub-steps.
sph::IceSpec evenly_cut_sheet() {
  sph::IceSpec ice = test::small_sheet();
  ice.numerics.max_step = 5e-6 * (1 + 1e-4);
  return ice;
}

struct Outcome {
  Vec3 velocity, position, angular_velocity;
  Quat orientation;
};
Outcome outcome(const Body& b) {
  return {b.velocity(), b.state().position, b.angular_velocity(), b.state().orientation};
}
Outcome outcome(const btRigidBody& b) {
  return {from_bullet(b.getLinearVelocity()), from_bullet(b.getCenterOfMassTransform().getOrigin()),
          from_bullet(b.getAngularVelocity()), from_bullet(b.getCenterOfMassTransform().getRotation())};
}

/// Differences as fractions of the impact's speed, the body's travel and its spin.
double difference(const Outcome& a, const Outcome& b) {
  return std::max({(a.velocity - b.velocity).norm() / 100, (a.position - b.position).norm() / 0.1,
                   (a.angular_velocity - b.angular_velocity).norm() / 10,
                   a.orientation.angularDistance(b.orientation)});
}

/// A loose sphere of the host's, 50 kg.
rigid::BodySpec loose_sphere(const Vec3& position, const Vec3& velocity) {
  rigid::BodySpec spec;
  spec.name = "loose";
  spec.shape = rigid::Sphere{0.2};
  spec.boundary_spacing = 0.02;
  spec.mass = rigid::from_mass(spec.shape, 50);
  spec.position = position;
  spec.velocity = velocity;
  return spec;
}

const double kHostSteps[] = {1e-3, 1e-4, 1e-5};

TEST(Hosting, GivesTheStandAloneResultAtAnyHostStep) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Impact alone(evenly_cut_sheet(), {Body(spec)});
  alone.advance(kEnd);
  EXPECT_GT(alone.bodies()[0].angular_velocity().norm(), 1);
  for (const double dt : kHostSteps) {
    Host host(evenly_cut_sheet(), spec);
    host.run(kEnd, dt);
    EXPECT_NEAR(host.impact().last_step().time, kEnd, 1e-15);
    EXPECT_LT(difference(outcome(host.body()), outcome(alone.bodies()[0])), 1e-10) << dt;
    EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10) << dt;
    // Bullet's round-off is not taken for something that the host did.
    EXPECT_TRUE(host.coupled().account().external_impulse.isZero(0)) << dt;
    EXPECT_TRUE(host.coupled().account().external_angular_impulse.isZero(0)) << dt;
  }
}

TEST(Hosting, IsTheSameHoweverTheHostCallsStepSimulation) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Host variable(test::small_sheet(), spec), single(test::small_sheet(), spec);
  for (int n = 0; n < 10; ++n) {
    variable.world().stepSimulation(1e-4, 0);
    single.world().stepSimulation(1e-4, 1, 1e-4);
  }
  EXPECT_EQ(difference(outcome(variable.body()), outcome(single.body())), 0);
  EXPECT_NEAR(variable.impact().last_step().time, 1e-3, 1e-15);
}

TEST(Hosting, TrustsOnlyTheTimeThatBulletSimulates) {
  rigid::BodySpec spec = test::short_hcc(60);
  spec.velocity = Vec3::Zero();
  Host host(test::ice_out_of_reach(), spec);
  host.world().setGravity(btVector3(0, 0, -9.81));
  host.body().setGravity(btVector3(0, 0, -9.81));
  // 1/60 s makes four fixed steps; then half a step is left waiting, then caught up.
  host.world().stepSimulation(1. / 60, 10, 1. / 240);
  EXPECT_NEAR(host.impact().last_step().time, 4. / 240, 1e-14);
  host.world().stepSimulation(0.5 / 240, 10, 1. / 240);
  EXPECT_NEAR(host.impact().last_step().time, 4. / 240, 1e-14);
  host.world().stepSimulation(0.5 / 240 + 1e-9, 10, 1. / 240);
  EXPECT_NEAR(host.impact().last_step().time, 5. / 240, 1e-14);
  // More than ten steps are dropped by Bullet.
  host.world().stepSimulation(0.1, 10, 1. / 240);
  const double time = host.impact().last_step().time;
  EXPECT_NEAR(time, 15. / 240, 1e-14);
  EXPECT_NEAR(host.body().getLinearVelocity().z(), -9.81 * time, 1e-12);
  EXPECT_NEAR(host.coupled().state().position.z() - spec.position.z(), -0.5 * 9.81 * time * time, 1e-12);
}

TEST(Hosting, KeepsBulletsPoseAndVelocitiesThoseOfTheCoupledBody) {
  Host host(test::small_sheet(), test::short_hcc(60));
  host.run(5e-4, 1e-4);
  EXPECT_LT(difference(outcome(host.body()), outcome(host.coupled())), 1e-14);
  const btTransform& seen = host.body().getInterpolationWorldTransform();
  EXPECT_EQ(from_bullet(seen.getOrigin()), host.coupled().state().position);
  EXPECT_EQ(from_bullet(host.body().getInterpolationLinearVelocity()), host.coupled().velocity());
}

// What the host does is respected, and the books of ice, body, other bodies and host close.

TEST(Hosting, IceIsAsSoftAsItsSpecSays) {
  sph::IceSpec ice = test::ice_out_of_reach();
  const IcePlugin stated(ice);
  ice.numerics.sound_speed_scale = 0.5;
  const IcePlugin soft(ice);
  EXPECT_NEAR(soft.impact().stable_step().dt / stated.impact().stable_step().dt, 2, 1e-12);
  ice.numerics.sound_speed_scale = 2;
  EXPECT_THROW(IcePlugin{ice}, std::invalid_argument);
}

TEST(HostInfluence, AConstantForceGivesItsImpulse) {
  const Vec3 force(2e5, 1e5, -3e5);
  for (const double dt : {1e-3, 1e-4}) {
    Host host(test::small_sheet(), test::short_hcc(60));
    const Vec3 before = host.momentum();
    for (int n = 0; n < std::lround(kEnd / dt); ++n) {
      host.body().applyCentralForce(to_bullet(force));
      host.step(dt);
    }
    EXPECT_LT((host.momentum() - before - kEnd * force).norm(), 1e-10 * before.norm()) << dt;
    EXPECT_LT((host.coupled().account().external_impulse - kEnd * force).norm(), 1e-10 * before.norm());
    EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10) << dt;
  }
}

TEST(HostInfluence, GravityAndAForceGiveTheStandAloneResultAtAnyHostStep) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const Vec3 gravity(0, 0, -9810), force(2e5, 1e5, 0), torque(-2e3, 1e3, 4e3);
  Impact alone(evenly_cut_sheet(), {Body(spec)});
  alone.advance(kEnd, {{spec.mass.mass * gravity + force, torque}});
  for (const double dt : kHostSteps) {
    Host host(evenly_cut_sheet(), spec);
    host.body().setGravity(to_bullet(gravity));
    for (int n = 0; n < std::lround(kEnd / dt); ++n) {
      host.body().applyCentralForce(to_bullet(force));
      host.body().applyTorque(to_bullet(torque));
      host.step(dt);
    }
    EXPECT_LT(difference(outcome(host.body()), outcome(alone.bodies()[0])), 1e-10) << dt;
    EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10) << dt;
  }
}

TEST(HostInfluence, BulletsDampingActsAsInFreeFlight) {
  rigid::BodySpec spec = test::short_hcc(60);
  spec.angular_velocity = spec.orientation * Vec3(0, 0, 5);
  Host host(test::ice_out_of_reach(), spec);
  host.body().setDamping(0.9, 0.5);
  const double time = 0.05;
  host.run(time, 1e-3);
  // btRigidBody::applyDamping: v (1 - d)^dt in every step.
  EXPECT_LT((host.coupled().velocity() - std::pow(0.1, time) * spec.velocity).norm(), 1e-12 * 100);
  EXPECT_LT((host.coupled().angular_velocity() - std::pow(0.5, time) * spec.angular_velocity).norm(), 1e-12 * 5);
}

TEST(HostInfluence, DampingDuringAnImpactIsBookedAndConvergesWithTheHostsStep) {
  // The impulse that damping takes. (The end state is no measure of the order: where ice fails particle by particle,
  // the smallest change of the path changes which.)
  const auto taken = [](double dt) {
    Host host(evenly_cut_sheet(), test::short_hcc(60));
    host.body().setDamping(0.99999, 0.99999);
    const Vec3 before = host.momentum();
    host.run(kEnd, dt);
    const Vec3 impulse = host.coupled().account().external_impulse;
    EXPECT_LT((host.momentum() - before - impulse).norm(), 1e-10 * before.norm()) << dt;
    // v falls as exp(ln(1 - d) t): about 1.1 % in a millisecond, of a velocity that the ice lowers by some per cent.
    EXPECT_NEAR(impulse.norm() / before.norm(), -std::log(1e-5) * kEnd, 0.1 * -std::log(1e-5) * kEnd) << dt;
    return impulse;
  };
  const Vec3 reference = taken(1e-5);
  const double coarse = (taken(1e-3) - reference).norm(), fine = (taken(1e-4) - reference).norm();
  EXPECT_LT(fine, coarse / 5);  // first order: a tenth
}

TEST(HostInfluence, AnImpulseBetweenStepsIsTakenAtOnce) {
  Host host(test::small_sheet(), test::short_hcc(60));
  const Vec3 before = host.momentum(), impulse(40, -30, 20);
  host.run(5e-4, 1e-4);
  host.body().applyImpulse(to_bullet(impulse), btVector3(0, 0.1, -0.2));
  host.run(5e-4, 1e-4);
  EXPECT_LT((host.momentum() - before - impulse).norm(), 1e-10 * before.norm());
  EXPECT_LT((host.coupled().account().external_impulse - impulse).norm(), 1e-10 * before.norm());
  EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10);
}

TEST(HostInfluence, ManySmallImpulsesAreNotTakenForRoundOff) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Host host(test::ice_out_of_reach(), spec);
  const Vec3 before = host.momentum(), impulse = 1e-11 * before.norm() * Vec3(1, 2, -2) / 3;
  for (int n = 0; n < 1000; ++n) {
    host.body().applyCentralImpulse(to_bullet(impulse));
    host.step(1e-5);
  }
  // 1000 times the velocity is rounded by Bullet and by the mass that multiplies it.
  EXPECT_LT((host.momentum() - before - 1000 * impulse).norm(), 1000 * 2.3e-16 * before.norm());
}

TEST(HostInfluence, AnOffCentreImpulseInFreeFlightTurnsTheBody) {
  rigid::BodySpec spec = test::short_hcc(60);
  Host host(test::ice_out_of_reach(), spec);
  host.run(3e-3, 1e-3);
  const Vec3 impulse(40, -30, 20), lever(0, 0.1, -0.2);
  const rigid::State before = host.coupled().state();
  host.body().applyImpulse(to_bullet(impulse), to_bullet(lever));
  host.run(3e-3, 1e-3);
  const rigid::State& after = host.coupled().state();
  EXPECT_LT((after.momentum - before.momentum - impulse).norm(), 1e-12 * before.momentum.norm());
  EXPECT_LT((after.angular_momentum - before.angular_momentum - lever.cross(impulse)).norm(), 1e-12);
  EXPECT_LT((after.position - before.position - 3e-3 * after.momentum / spec.mass.mass).norm(), 1e-13);
}

TEST(HostInfluence, AVelocityOrAPoseThatTheHostSetsIsTaken) {
  rigid::BodySpec spec = test::short_hcc(60);
  Host host(test::ice_out_of_reach(), spec);
  host.run(3e-3, 1e-3);
  const Vec3 place(1, 2, 3), velocity(-4, 5, 6), spin(1, -2, 3);
  const Quat attitude(Eigen::AngleAxisd(2.0, Vec3(1, -1, 2).normalized()));
  host.body().setWorldTransform(btTransform(to_bullet(attitude), to_bullet(place)));
  host.body().updateInertiaTensor();
  host.body().setLinearVelocity(to_bullet(velocity));
  host.body().setAngularVelocity(to_bullet(spin));

  rigid::State state{place, attitude, spec.mass.mass * velocity,
                     rigid::angular_momentum_world(attitude, spec.mass.inertia, spin)};
  rigid::drift(state, spec.mass.mass, spec.mass.inertia, 1e-3);
  host.step(1e-3);
  const rigid::State& now = host.coupled().state();
  EXPECT_LT((now.position - state.position).norm(), 1e-12);
  EXPECT_LT((now.momentum - state.momentum).norm(), 1e-10);
  EXPECT_LT(now.orientation.angularDistance(state.orientation), 1e-7);  // acos near one
  EXPECT_LT((now.orientation * Vec3::UnitZ() - state.orientation * Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((now.angular_momentum - state.angular_momentum).norm(), 1e-10);
}

TEST(HostInfluence, AContactWithAnotherBodyClosesTheMomentum) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const Vec3 axis = test::heading(60);
  const Vec3 tail = spec.position + spec.orientation * (Vec3(0, 0, -0.6) - spec.mass.centre_of_mass);
  for (const double dt : {1e-4, 1e-5}) {
    Host host(test::small_sheet(), spec);
    btRigidBody& hammer = host.add(loose_sphere(tail - 0.11 * axis + Vec3(0.03, 0, 0), 180 * axis));
    const Vec3 before = host.momentum();
    host.run(kEnd, dt);
    EXPECT_LT(hammer.getLinearVelocity().length(), 170) << dt;  // it struck
    EXPECT_LT((host.momentum() - before).norm(), 1e-10 * before.norm()) << dt;
    EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10) << dt;
  }
}

TEST(HostInfluence, AJointToAnotherBodyClosesTheMomentumAndConvergesWithTheHostsStep) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const Vec3 axis = test::heading(60);
  const Vec3 pivot = spec.position + spec.orientation * (Vec3(0, 0, -0.8) - spec.mass.centre_of_mass);
  const auto run = [&](double dt) {
    Host host(evenly_cut_sheet(), spec);
    btRigidBody& trailer = host.add(loose_sphere(pivot - 0.3 * axis, spec.velocity));
    host.join(trailer, to_bullet(pivot));
    const Vec3 before = host.momentum();
    host.run(kEnd, dt);
    EXPECT_LT((host.momentum() - before).norm(), 1e-10 * before.norm()) << dt;
    EXPECT_GT((from_bullet(trailer.getLinearVelocity()) - spec.velocity).norm(), 0.5) << dt;  // it was pushed
    const Outcome a = outcome(host.body()), b = outcome(trailer);
    const Vec3 gap = a.position + a.orientation * (Vec3(0, 0, -0.8) - spec.mass.centre_of_mass) - b.position -
                     b.orientation * (0.3 * axis);
    return std::pair(a, gap.norm());
  };
  const auto [reference, closed] = run(1e-5);
  const auto [coarse, open] = run(2.5e-4);
  const auto [fine, narrow] = run(5e-5);
  EXPECT_LT((fine.velocity - reference.velocity).norm(), (coarse.velocity - reference.velocity).norm() / 3);
  EXPECT_LT((fine.position - reference.position).norm(), (coarse.position - reference.position).norm() / 3);
  EXPECT_LT(narrow, open / 3);
  EXPECT_LT(closed, narrow);
}

/// A wall across the far side of the sheet, 1 mm away.
rigid::BodySpec wall(Motion motion) {
  rigid::BodySpec spec;
  spec.name = "wall";
  spec.shape = rigid::Box{Vec3(0.9, 0.9, 0.1)};
  spec.boundary_spacing = 0.02;
  spec.mass = rigid::from_density(spec.shape, 2000);
  spec.motion = motion;
  spec.position = Vec3(0, 0, 0.15 + 0.001 + 0.05);
  return spec;
}

TEST(HostInfluence, AWallBehindTheIceTakesItsShareAtAnyHostStep) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const auto run = [&](double dt, Motion motion) {
    Host host(evenly_cut_sheet(), spec);
    btRigidBody& behind = host.attach(wall(motion));
    const Vec3 before = host.momentum();
    host.run(kEnd, dt);
    const Body& coupled = host.impact().bodies()[1];
    const Vec3 constraint = coupled.account().external_impulse;  // what holds a static wall
    EXPECT_LT((host.momentum() - before - constraint).norm(), 1e-10 * before.norm()) << dt;
    EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10) << dt;
    EXPECT_GT(coupled.account().ice_impulse.z(), 10) << dt;
    EXPECT_EQ(behind.getLinearVelocity().z() > 0.05, motion == Motion::free) << dt;
    return outcome(host.body());
  };
  for (const Motion motion : {Motion::fixed, Motion::free}) {
    const Outcome at_the_ices_step = run(5e-6, motion);
    for (const double dt : {1e-3, 1e-4}) EXPECT_LT(difference(run(dt, motion), at_the_ices_step), 1e-9) << dt;
  }
}

// V39, at a step at which Bullet's own gyroscopic term would have damped the nutation away.
TEST(AttachedBodies, SpinFreelyAsTheSymmetricTopInClosedForm) {
  rigid::BodySpec spec = test::short_hcc(90);
  spec.shape = rigid::Hcc{1.8, 0.3, 0.2};
  spec.boundary_spacing = 0.1;
  spec.mass = rigid::from_density(spec.shape, 1500);
  spec.velocity = Vec3::Zero();
  spec.angular_velocity = Vec3(1, 0, 100);
  sph::IceSpec ice = test::ice_out_of_reach();
  ice.pieces[0].size *= 10;
  ice.spacing *= 10;
  Host host(ice, spec);
  for (int n = 0; n < 240; ++n) host.step(1. / 240);
  EXPECT_EQ(host.body().getFlags(), 0);
  const double rate = (spec.mass.inertia.x() - spec.mass.inertia.z()) / spec.mass.inertia.x() * 100;
  const Outcome end = outcome(host.body());
  const Vec3 in_body = end.orientation.conjugate() * end.angular_velocity;
  EXPECT_LT((in_body - Vec3(std::cos(rate), -std::sin(rate), 100)).norm(), 1e-8);
}

TEST(AttachedBodies, LoseTheirGyroscopicFlagAndStayAwake) {
  btSphereShape shape(0.1);
  btRigidBody body(10, nullptr, &shape, btVector3(1, 1, 1));
  ASSERT_NE(body.getFlags() & BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY, 0);
  body.setFlags(body.getFlags() | BT_DISABLE_WORLD_GRAVITY);
  IcePlugin plugin(test::ice_out_of_reach());
  plugin.attach(body, rigid::Sphere{0.2}, 0.05);
  EXPECT_EQ(body.getFlags(), BT_DISABLE_WORLD_GRAVITY);
  EXPECT_EQ(body.getActivationState(), DISABLE_DEACTIVATION);
}

TEST(AttachedBodies, AStaticBodyHoldsTheIceAndStaysWhereItIs) {
  rigid::BodySpec spec = test::short_hcc(90, Motion::fixed);
  spec.boundary_spacing = 0.03;
  sph::IceSpec ice = test::small_sheet();
  ice.pieces[0].velocity = Vec3(0, 0, -60);
  Host host(ice, spec);
  host.run(kEnd, 1e-4);
  const LedgerEntry entry = host.impact().ledger();
  EXPECT_EQ(from_bullet(host.body().getCenterOfMassTransform().getOrigin()), spec.position);
  EXPECT_EQ(host.coupled().state().position, spec.position);
  EXPECT_LT(host.coupled().account().ice_impulse.z(), -10);
  EXPECT_LT(entry.momentum_residual, 1e-10);
  EXPECT_LT(entry.energy_residual, 0.02);
}

TEST(AttachedBodies, KeepThePathThatTheirFactorsLock) {
  const rigid::BodySpec spec = test::short_hcc(60, Motion::fixed_path);
  Host host(test::small_sheet(), spec);
  host.world().setGravity(btVector3(0, 0, -10));
  host.body().setGravity(btVector3(0, 0, -10));
  host.run(kEnd, 1e-4);
  EXPECT_EQ(host.coupled().velocity(), Body(spec).velocity());
  EXPECT_LT(
      (from_bullet(host.body().getCenterOfMassTransform().getOrigin()) - spec.position - kEnd * spec.velocity).norm(),
      1e-13);
  EXPECT_GT(host.coupled().account().ice_impulse.norm(), 10);
  EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10);
}

TEST(AttachedBodies, GiveWayOnlyAlongTheAxesThatTheirFactorsFree) {
  const rigid::BodySpec spec = test::short_hcc(60);
  rigid::BulletBody bullet(spec);
  bullet.body().setLinearFactor(btVector3(0, 1, 0));
  bullet.body().setAngularFactor(btVector3(1, 0, 0));
  rigid::BulletWorld host;
  IcePlugin plugin(test::small_sheet());
  host.world().addRigidBody(&bullet.body());
  plugin.attach(bullet.body(), spec.shape, spec.boundary_spacing);
  host.world().addAction(&plugin);
  for (int n = 0; n < 10; ++n) host.world().stepSimulation(1e-4, 0);
  const Outcome end = outcome(bullet.body());
  EXPECT_EQ(end.velocity.x(), 0);
  EXPECT_GT(end.velocity.y() - spec.velocity.y(), 0.1);
  EXPECT_NEAR(end.velocity.z(), spec.velocity.z(), 1e-12);
  EXPECT_GT(std::abs(end.angular_velocity.x()), 0.1);
  EXPECT_NEAR(end.angular_velocity.y(), 0, 1e-12);
  EXPECT_NEAR(end.angular_velocity.z(), 0, 1e-12);
  EXPECT_LT(plugin.impact().ledger().momentum_residual, 1e-10);
  host.world().removeAction(&plugin);
  host.world().removeRigidBody(&bullet.body());
}

// btRigidBody's default inertia is none: such a body does not turn in Bullet.
TEST(AttachedBodies, WithoutInertiaDoNotRotate) {
  const rigid::BodySpec spec = test::short_hcc(60);
  rigid::BulletBody source(spec);
  btRigidBody body(spec.mass.mass, nullptr, source.body().getCollisionShape());
  body.setCenterOfMassTransform(source.body().getCenterOfMassTransform());
  body.setLinearVelocity(to_bullet(spec.velocity));
  rigid::BulletWorld host;
  IcePlugin plugin(test::small_sheet());
  host.world().addRigidBody(&body);
  plugin.attach(body, spec.shape, spec.boundary_spacing);
  host.world().addAction(&plugin);
  for (int n = 0; n < 5; ++n) host.world().stepSimulation(1e-4, 0);
  const Outcome end = outcome(body);
  EXPECT_LT(end.velocity.norm(), 99.9);
  EXPECT_TRUE(end.angular_velocity.isZero(0));
  EXPECT_LT(end.orientation.angularDistance(spec.orientation), 1e-15);
  host.world().removeAction(&plugin);
  host.world().removeRigidBody(&body);
}

TEST(AttachedBodies, MustHaveInertiaAboutAllAxesOrNone) {
  btSphereShape shape(0.1);
  btRigidBody body(10, nullptr, &shape, btVector3(1, 0, 1));
  IcePlugin plugin(test::ice_out_of_reach());
  EXPECT_THROW(plugin.attach(body, rigid::Sphere{0.2}), std::invalid_argument);
}

}  // namespace
}  // namespace nilas
