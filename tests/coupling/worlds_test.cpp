// The plugin in Bullet's three worlds, and several plugins in one.
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <gtest/gtest.h>

#include <memory>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using rigid::from_bullet;
using rigid::Quat;
using rigid::to_bullet;

enum class Kind { discrete, multibody, deformable };
const char* name(Kind kind) {
  const char* names[] = {"discrete", "multibody", "deformable"};
  return names[static_cast<int>(kind)];
}

constexpr Kind kKinds[] = {Kind::discrete, Kind::multibody, Kind::deformable};

/// A world of that kind, without gravity, with all that it needs.
class World {
 public:
  explicit World(Kind kind) : configuration_(configuration(kind)), dispatcher_(configuration_.get()) {
    switch (kind) {
      case Kind::discrete:
        solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
        world_ =
            std::make_unique<btDiscreteDynamicsWorld>(&dispatcher_, &broadphase_, solver_.get(), configuration_.get());
        break;
      case Kind::multibody: {
        auto solver = std::make_unique<btMultiBodyConstraintSolver>();
        world_ =
            std::make_unique<btMultiBodyDynamicsWorld>(&dispatcher_, &broadphase_, solver.get(), configuration_.get());
        solver_ = std::move(solver);
        break;
      }
      case Kind::deformable: {
        auto solver = std::make_unique<btDeformableMultiBodyConstraintSolver>();
        solver->setDeformableSolver(&deformable_);
        world_ = std::make_unique<btDeformableMultiBodyDynamicsWorld>(&dispatcher_, &broadphase_, solver.get(),
                                                                      configuration_.get(), &deformable_);
        solver_ = std::move(solver);
      }
    }
    world_->setGravity(btVector3(0, 0, 0));
  }
  btDiscreteDynamicsWorld& world() { return *world_; }

 private:
  static std::unique_ptr<btDefaultCollisionConfiguration> configuration(Kind kind) {
    if (kind == Kind::deformable) return std::make_unique<btSoftBodyRigidBodyCollisionConfiguration>();
    return std::make_unique<btDefaultCollisionConfiguration>();
  }

  std::unique_ptr<btDefaultCollisionConfiguration> configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btDeformableBodySolver deformable_;
  std::unique_ptr<btConstraintSolver> solver_;
  std::unique_ptr<btDiscreteDynamicsWorld> world_;
};

struct Outcome {
  Vec3 velocity, position, angular_velocity;
};
Outcome outcome(const btRigidBody& b) {
  return {from_bullet(b.getLinearVelocity()), from_bullet(b.getCenterOfMassPosition()),
          from_bullet(b.getAngularVelocity())};
}
double difference(const Outcome& a, const Outcome& b) {
  return std::max({(a.velocity - b.velocity).norm() / 100, (a.position - b.position).norm() / 0.1,
                   (a.angular_velocity - b.angular_velocity).norm() / 10});
}

