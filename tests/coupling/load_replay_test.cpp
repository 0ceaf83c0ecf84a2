#include "coupling/load_replay.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"
#include "tests/coupling/small_impact.hpp"
#include "tests/support/scratch_directory.hpp"

namespace nilas {
namespace {

using rigid::from_bullet;
using rigid::Quat;
using rigid::to_bullet;

constexpr double kEnd = 1. / 240;  // s
constexpr double kHostSteps[] = {1e-5, 1e-4, 1. / 240};

/// What a host does to the body besides the ice.
struct HostLoads {
  Vec3 gravity = Vec3::Zero();                       // m/s2
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();  // N, N m, given anew in every step
  Vec3 linear_factor = Vec3::Ones(), angular_factor = Vec3::Ones();
};

struct Outcome {
  Vec3 velocity, position, angular_velocity;
  Quat orientation;
};

/// A world with one body that something acts on.
class World {
 public:
  explicit World(const rigid::BodySpec& spec, const HostLoads& loads = {}) : loads_(loads), body_(spec) {
    world().setGravity(to_bullet(loads.gravity));
    body().setLinearFactor(to_bullet(loads.linear_factor));
    body().setAngularFactor(to_bullet(loads.angular_factor));
    world().addRigidBody(&body());
  }
  ~World() {
    world().removeAction(action_.get());
    world().removeRigidBody(&body());
  }
  void act(std::unique_ptr<btActionInterface> action) {
    action_ = std::move(action);
    world().addAction(action_.get());
  }
  btDiscreteDynamicsWorld& world() { return world_.world(); }
  btRigidBody& body() { return body_.body(); }
  void step(double dt) {
    body().applyCentralForce(to_bullet(loads_.force));
    body().applyTorque(to_bullet(loads_.torque));
    world().stepSimulation(to_bullet(dt), 0);
  }
  /// By whole steps and a shorter last one.
  void run(double time, double dt) {
    const int whole = static_cast<int>(time / dt * (1 + 1e-12));
    for (int n = 0; n < whole; ++n) step(dt);
    if (const double left = time - whole * dt; left > 1e-12 * time) step(left);
  }
  Outcome outcome() {
    const btTransform& pose = body().getCenterOfMassTransform();
    return {from_bullet(body().getLinearVelocity()), from_bullet(pose.getOrigin()),
            from_bullet(body().getAngularVelocity()), from_bullet(pose.getRotation())};
  }

 private:
  HostLoads loads_;
  rigid::BulletBody body_;
  std::unique_ptr<btActionInterface> action_;
  rigid::BulletWorld world_;
};

struct Recorded {
  LoadRecord record;
  Outcome end;
};

/// The small sheet, struck in a host's world at a step that is none of the replays'.
Recorded recorded(const rigid::BodySpec& spec, const HostLoads& loads = {}, double interval = 0) {
  LoadRecord record(interval);
  World host(spec, loads);
  auto plugin = std::make_unique<IcePlugin>(test::small_sheet(0.05), HostOptions{}, [&](Impact& impact) {
    record.add(impact.last_step().time, impact.bodies()[0].account());
  });
  plugin->attach(host.body(), spec.shape, 0.0375, spec.mass.centre_of_mass, spec.name);
  host.act(std::move(plugin));
  host.run(kEnd, 2.5e-4);
  return {std::move(record), host.outcome()};
}

Outcome replayed(const LoadRecord& record, const rigid::BodySpec& spec, double dt, const HostLoads& loads = {}) {
  World host(spec, loads);
  host.act(std::make_unique<LoadReplay>(record, host.body()));
  host.run(kEnd, dt);
  return host.outcome();
}

/// Each relative to what the ice and the host changed; the attitude in rad.
void expect_close(const Outcome& a, const Outcome& b, const rigid::BodySpec& start, double tolerance) {
  EXPECT_LT((a.velocity - b.velocity).norm(), tolerance * (b.velocity - start.velocity).norm());
  EXPECT_LT((a.position - b.position).norm(), tolerance * (b.position - start.position).norm());
  EXPECT_LT(a.orientation.angularDistance(b.orientation), tolerance);
  EXPECT_LT((a.angular_velocity - b.angular_velocity).norm(), tolerance * b.angular_velocity.norm());
}

TEST(LoadReplay, ReproducesTheRecordedRunAtAnyHostStepThroughAFile) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const Recorded run = recorded(spec);
  EXPECT_GT(run.end.angular_velocity.norm(), 1);
  EXPECT_GT(run.record.rows().size(), 100u);
  EXPECT_NEAR(run.record.rows().back().time, kEnd, 1e-15);
  const test::ScratchDirectory scratch;
  write_load_record(run.record, scratch.path() / "loads.csv");
  const LoadRecord read = read_load_record(scratch.path() / "loads.csv");
  for (const double dt : kHostSteps) {
    SCOPED_TRACE(dt);
    expect_close(replayed(read, spec, dt), run.end, spec, 1e-6);
  }
}

TEST(LoadReplay, ReproducesARunInWhichGravityAndTheHostAct) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const HostLoads loads{.gravity = Vec3(0, 0, -981), .force = Vec3(2e4, 1e4, -3e4), .torque = Vec3(-2e2, 1e2, 4e2)};
  const Recorded run = recorded(spec, loads);
  for (const double dt : kHostSteps) {
    SCOPED_TRACE(dt);
    expect_close(replayed(run.record, spec, dt, loads), run.end, spec, 1e-6);
  }
}

