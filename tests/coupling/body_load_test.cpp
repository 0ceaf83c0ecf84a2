#include "coupling/body_load.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

/// A body in general position, at rest, and its surface to load.
struct Loaded {
  Loaded() : body(spec()), surface(body.make_surface()) {}
  static rigid::BodySpec spec() {
    rigid::BodySpec spec;
    spec.shape = rigid::Box{Vec3(0.4, 0.6, 1.0)};
    spec.boundary_spacing = 0.1;
    spec.mass = rigid::from_density(spec.shape, 500);
    spec.position = Vec3(3, -2, 1);
    spec.orientation = rigid::Quat(Eigen::AngleAxisd(0.8, Vec3(1, 2, -0.5).normalized()));
    return spec;
  }
  /// As the ice would: on the particle, on the whole, and about the centre.
  void press(std::size_t particle, const Vec3& force) {
    surface.particles[particle].force += force;
    surface.force += force;
    surface.moment += (surface.particles[particle].position - surface.reference).cross(force);
  }
  void kick(double dt) { body.kick(surface, {}, dt); }
  void lift() {
    for (sph::BoundaryParticle& b : surface.particles) b.force.setZero();
    surface.force.setZero();
    surface.moment.setZero();
  }
  Body body;
  sph::Surface surface;
};

TEST(BodyLoad, OfOneForceIsThatForceAtItsPlace) {
  Loaded loaded;
  const Vec3 force(1, -2, 3), place = loaded.surface.particles[7].position;
  loaded.press(7, force);
  loaded.kick(1e-3);
  const BodyLoad load = load_since({}, loaded.body, 1e-3);
  EXPECT_LT((load.force - force).norm(), 1e-13);
  EXPECT_LT((load.moment - (place - loaded.body.state().position).cross(force)).norm(), 1e-13);
  EXPECT_LT((load.impulse - 1e-3 * force).norm(), 1e-16);
  ASSERT_TRUE(load.centre);
  EXPECT_LT((*load.centre - place).norm(), 1e-13);
}

TEST(BodyLoad, IsTheMeanOverTheStepAndItsCentreIsWeightedWithForceAndTime) {
  Loaded loaded;
  const Vec3 first(1, -2, 3), second(0, 4, 0);
  const Vec3 a = loaded.surface.particles[7].position, b = loaded.surface.particles[100].position;
  loaded.press(7, first);
  loaded.kick(1e-3);
  loaded.lift();
  const BodyAccount before = loaded.body.account();
  loaded.kick(2e-3);  // nothing touches
  EXPECT_FALSE(load_since(before, loaded.body, 2e-3).centre);
  loaded.press(7, first);
  loaded.kick(1e-3);
  loaded.lift();
  loaded.press(100, second);
  loaded.kick(3e-3);
  const BodyLoad load = load_since(before, loaded.body, 6e-3);
  EXPECT_LT((load.force - (1e-3 * first + 3e-3 * second) / 6e-3).norm(), 1e-13);
  EXPECT_LT((load.impulse - 2e-3 * first - 3e-3 * second).norm(), 1e-16);
  const double weight_a = 1e-3 * first.norm(), weight_b = 3e-3 * second.norm();
  ASSERT_TRUE(load.centre);
  EXPECT_LT((*load.centre - (weight_a * a + weight_b * b) / (weight_a + weight_b)).norm(), 1e-13);
}

TEST(BodyLoad, HasItsCentreMoveAndTurnWithTheBody) {
  Loaded loaded;
  loaded.press(7, Vec3(1, -2, 3));
  loaded.kick(1e-3);
  const Vec3 move(0.1, 0.2, 0.3), lever = loaded.surface.particles[7].position - loaded.body.state().position;
  const rigid::Quat turn(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
  loaded.body.accept(Vec3::Zero(), Vec3::Zero(), move, turn);
  const BodyLoad load = load_since({}, loaded.body, 1e-3);
  EXPECT_LT((*load.centre - (loaded.body.state().position + turn * lever)).norm(), 1e-13);
}

TEST(PluginLoad, IsWhatTheBodyFeltInTheLastHostStep) {
  const rigid::BodySpec spec = test::short_hcc(60);
  rigid::BulletBody bullet(spec);
  btRigidBody& body = bullet.body();
  rigid::BulletBody stranger(spec);
  rigid::BulletWorld host;
  IcePlugin plugin(test::small_sheet(0.05));
  host.world().addRigidBody(&body);
  plugin.attach(body, spec.shape, 0.0375, spec.mass.centre_of_mass);
  host.world().addAction(&plugin);
  EXPECT_TRUE(plugin.load(body).force.isZero(0));
  EXPECT_FALSE(plugin.load(body).centre);
  EXPECT_THROW(plugin.load(stranger.body()), std::invalid_argument);

  Vec3 impulse = Vec3::Zero();
  int touched = 0;
  for (int n = 0; n < 10; ++n) {
    const Vec3 before = rigid::from_bullet(body.getLinearVelocity());
    host.world().stepSimulation(1e-4, 0);
    const BodyLoad load = plugin.load(body);
    const Vec3 gained = spec.mass.mass * (rigid::from_bullet(body.getLinearVelocity()) - before);
    EXPECT_LT((1e-4 * load.force - gained).norm(), 1e-11 * spec.mass.mass * 100);
    impulse += 1e-4 * load.force;
    EXPECT_LT((load.impulse - impulse).norm(), 1e-11 * spec.mass.mass * 100);
    EXPECT_EQ(load.centre.has_value(), !load.force.isZero(0));
    if (!load.centre) continue;
    // On or, as a mean over a curved nose, under its surface.
    const rigid::State& s = plugin.impact().bodies()[0].state();
    const Vec3 in_shape = s.orientation.conjugate() * (*load.centre - s.position) + spec.mass.centre_of_mass;
    EXPECT_LT(rigid::closest_point(spec.shape, in_shape).distance, 1e-12);
    EXPECT_GT(in_shape.z(), -0.2);  // in front: on the nose
    ++touched;
  }
  EXPECT_GT(touched, 5);
  host.world().removeAction(&plugin);
  host.world().removeRigidBody(&body);
}

}  // namespace
}  // namespace nilas