/// A world with one attached body.
class Host {
 public:
  Host(Kind kind, const sph::IceSpec& ice, const rigid::BodySpec& spec) : body_(spec), world_(kind), plugin_(ice) {
    world().addRigidBody(&body());
    plugin_.attach(body(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass);
    world().addAction(&plugin_);
  }
  ~Host() {
    world().removeAction(&plugin_);
    world().removeRigidBody(&body());
  }
  btDiscreteDynamicsWorld& world() { return world_.world(); }
  btRigidBody& body() { return body_.body(); }
  Impact& impact() { return plugin_.impact(); }
  const Body& coupled() { return impact().bodies()[0]; }
  Vec3 momentum() {
    return impact().ice().ledger().momentum + from_bullet(body().getLinearVelocity()) / body().getInvMass();
  }

 private:
  rigid::BulletBody body_;
  World world_;
  IcePlugin plugin_;
};

TEST(Worlds, OfAllKindsGiveTheSameImpact) {
  const auto run = [](Kind kind) {
    Host host(kind, test::small_sheet(), test::short_hcc(60));
    const Vec3 before = host.momentum();
    for (int n = 0; n < 5; ++n) host.world().stepSimulation(1e-4, 0);
    EXPECT_LT((host.momentum() - before).norm(), 1e-10 * before.norm()) << name(kind);
    EXPECT_TRUE(host.coupled().account().external_impulse.isZero(0)) << name(kind);
    return outcome(host.body());
  };
  const Outcome expected = run(Kind::discrete);
  EXPECT_GT(expected.angular_velocity.norm(), 1);
  for (const Kind kind : {Kind::multibody, Kind::deformable})
    EXPECT_LT(difference(run(kind), expected), 1e-13) << name(kind);
}

TEST(Worlds, WithMultibodiesGiveTheSameImpactOnABase) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const auto run = [&](Kind kind) {
    World host(kind);
    auto& world = static_cast<btMultiBodyDynamicsWorld&>(host.world());
    rigid::BulletBody shape(spec);
    btMultiBody multibody(0, to_bullet(spec.mass.mass), to_bullet(spec.mass.inertia), false, false);
    multibody.finalizeMultiDof();
    multibody.setMaxCoordinateVelocity(1000);
    multibody.setBaseWorldTransform(btTransform(to_bullet(spec.orientation), to_bullet(spec.position)));
    multibody.setBaseVel(to_bullet(spec.velocity));
    btMultiBodyLinkCollider collider(&multibody, -1);
    collider.setCollisionShape(shape.body().getCollisionShape());
    multibody.setBaseCollider(&collider);
    IcePlugin plugin(test::small_sheet());
    plugin.attach(multibody, -1, spec.shape, spec.boundary_spacing);
    world.addMultiBody(&multibody);
    world.addCollisionObject(&collider);
    world.addAction(&plugin);
    for (int n = 0; n < 5; ++n) world.stepSimulation(to_bullet(1e-4), 0);
    world.removeAction(&plugin);
    world.removeCollisionObject(&collider);
    world.removeMultiBody(&multibody);
    return Outcome{from_bullet(multibody.getBaseVel()), from_bullet(multibody.getBasePos()),
                   from_bullet(multibody.getBaseOmega())};
  };
  const Outcome expected = run(Kind::multibody);
  EXPECT_GT(expected.angular_velocity.norm(), 1);
  EXPECT_LT(difference(run(Kind::deformable), expected), 1e-13);
}

// The deformable world gives gravity at once, at the start of its step, and clears it before actions run: the plugin
// meets it as an impulse, and the path is that of Bullet's own steps, g t dt / 2 ahead.
TEST(Worlds, OfAllKindsGiveGravity) {
  rigid::BodySpec spec = test::short_hcc(60);
  spec.velocity = Vec3::Zero();
  constexpr double dt = 1e-3, g = 10;
  for (const Kind kind : kKinds) {
    Host host(kind, test::ice_out_of_reach(), spec);
    host.world().setGravity(btVector3(0, 0, -g));
    host.body().setGravity(btVector3(0, 0, -g));
    for (int n = 0; n < 100; ++n) host.world().stepSimulation(dt, 0);
    const double t = 100 * dt, ahead = kind == Kind::deformable ? 0.5 * g * t * dt : 0;
    EXPECT_NEAR(host.body().getLinearVelocity().z(), -g * t, 1e-12) << name(kind);
    EXPECT_NEAR(host.body().getCenterOfMassPosition().z() - spec.position.z(), -0.5 * g * t * t - ahead, 1e-12)
        << name(kind);
    EXPECT_NEAR(host.coupled().account().external_impulse.z(), -g * t * spec.mass.mass, 1e-10) << name(kind);
  }
}

// The deformable world applies a host's force twice, once before and once in its solver. The books follow the world.
TEST(Worlds, OfAllKindsAreBookedByWhatTheyDidWithAHostsForce) {
  const Vec3 force(2e5, 1e5, -3e5);
  constexpr double dt = 1e-4, time = 5e-4;
  for (const Kind kind : kKinds) {
    Host host(kind, test::small_sheet(), test::short_hcc(60));
    const Vec3 before = host.momentum();
    for (int n = 0; n < std::lround(time / dt); ++n) {
      host.body().applyCentralForce(to_bullet(force));
      host.world().stepSimulation(dt, 0);
    }
    const Vec3 given = (kind == Kind::deformable ? 2 : 1) * time * force;
    EXPECT_LT((host.momentum() - before - given).norm(), 1e-10 * before.norm()) << name(kind);
    EXPECT_LT((host.coupled().account().external_impulse - given).norm(), 1e-10 * before.norm()) << name(kind);
    EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10) << name(kind);
  }
}

/// A block of elastic ice of some hundred particles.
sph::IceSpec block(const Vec3& centre, const Vec3& velocity) {
  sph::IceSpec ice = test::elastic_sheet();
  sph::PieceSpec piece;
  piece.shape = sph::IceShape::block;
  piece.size = Vec3(0.24, 0.24, 0.18);
  piece.centre = centre;
  piece.velocity = velocity;
  ice.pieces = {piece};
  ice.numerics.max_step = 5e-6 * (1 + 1e-4);
  return ice;
}

