#include "coupling/host_multibody_link.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <stdexcept>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using rigid::from_bullet;
using rigid::Quat;
using rigid::to_bullet;

constexpr double kEnd = 5e-4;      // s, a whole number of all host steps below
constexpr double kSubstep = 5e-6;  // s, divides all of them: every host then cuts time in the same sub-steps
constexpr double kArmMass = 20;    // kg
const Vec3 kArmInertia(1, 1, 1);   // kg m2

sph::IceSpec evenly_cut(sph::IceSpec ice) {
  ice.numerics.max_step = kSubstep * (1 + 1e-4);
  return ice;
}

/// Momentum and angular momentum about the world origin of a multibody, from the velocities that Bullet gives its
/// links.
Vec6 momentum_of(const btMultiBody& b) {
  std::vector<btVector3> omega(b.getNumLinks() + 1), velocity(b.getNumLinks() + 1);  // local frames, base first
  b.compTreeLinkVelocities(omega.data(), velocity.data());
  Vec6 momentum = Vec6::Zero();
  for (int i = -1; i < b.getNumLinks(); ++i) {
    const btVector3 spin = (i < 0 ? b.getBaseInertia() : b.getLinkInertia(i)) * omega[i + 1];
    const Vec3 p = static_cast<double>(i < 0 ? b.getBaseMass() : b.getLinkMass(i)) *
                   from_bullet(b.localDirToWorld(i, velocity[i + 1]));
    momentum.head<3>() += p;
    momentum.tail<3>() +=
        from_bullet(b.localPosToWorld(i, btVector3(0, 0, 0))).cross(p) + from_bullet(b.localDirToWorld(i, spin));
  }
  return momentum;
}

/// Calls back in its turn among the actions of a world.
class Probe final : public btActionInterface {
 public:
  explicit Probe(std::function<void()> call) : call_(std::move(call)) {}
  void updateAction(btCollisionWorld*, btScalar) override { call_(); }
  void debugDraw(btIDebugDraw*) override {}

 private:
  std::function<void()> call_;
};

/// A host's world with one multibody without damping, links of which are attached.
class Host {
 public:
  /// spec: shape, boundary spacing and centre of mass of the attached link; motion and mass are the multibody's.
  Host(const sph::IceSpec& ice, std::unique_ptr<btMultiBody> multibody, int link, const rigid::BodySpec& spec,
       const HostOptions& options = {})
      : multibody_(std::move(multibody)), plugin_(ice, options, [this](Impact& impact) { add_load(impact); }) {
    multibody_->setLinearDamping(0);
    multibody_->setAngularDamping(0);
    multibody_->setMaxCoordinateVelocity(1000);
    world_.setGravity(btVector3(0, 0, 0));
    world_.addMultiBody(multibody_.get());
    for (int i = -1; i < multibody_->getNumLinks(); ++i) add_collider(i);
    attach(link, spec);
    world_.addAction(&before_);
    world_.addAction(&plugin_);
    world_.addAction(&after_);
  }
  ~Host() {
    world_.removeAction(&after_);
    world_.removeAction(&plugin_);
    world_.removeAction(&before_);
    for (const auto& collider : colliders_) world_.removeCollisionObject(collider.get());
    world_.removeMultiBody(multibody_.get());
  }

  void attach(int link, const rigid::BodySpec& spec) {
    plugin_.attach(*multibody_, link, spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass);
  }
  btMultiBodyDynamicsWorld& world() { return world_; }
  btMultiBody& multibody() { return *multibody_; }
  IcePlugin& plugin() { return plugin_; }
  Impact& impact() { return plugin_.impact(); }
  const Body& coupled() { return impact().bodies()[0]; }
  btCollisionObject& collider(int link) { return *colliders_[link + 1]; }
  /// Momentum and angular momentum about the world origin: what the multibody gained in the plugin's turns, apart from
  /// what Bullet did between them; and what the ice's forces on the attached surfaces gave.
  const Vec6& gained() const { return gained_; }
  const Vec6& given() const { return given_; }
  void run(double time, double dt) {
    for (int n = 0; n < std::lround(time / dt); ++n) world_.stepSimulation(to_bullet(dt), 0);
  }