TEST(LoadReplay, ReproducesATumblingBodyWithThreeDifferentMoments) {
  rigid::BodySpec spec = test::short_hcc(75);
  spec.mass.inertia.y() *= 0.8;
  spec.angular_velocity = Vec3(30, -20, 60);
  const Recorded run = recorded(spec);
  for (const double dt : kHostSteps) {
    SCOPED_TRACE(dt);
    expect_close(replayed(run.record, spec, dt), run.end, spec, 1e-6);
  }
}

TEST(LoadReplay, LeavesToTheLockedAxesWhatTheyTakeUp) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const HostLoads loads{.linear_factor = Vec3(0, 1, 1), .angular_factor = Vec3(1, 0, 0)};
  const Recorded run = recorded(spec, loads);
  EXPECT_NE(run.record.rows().back().impulse.x(), 0);  // the ice pressed that way, too
  for (const double dt : kHostSteps) {
    SCOPED_TRACE(dt);
    const Outcome end = replayed(run.record, spec, dt, loads);
    expect_close(end, run.end, spec, 1e-6);
    EXPECT_EQ(end.velocity.x(), 0);
  }
}

// Where within a row the force acted is lost, nothing of its impulse.
TEST(LoadReplay, OfACoarseRecordGivesTheWholeImpulseAndAPathThatConverges) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const auto errors = [&](double interval) {
    const Recorded run = recorded(spec, {}, interval);
    const Outcome end = replayed(run.record, spec, 1e-4);
    EXPECT_LT((end.velocity - run.end.velocity).norm(), 1e-12 * spec.velocity.norm()) << interval;
    return std::pair((end.position - run.end.position).norm(), end.orientation.angularDistance(run.end.orientation));
  };
  const auto [coarse_path, coarse_attitude] = errors(1e-3);
  const auto [fine_path, fine_attitude] = errors(1e-4);
  EXPECT_LT(fine_path, coarse_path / 5);
  EXPECT_LT(fine_attitude, coarse_attitude / 5);
}

/// A constant force and moment from time 5 s to 5.01 s.
LoadRecord pulse(const Vec3& force, const Vec3& moment) {
  return LoadRecord({{5, Vec3(1, 1, 1), Vec3::Zero()}, {5.01, Vec3(1, 1, 1) + 0.01 * force, 0.01 * moment}});
}

TEST(LoadReplay, OfAConstantForceIsUniformAccelerationAndThenFreeFlight) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const Vec3 force(1e3, -2e3, 3e3), gravity(0, 0, -9.81), a = force / spec.mass.mass;
  World host(spec, {.gravity = gravity});
  auto replay = std::make_unique<LoadReplay>(pulse(force, Vec3::Zero()), host.body());
  const LoadReplay& seen = *replay;
  host.act(std::move(replay));
  host.run(4e-3, 1e-3);
  EXPECT_NEAR(seen.time(), 5.004, 1e-12);
  EXPECT_LT((host.outcome().velocity - spec.velocity - 4e-3 * (a + gravity)).norm(), 1e-12 * 100);
  EXPECT_LT((host.outcome().position - spec.position - 4e-3 * spec.velocity - 8e-6 * (a + gravity)).norm(), 1e-12);
  host.run(0.016, 1e-3);
  const Vec3 velocity = spec.velocity + 0.01 * a + 0.02 * gravity;
  EXPECT_LT((host.outcome().velocity - velocity).norm(), 1e-12 * 100);
  EXPECT_LT((host.outcome().position - spec.position - 0.02 * spec.velocity - 0.01 * (0.005 + 0.01) * a -
             0.5 * 0.02 * 0.02 * gravity)
                .norm(),
            1e-12);
  EXPECT_LT((seen.body().account().ice_impulse - 0.01 * force).norm(), 1e-12 * force.norm());
}

TEST(LoadReplay, RespectsAnImpulseOfTheHost) {
  const rigid::BodySpec spec = test::short_hcc(60);
  const Vec3 force(1e3, -2e3, 3e3), moment(10, 20, -30), impulse(40, -30, 20), lever(0, 0.1, -0.2);
  World host(spec);
  host.act(std::make_unique<LoadReplay>(pulse(force, moment), host.body()));
  host.run(5e-3, 1e-3);
  host.body().applyImpulse(to_bullet(impulse), to_bullet(lever));
  host.run(1e-2, 1e-3);
  const Outcome end = host.outcome();
  EXPECT_LT((spec.mass.mass * (end.velocity - spec.velocity) - 0.01 * force - impulse).norm(), 1e-11 * 3e3);
  const Vec3 L = rigid::angular_momentum_world(end.orientation, spec.mass.inertia, end.angular_velocity);
  EXPECT_LT((L - 0.01 * moment - lever.cross(impulse)).norm(), 1e-11);
}

}  // namespace
}  // namespace nilas