/// Round: a flat face that strikes a flat face makes a chaotic impact.
rigid::BodySpec ball(const Vec3& position) {
  rigid::BodySpec spec;
  spec.shape = rigid::Sphere{0.3};
  spec.boundary_spacing = 0.02;
  spec.mass = rigid::from_density(spec.shape, 900);
  spec.position = position;
  return spec;
}

// Two blocks that strike a ball from below and from above, off its middle.
const Vec3 kBelow(0.05, 0, -0.245), kUpwards(0, 0, 20), kAbove(-0.08, 0.04, 0.243), kDownwards(0, 0, -30);

TEST(Plugins, OfOneWorldDoNotDisturbEachOther) {
  const Vec3 apart(5, 0, 0);
  const auto alone = [](const sph::IceSpec& ice, const rigid::BodySpec& spec) {
    Host host(Kind::discrete, ice, spec);
    for (int n = 0; n < 10; ++n) host.world().stepSimulation(1e-4, 0);
    return outcome(host.body());
  };
  const sph::IceSpec first = block(kBelow, kUpwards), second = block(kAbove + apart, kDownwards);
  const Outcome expected_a = alone(first, ball(Vec3::Zero())), expected_b = alone(second, ball(apart));

  Host host(Kind::discrete, first, ball(Vec3::Zero()));
  const rigid::BodySpec spec = ball(apart);
  rigid::BulletBody other(spec);
  IcePlugin plugin(second);
  host.world().addRigidBody(&other.body());
  plugin.attach(other.body(), spec.shape, spec.boundary_spacing);
  host.world().addAction(&plugin);
  for (int n = 0; n < 10; ++n) host.world().stepSimulation(1e-4, 0);
  EXPECT_GT(expected_a.velocity.norm(), 1);
  EXPECT_EQ(difference(outcome(host.body()), expected_a), 0);
  EXPECT_EQ(difference(outcome(other.body()), expected_b), 0);
  host.world().removeAction(&plugin);
  host.world().removeRigidBody(&other.body());
}

constexpr double kEnd = 5e-4;        // s
const Vec3 kHostForce(2e4, 0, 4e4);  // N

void push_and_step(Host& host, double dt) {
  for (int n = 0; n < std::lround(kEnd / dt); ++n) {
    host.body().applyCentralForce(to_bullet(kHostForce));
    host.world().stepSimulation(to_bullet(dt), 0);
  }
}

/// The ball between two blocks, each of its own plugin, under a force of the host.
Outcome between_two_plugins(double dt) {
  const rigid::BodySpec spec = ball(Vec3::Zero());
  Host host(Kind::discrete, block(kBelow, kUpwards), spec);
  IcePlugin second(block(kAbove, kDownwards));
  second.attach(host.body(), spec.shape, spec.boundary_spacing);
  host.world().addAction(&second);
  const auto momentum = [&] { return Vec3(host.momentum() + second.impact().ice().ledger().momentum); };
  const Vec3 before = momentum();
  push_and_step(host, dt);
  EXPECT_LT((momentum() - before - kEnd * kHostForce).norm(), 1e-10 * before.norm()) << dt;
  EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10) << dt;
  EXPECT_LT(second.impact().ledger().momentum_residual, 1e-10) << dt;
  host.world().removeAction(&second);
  return outcome(host.body());
}

/// The same with both blocks in one plugin.
Outcome between_two_blocks() {
  sph::IceSpec both = block(kBelow, kUpwards);
  both.pieces.push_back(block(kAbove, kDownwards).pieces[0]);
  Host host(Kind::discrete, both, ball(Vec3::Zero()));
  push_and_step(host, 1e-4);
  return outcome(host.body());
}

// Each plugin meets the other's impulses as the host's, at the start of the next step.
TEST(Plugins, OnOneBodyCloseItsMomentumAndTendToOnePluginWithBothIces) {
  const Outcome expected = between_two_blocks(), coarse = between_two_plugins(1e-4), fine = between_two_plugins(1e-5);
  EXPECT_GT(expected.velocity.norm(), 1);
  EXPECT_LT((coarse.velocity - expected.velocity).norm(), 0.1 * expected.velocity.norm());
  EXPECT_LT((fine.velocity - expected.velocity).norm(), (coarse.velocity - expected.velocity).norm() / 5);
  EXPECT_LT((fine.position - expected.position).norm(), (coarse.position - expected.position).norm() / 5);
}

}  // namespace
}  // namespace nilas