 private:
  void add_collider(int link) {
    colliders_.push_back(std::make_unique<btMultiBodyLinkCollider>(multibody_.get(), link));
    btMultiBodyLinkCollider* collider = colliders_.back().get();
    collider->setCollisionShape(&small_);
    if (link < 0)
      multibody_->setBaseCollider(collider);
    else
      multibody_->getLink(link).m_collider = collider;
    world_.addCollisionObject(collider);
  }
  void add_load(const Impact& impact) {
    const double dt = impact.last_step().dt;
    for (const sph::Surface& surface : impact.surfaces()) {
      given_.head<3>() += dt * surface.force;
      given_.tail<3>() += dt * (surface.reference.cross(surface.force) + surface.moment);
    }
  }

  btSphereShape small_{to_bullet(0.01)};
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::unique_ptr<btMultiBody> multibody_;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  IcePlugin plugin_;
  Vec6 gained_ = Vec6::Zero(), given_ = Vec6::Zero();
  Probe before_{[this] { gained_ -= momentum_of(*multibody_); }},
      after_{[this] { gained_ += momentum_of(*multibody_); }};
};

void place_base(btMultiBody& b, const rigid::BodySpec& spec) {
  b.setBaseWorldTransform(btTransform(to_bullet(spec.orientation), to_bullet(spec.position)));
  b.setBaseVel(to_bullet(spec.velocity));
  b.setBaseOmega(to_bullet(spec.angular_velocity));
}

/// The body as a multibody of one part.
std::unique_ptr<btMultiBody> lone_base(const rigid::BodySpec& spec, bool fixed = false) {
  auto b = std::make_unique<btMultiBody>(0, to_bullet(spec.mass.mass), to_bullet(spec.mass.inertia), fixed, true);
  b->finalizeMultiDof();
  place_base(*b, spec);
  return b;
}

/// The body as the base and an arm behind it, on a hinge along the body's x.
std::unique_ptr<btMultiBody> with_an_arm(const rigid::BodySpec& spec) {
  auto b = std::make_unique<btMultiBody>(1, to_bullet(spec.mass.mass), to_bullet(spec.mass.inertia), false, false);
  b->setupRevolute(0, to_bullet(kArmMass), to_bullet(kArmInertia), -1, btQuaternion::getIdentity(), btVector3(1, 0, 0),
                   btVector3(0, 0, to_bullet(-0.4)), btVector3(0, 0, to_bullet(-0.4)), true);
  b->finalizeMultiDof();
  place_base(*b, spec);
  return b;
}

/// The body as a link on an arm, its base: a hinge along the body's x, `lever` from the arm's centre of mass to the
/// hinge and again from there to the body's; body axes. All moves at the body's velocity, a fixed base not at all.
std::unique_ptr<btMultiBody> on_a_hinge(const rigid::BodySpec& spec, const Vec3& lever, bool fixed) {
  auto b = std::make_unique<btMultiBody>(1, to_bullet(kArmMass), to_bullet(kArmInertia), fixed, false);
  b->setupRevolute(0, to_bullet(spec.mass.mass), to_bullet(spec.mass.inertia), -1, btQuaternion::getIdentity(),
                   btVector3(1, 0, 0), to_bullet(lever), to_bullet(lever), true);
  b->finalizeMultiDof();
  rigid::BodySpec base = spec;
  base.position -= spec.orientation * (2 * lever);
  if (fixed) base.velocity = base.angular_velocity = Vec3::Zero();
  place_base(*b, base);
  return b;
}
const Vec3 kBehind(0, 0, 0.4), kBeside(0, 0.5, 0);  // m, levers

/// The same, fixed, swinging into the ice at 80 m/s.
std::unique_ptr<btMultiBody> swinging(const rigid::BodySpec& spec) {
  auto b = on_a_hinge(spec, kBeside, true);
  b->setJointVel(0, to_bullet(80 / kBeside.y()));
  return b;
}

/// The body as a link that slides on an arm along its axis.
std::unique_ptr<btMultiBody> on_a_slider(const rigid::BodySpec& spec) {
  auto b = std::make_unique<btMultiBody>(1, to_bullet(kArmMass), to_bullet(kArmInertia), false, false);
  const btVector3 offset(0, 0, to_bullet(0.3));
  b->setupPrismatic(0, to_bullet(spec.mass.mass), to_bullet(spec.mass.inertia), -1, btQuaternion::getIdentity(),
                    btVector3(0, 0, 1), offset, offset, true);
  b->finalizeMultiDof();
  rigid::BodySpec base = spec;
  base.position -= spec.orientation * Vec3(0, 0, 0.6);
  place_base(*b, base);
  return b;
}

