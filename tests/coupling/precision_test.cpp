// What holds in a host of either precision. Compiled once per precision of Bullet.
//
// The plugin keeps ice and body in double whatever the host's precision. Bullet's numbers are rounded to btScalar in
// two places only: what the host states (pose, velocity, mass, inertia, dt) before the plugin reads it, and the state
// that the plugin writes back. kEpsilon is the spacing of btScalar at one: rounding is wrong by at most half of it,
// relative.
#include <gtest/gtest.h>

#include <limits>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using rigid::from_bullet;
using rigid::Quat;
using rigid::to_bullet;

constexpr double kEpsilon = std::numeric_limits<btScalar>::epsilon();
constexpr double kClosed = 1e-10;  // ledger, and agreement of two runs in double: whatever btScalar is
constexpr double kEnd = 1e-3;      // s

double rounded(double s) { return to_bullet(s); }

class Host {
 public:
  Host(const sph::IceSpec& ice, const rigid::BodySpec& spec) : body_(spec), plugin_(ice) {
    world().addRigidBody(&body());
    plugin_.attach(body(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, spec.name);
    world().addAction(&plugin_);
  }
  ~Host() {
    world().removeAction(&plugin_);
    world().removeRigidBody(&body());
  }

  btDiscreteDynamicsWorld& world() { return world_.world(); }
  btRigidBody& body() { return body_.body(); }
  const Body& coupled() { return plugin_.impact().bodies()[0]; }
  LedgerEntry ledger() { return plugin_.impact().ledger(); }
  void run(double time, double dt) {
    for (int n = 0; n < std::lround(time / dt); ++n) world().stepSimulation(to_bullet(dt), 0);
  }

 private:
  rigid::BulletBody body_;
  IcePlugin plugin_;
  rigid::BulletWorld world_;
};

/// The body as Bullet of this precision holds it: what a double host would have to be given to state the same.
rigid::BodySpec as_bullet_holds_it(rigid::BodySpec spec) {
  rigid::BulletBody bullet(spec);
  const btRigidBody& b = bullet.body();
  spec.mass.mass = 1 / static_cast<double>(b.getInvMass());
  spec.mass.inertia = from_bullet(b.getInvInertiaDiagLocal()).cwiseInverse();
  spec.position = from_bullet(b.getCenterOfMassTransform().getOrigin());
  spec.orientation = from_bullet(b.getCenterOfMassTransform().getRotation());
  spec.velocity = from_bullet(b.getLinearVelocity());
  spec.angular_velocity = from_bullet(b.getAngularVelocity());
  return spec;
}

/// The same impact without any Bullet, in double, cut in the same host steps.
Body alone(const sph::IceSpec& ice, const rigid::BodySpec& spec, double dt) {
  Impact impact(ice, {Body(spec)});
  for (int n = 0; n < std::lround(kEnd / dt); ++n) impact.advance(rounded(dt));
  return impact.bodies()[0];
}

/// Differences as fractions of the impact's speed, the body's travel and its spin.
double difference(const Body& a, const Body& b) {
  return std::max({(a.velocity() - b.velocity()).norm() / 100, (a.state().position - b.state().position).norm() / 0.1,
                   (a.angular_velocity() - b.angular_velocity()).norm() / 10,
                   a.state().orientation.angularDistance(b.state().orientation)});
}

TEST(Precision, AHostRoundsWhatItStatesAndNothingElse) {
  const rigid::BodySpec spec = test::short_hcc(60);
  for (const double dt : {1e-3, 1e-4}) {
    Host host(test::small_sheet(), spec);
    host.run(kEnd, dt);
    EXPECT_GT(host.coupled().angular_velocity().norm(), 1) << dt;
    EXPECT_LT(difference(host.coupled(), alone(test::small_sheet(), as_bullet_holds_it(spec), dt)), kClosed) << dt;
    EXPECT_TRUE(host.coupled().account().external_impulse.isZero(0)) << dt;
    EXPECT_TRUE(host.coupled().account().external_angular_impulse.isZero(0)) << dt;
    EXPECT_LT(host.ledger().momentum_residual, kClosed) << dt;
  }
}

TEST(Precision, AFloatHostAndADoubleOneAgreeWithinTheRoundingOfWhatTheyState) {
  // In the units of `difference` rounding of position, attitude, velocity and dt makes no more than five epsilon; a
  // collision may multiply that by ten.
  for (const sph::IceSpec& ice : {test::small_sheet(), test::elastic_sheet()}) {
    const rigid::BodySpec spec = test::short_hcc(60);
    Host host(ice, spec);
    host.run(kEnd, 1e-4);
    Impact impact(ice, {Body(spec)});
    for (int n = 0; n < 10; ++n) impact.advance(1e-4);
    EXPECT_LT(difference(host.coupled(), impact.bodies()[0]), 50 * kEpsilon + kClosed);
  }
}

TEST(Precision, BulletHoldsTheStateRoundedOnce) {
  Host host(test::small_sheet(), test::short_hcc(60));
  host.run(kEnd, 1e-4);
  const Body& body = host.coupled();
  EXPECT_EQ(host.body().getLinearVelocity(), to_bullet(body.velocity()));
  EXPECT_EQ(host.body().getAngularVelocity(), to_bullet(body.angular_velocity()));
  EXPECT_EQ(host.body().getCenterOfMassPosition(), to_bullet(body.state().position));
  // The attitude goes through a quaternion and a matrix: some roundings of numbers up to one.
  const Vec3 axis = from_bullet(host.body().getCenterOfMassTransform().getBasis().getColumn(2));
  EXPECT_LT((axis - body.state().orientation * Vec3::UnitZ()).norm(), 8 * kEpsilon);
}

TEST(Precision, ARodSpinsFreelyWithoutAnyInfluenceOfTheHost) {
  // The round-off of its spin about the axis, as angular momentum about the others (600 times the moment of inertia),
  // is far more than the round-off of its angular momentum.
  rigid::BodySpec spec;
  spec.shape = rigid::Cylinder{3, 0.1};
  spec.boundary_spacing = 0.1;
  spec.mass = rigid::from_density(spec.shape, 900);
  spec.orientation = rigid::orientation_along(test::heading(60));
  spec.velocity = Vec3(3, 4, 5);
  spec.angular_velocity = spec.orientation * Vec3(0.3, 0, 100);
  Host host(test::ice_out_of_reach(), spec);
  const rigid::State before = host.coupled().state();
  host.run(0.1, 1. / 240);
  EXPECT_EQ(host.coupled().state().momentum, before.momentum);
  EXPECT_EQ(host.coupled().state().angular_momentum, before.angular_momentum);
}

TEST(Precision, GravityIsTakenToRoundOffHoweverLongItActs) {
  rigid::BodySpec spec = test::short_hcc(60);
  spec.velocity = Vec3::Zero();
  Host host(test::ice_out_of_reach(), spec);
  host.body().setGravity(btVector3(0, 0, btScalar(-9.81)));
  const int steps = 60;
  const double dt = 1. / 240, time = steps * rounded(dt);
  host.run(0.25, dt);
  // Gravity, the mass as inverse of the inverse, their product, the inverse: four roundings. And the sum over the steps
  // (beside sleeping ice one per step of the host).
  const double bound = 2 * kEpsilon + steps * std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(host.coupled().velocity().z(), -9.81 * time, bound * 9.81 * time);
  EXPECT_NEAR(host.coupled().state().position.z(), rounded(spec.position.z()) - 0.5 * 9.81 * time * time,
              bound * 9.81 * time);
}

TEST(Precision, AnImpulseDuringAnImpactIsBookedToRoundOff) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Host host(test::small_sheet(), spec);
  const Vec3 impulse(40, -30, 20);
  host.run(kEnd / 2, 1e-4);
  host.body().applyImpulse(to_bullet(impulse), btVector3(0, btScalar(0.1), btScalar(-0.2)));
  host.run(kEnd / 2, 1e-4);
  // Bullet adds it to the velocity, of 100 m/s, in btScalar; nothing of the ice's is rounded along with it.
  const double momentum = spec.mass.mass * spec.velocity.norm();
  EXPECT_LT((host.coupled().account().external_impulse - impulse).norm(), 2 * kEpsilon * momentum);
  EXPECT_LT(host.ledger().momentum_residual, kClosed);
}

}  // namespace
}  // namespace nilas