struct Outcome {
  Vec3 velocity, position, angular_velocity;
  Quat orientation;
};
Outcome outcome(const btMultiBody& b, int link) {
  const MultibodyTree tree(b);
  const Vec6 velocity = tree.jacobian(link) * coordinate_velocities(b);
  return {velocity.head<3>(), tree.position(link), velocity.tail<3>(), tree.orientation(link)};
}
Outcome outcome(const Body& b) {
  return {b.velocity(), b.state().position, b.angular_velocity(), b.state().orientation};
}

/// Differences as fractions of the impact's speed, the body's travel and its spin.
double difference(const Outcome& a, const Outcome& b) {
  return std::max({(a.velocity - b.velocity).norm() / 100, (a.position - b.position).norm() / 0.1,
                   (a.angular_velocity - b.angular_velocity).norm() / 10,
                   a.orientation.angularDistance(b.orientation)});
}

/// Against the same body integrated by nilas alone, as a hosted btRigidBody is.
double error_of_lone_base(const rigid::BodySpec& spec, double dt) {
  Impact alone(evenly_cut(test::small_sheet()), {Body(spec)});
  alone.advance(kEnd);
  Host host(evenly_cut(test::small_sheet()), lone_base(spec), -1, spec);
  const auto momentum = [&] {
    return Vec3(momentum_of(host.multibody()).head<3>() + host.impact().ice().ledger().momentum);
  };
  const Vec3 before = momentum();
  host.run(kEnd, dt);
  EXPECT_LT((momentum() - before).norm(), 1e-10 * before.norm()) << dt;
  EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10) << dt;
  return difference(outcome(host.multibody(), -1), outcome(alone.bodies()[0]));
}

TEST(AttachedBase, WithoutLinksIsStruckAsARigidBodyAtAnyHostStep) {
  for (const double dt : {5e-4, 1e-4}) EXPECT_LT(error_of_lone_base(test::short_hcc(60), dt), 1e-10) << dt;
}

// Bullet's gyroscopic term is explicit and of first order.
TEST(AttachedBase, ThatTumblesTendsToTheRigidBodyWithTheHostsStep) {
  rigid::BodySpec spec = test::short_hcc(60);
  spec.angular_velocity = spec.orientation * Vec3(20, 0, 50);
  const double coarse = error_of_lone_base(spec, 1e-4), fine = error_of_lone_base(spec, 1e-5);
  EXPECT_LT(coarse, 0.01);
  EXPECT_LT(fine, coarse / 5);
}

TEST(AttachedBase, ThatIsFixedHoldsTheIce) {
  const rigid::BodySpec spec = test::short_hcc(90, rigid::Motion::fixed);
  sph::IceSpec ice = test::small_sheet();
  ice.pieces[0].velocity = Vec3(0, 0, -60);
  rigid::BodySpec base = spec;
  base.velocity = Vec3::Zero();
  Host host(ice, lone_base(base, true), -1, spec);
  host.run(1e-3, 1e-4);
  EXPECT_LT(host.given().z(), -10);
  EXPECT_EQ(from_bullet(host.multibody().getBasePos()), spec.position);
  EXPECT_TRUE(coordinate_velocities(host.multibody()).isZero(0));
  EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10);
}

void expect_exact_momentum(Host& host, double dt) {
  const Vec3 ice_before = host.impact().ice().ledger().momentum;
  const Vec6 before = momentum_of(host.multibody());
  host.run(kEnd, dt);
  for (const Body& body : host.impact().bodies()) EXPECT_GT(body.account().ice_impulse.norm(), 50) << dt;
  EXPECT_GT(std::abs(host.multibody().getJointVel(0)), 1) << dt;
  const double scale = before.head<3>().norm();  // times one metre for angular momentum
  const Vec3 lost = ice_before - host.impact().ice().ledger().momentum;
  EXPECT_LT((host.gained().head<3>() - lost).norm(), 1e-10 * scale) << dt;
  EXPECT_LT((host.gained() - host.given()).norm(), 1e-10 * scale) << dt;
  EXPECT_LT(host.impact().ledger().momentum_residual, 1e-10) << dt;
  // The rest is what Bullet's own step of a free mechanism leaks.
  EXPECT_LT((momentum_of(host.multibody()) - before - host.gained()).norm(), 1e-6 * scale) << dt;
}

TEST(AttachedLink, OfAFreeMultibodyGivesItExactlyTheMomentumThatTheIceLost) {
  const rigid::BodySpec spec = test::short_hcc(60);
  for (const double dt : {2.5e-4, 2.5e-5}) {
    Host child(evenly_cut(test::small_sheet()), on_a_hinge(spec, kBehind, false), 0, spec);
    expect_exact_momentum(child, dt);
    Host base(evenly_cut(test::small_sheet()), with_an_arm(spec), -1, spec);
    expect_exact_momentum(base, dt);
  }
}

TEST(AttachedLink, BesideAnotherOfItsMultibodyClosesTheMomentumToo) {
  const rigid::BodySpec spec = test::short_hcc(60);
  rigid::BodySpec arm;
  arm.shape = rigid::Sphere{0.3};
  arm.boundary_spacing = 0.02;
  sph::IceSpec ice = evenly_cut(test::small_sheet());
  sph::PieceSpec block;  // strikes the arm from behind
  block.shape = sph::IceShape::block;
  block.size = Vec3::Constant(0.2);
  block.centre = spec.position - (2 * kBehind.z() + 0.31) * test::heading(60);
  block.velocity = 200 * test::heading(60);
  ice.pieces.push_back(block);
  Host host(ice, on_a_hinge(spec, kBehind, false), 0, spec);
  host.attach(-1, arm);
  expect_exact_momentum(host, 1e-4);
}

TEST(AttachedLink, KeepsItsJointAndItsColliders) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Host host(test::small_sheet(), on_a_hinge(spec, kBehind, false), 0, spec);
  host.run(kEnd, 1e-4);
  EXPECT_GT(std::abs(host.multibody().getJointPos(0)), 1e-4);
  const Vec3 gap = from_bullet(host.collider(-1).getWorldTransform() * to_bullet(kBehind)) -
                   from_bullet(host.collider(0).getWorldTransform() * to_bullet(Vec3(-kBehind)));
  EXPECT_LT(gap.norm(), 1e-14);
  EXPECT_LT((from_bullet(host.collider(-1).getWorldTransform().getBasis().getColumn(0)) -
             from_bullet(host.collider(0).getWorldTransform().getBasis().getColumn(0)))
                .norm(),
            1e-14);
  const Outcome link = outcome(host.multibody(), 0);
  EXPECT_LT((from_bullet(host.collider(0).getWorldTransform().getOrigin()) - link.position).norm(), 1e-15);
}

TEST(AttachedLink, OnAFixedHingeTurnsByTheIcesImpulseAboutTheAxis) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const Vec3 axis = spec.orientation * Vec3::UnitX(), pivot = spec.position - spec.orientation * kBeside;
  const double inertia = spec.mass.inertia.x() + spec.mass.mass * kBeside.squaredNorm();
  for (const double dt : {2.5e-4, 2.5e-5}) {
    Host host(evenly_cut(test::small_sheet()), swinging(spec), 0, spec);
    const double before = host.multibody().getJointVel(0);
    host.run(kEnd, dt);
    const Vec3 moment = host.given().tail<3>() - pivot.cross(Vec3(host.given().head<3>()));
    EXPECT_LT(host.multibody().getJointVel(0), before - 1);
    EXPECT_NEAR(inertia * (host.multibody().getJointVel(0) - before), axis.dot(moment), 1e-10 * inertia * before) << dt;
    EXPECT_TRUE(coordinate_velocities(host.multibody()).head<6>().isZero(0));
  }
}

/// Of the link's position [m], on elastic ice, which does not change course where a particle fails.
double error_of_path(std::unique_ptr<btMultiBody> (*mechanism)(const rigid::BodySpec&), const rigid::BodySpec& spec,
                     double dt) {
  const auto end = [&](double step) {
    Host host(evenly_cut(test::elastic_sheet()), mechanism(spec), 0, spec);
    host.run(kEnd, step);
    return outcome(host.multibody(), 0).position;
  };
  return (end(dt) - end(kSubstep)).norm();
}

// Where Bullet's own step is exact and the link's mobility constant along its axes, so is the coupling.
TEST(AttachedLink, OnAFixedHingeIsTheSameAtAnyHostStep) {
  EXPECT_LT(error_of_path(swinging, test::short_hcc(60), 2.5e-4), 1e-12);
}

TEST(AttachedLink, OnASliderStruckHeadOnIsTheSameAtAnyHostStep) {
  EXPECT_LT(error_of_path(on_a_slider, test::short_hcc(90), 2.5e-4), 1e-12);
}

// Bullet's own step of two joined bodies that turn is of first order.
TEST(AttachedLink, OfAFreeMultibodyConvergesWithTheHostsStep) {
  const auto end = [](double step) {
    const rigid::BodySpec spec = test::short_hcc(60);
    Host host(evenly_cut(test::small_sheet()), on_a_hinge(spec, kBehind, false), 0, spec);
    host.run(kEnd, step);
    return outcome(host.multibody(), 0);
  };
  const Outcome reference = end(kSubstep), middle = end(1e-4), fine = end(1e-5);
  EXPECT_LT(difference(middle, reference), 1e-3);
  EXPECT_LT(difference(fine, reference), difference(middle, reference) / 5);
}

TEST(AttachedLink, FarFromIceMovesAsIfItWereNotAttached) {
  rigid::BodySpec spec = test::short_hcc(60);
  spec.angular_velocity = Vec3(3, -5, 7);
  auto without = on_a_hinge(spec, kBehind, false);
  without->setJointVel(0, 11);
  without->setLinearDamping(0);
  without->setAngularDamping(0);
  without->setMaxCoordinateVelocity(1000);
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, -10));
  world.addMultiBody(without.get());

  Host host(test::ice_out_of_reach(), on_a_hinge(spec, kBehind, false), 0, spec);
  host.multibody().setJointVel(0, 11);
  host.world().setGravity(btVector3(0, 0, -10));
  for (int n = 0; n < 20; ++n) {
    world.stepSimulation(to_bullet(1e-3), 0);
    host.run(1e-3, 1e-3);
  }
  EXPECT_EQ(coordinate_velocities(host.multibody()), coordinate_velocities(*without));
  EXPECT_EQ(host.multibody().getJointPos(0), without->getJointPos(0));
  EXPECT_EQ(host.multibody().getBasePos(), without->getBasePos());
  EXPECT_EQ(host.multibody().getWorldToBaseRot(), without->getWorldToBaseRot());
  world.removeMultiBody(without.get());
}

TEST(AttachedLink, IsKeptAwakeUntilItIsDetached) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Host host(test::ice_out_of_reach(), lone_base(spec), -1, spec);
  EXPECT_FALSE(host.multibody().getCanSleep());
  EXPECT_TRUE(host.multibody().isAwake());
  host.plugin().detach(host.collider(-1));
  EXPECT_TRUE(host.multibody().getCanSleep());
}

TEST(AttachedLink, IsTakenWhereTheHostPutsIt) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Host host(test::ice_out_of_reach(), on_a_hinge(spec, kBehind, false), 0, spec);
  host.run(1e-3, 1e-3);
  host.multibody().setBasePos(btVector3(4, 5, -6));
  host.multibody().setJointPos(0, 1);
  host.run(1e-3, 1e-3);
  EXPECT_LT((host.coupled().state().position - MultibodyTree(host.multibody()).position(0)).norm(), 1e-13);
  EXPECT_GT(host.coupled().state().position.norm(), 5);
}

TEST(AttachedLink, IsAwayWhileItsColliderIsNotInTheWorld) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Host host(test::small_sheet(), lone_base(spec), -1, spec);
  host.world().removeCollisionObject(&host.collider(-1));
  host.run(kEnd, 1e-4);
  EXPECT_EQ(host.plugin().presence(0), Presence::away);
  EXPECT_TRUE(host.given().isZero(0));
}

// One sub-step in each Bullet step of two: the ice falls behind, Bullet does not wait.
TEST(AttachedLink, GetsExactlyWhatTheIceGivesItBehindTheHostsTime) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Host host(evenly_cut(test::small_sheet()), on_a_hinge(spec, kBehind, false), 0, spec, {.budget = 1e-12});
  const double scale = momentum_of(host.multibody()).head<3>().norm();
  host.run(2 * kEnd, 2 * kSubstep);
  EXPECT_NEAR(host.plugin().last_step().time_behind, kEnd, 1e-12);
  EXPECT_GT(host.given().head<3>().norm(), 50);
  EXPECT_LT((host.gained() - host.given()).norm(), 1e-10 * scale);
  // By what the ice gave it since, the link is not where the ice has it.
  const Vec3 ahead = MultibodyTree(host.multibody()).position(0) - host.coupled().state().position;
  EXPECT_LT((ahead - kEnd * spec.velocity).norm(), 0.05 * kEnd * spec.velocity.norm());
}

TEST(AttachedLink, CanTakeTheShapeOfItsCollider) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Host host(test::ice_out_of_reach(), on_a_hinge(spec, kBehind, false), 0, spec);
  host.plugin().attach(host.multibody(), -1, 0.005);
  const rigid::Shape& shape = host.impact().bodies()[1].spec().shape;
  ASSERT_TRUE(std::holds_alternative<rigid::Sphere>(shape));
  EXPECT_NEAR(std::get<rigid::Sphere>(shape).diameter, 0.02, 1e-15);
  EXPECT_THROW(host.plugin().attach(host.multibody(), -1, 0.005), std::invalid_argument);
}

// Bullet clamps coordinate velocities in silence, at 100 unless told otherwise.
TEST(AttachedLink, MustKeepClearOfBulletsClamp) {
  const rigid::BodySpec spec = test::short_hcc(90);
  const auto fast = lone_base(spec);
  btMultiBodyLinkCollider collider(fast.get(), -1);
  fast->setBaseCollider(&collider);
  IcePlugin plugin(test::ice_out_of_reach());
  EXPECT_THROW(plugin.attach(*fast, -1, spec.shape, 0.02), std::invalid_argument);
  fast->setMaxCoordinateVelocity(200);
  EXPECT_NO_THROW(plugin.attach(*fast, -1, spec.shape, 0.02));
}

TEST(AttachedLink, SaysWhenBulletsClampIsReached) {
  const rigid::BodySpec spec = test::short_hcc(90);
  Host by_host(test::ice_out_of_reach(), lone_base(spec), -1, spec);
  by_host.multibody().setMaxCoordinateVelocity(90);
  EXPECT_THROW(by_host.run(1e-3, 1e-3), std::runtime_error);

  rigid::BodySpec slow = spec;
  slow.velocity = Vec3::Zero();
  sph::IceSpec ice = test::small_sheet();
  ice.pieces[0].velocity = Vec3(0, 0, -100);
  Host by_ice(ice, lone_base(slow), -1, spec);
  by_ice.multibody().setMaxCoordinateVelocity(to_bullet(0.1));
  EXPECT_THROW(by_ice.run(1e-3, 1e-4), std::runtime_error);
}

TEST(AttachedLink, MustExistAndHaveColliderMassAndInertia) {
  const rigid::BodySpec spec = test::short_hcc(90);
  const auto attach = [&](btMultiBody& b, int link) {
    IcePlugin(test::ice_out_of_reach()).attach(b, link, spec.shape, 0.02);
  };
  const auto b = on_a_hinge(spec, kBehind, false);
  b->setMaxCoordinateVelocity(1000);
  EXPECT_THROW(attach(*b, 0), std::invalid_argument);  // no collider
  btMultiBodyLinkCollider collider(b.get(), 0);
  b->getLink(0).m_collider = &collider;
  EXPECT_NO_THROW(attach(*b, 0));
  EXPECT_THROW(attach(*b, 1), std::invalid_argument);
  EXPECT_THROW(attach(*b, -2), std::invalid_argument);
  b->getLink(0).m_inertiaLocal.setY(0);
  EXPECT_THROW(attach(*b, 0), std::invalid_argument);
  b->getLink(0).m_inertiaLocal.setY(1);
  collider.setDynamicType(btCollisionObject::CF_KINEMATIC_OBJECT);
  EXPECT_THROW(attach(*b, 0), std::invalid_argument);
}

}  // namespace
}  // namespace nilas
