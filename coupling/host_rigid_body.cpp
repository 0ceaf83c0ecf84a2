#include "coupling/host_rigid_body.hpp"

#include <LinearMath/btTransformUtil.h>

#include <limits>
#include <stdexcept>

#include "rigid/bullet_body.hpp"
#include "sph/numerical_failure.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

using rigid::from_bullet;
using rigid::to_bullet;

namespace {

// Below this, relative to the value, a difference is Bullet's own round-off and not something the host did; taking it
// for real would leak momentum step by step.
constexpr double kRoundOff = 8 * std::numeric_limits<btScalar>::epsilon();
constexpr double kAngleRoundOff = 8 * kRoundOff;  // Bullet goes from quaternion to matrix and back several times

Vec3 without_round_off(const Vec3& difference, const Vec3& value) {
  return difference.norm() <= kRoundOff * value.norm() ? Vec3::Zero().eval() : difference;
}

/// A turn, the identity if it is no more than round-off.
rigid::Quat without_round_off(const rigid::Quat& turn) {
  return turn.vec().norm() <= kAngleRoundOff ? rigid::Quat(rigid::Quat::Identity()) : turn;
}

constexpr int kGyroscopic = BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT | BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD |
                            BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;

/// Mass, inertia and locks as the coupling needs them: numbers also where Bullet has none (infinite), because what is
/// locked never uses them.
struct Dynamics {
  double mass = 1;
  Vec3 inertia, linear_factor = Vec3::Zero(), angular_factor = Vec3::Zero();
};
Dynamics dynamics_of(const btRigidBody& bullet, double radius, bool free) {
  Dynamics d;
  if (free) {
    d.mass = 1 / static_cast<double>(bullet.getInvMass());
    d.linear_factor = from_bullet(bullet.getLinearFactor());
  }
  const Vec3 inverse = from_bullet(bullet.getInvInertiaDiagLocal());
  if (free && !inverse.isZero(0)) {
    d.inertia = inverse.cwiseInverse();
    d.angular_factor = from_bullet(bullet.getAngularFactor());
  } else {
    d.inertia = Vec3::Constant(0.4 * d.mass * radius * radius);
  }
  return d;
}

void require_inertia_about_all_or_none(const btRigidBody& bullet, const std::string& name) {
  const Vec3 inverse = from_bullet(bullet.getInvInertiaDiagLocal());
  if (!inverse.isZero(0) && (inverse.array() == 0).any())
    throw std::invalid_argument("body " + name +
                                " has inertia about some axes only, must have it about all three or none");
}

/// What a host may not do to its body, because nothing could go on from there.
void require_finite(const btRigidBody& bullet, const std::string& name) {
  const btTransform& pose = bullet.getCenterOfMassTransform();
  const bool finite =
      from_bullet(pose.getOrigin()).allFinite() && from_bullet(pose.getRotation()).coeffs().allFinite() &&
      from_bullet(bullet.getLinearVelocity()).allFinite() && from_bullet(bullet.getAngularVelocity()).allFinite() &&
      from_bullet(bullet.getTotalForce()).allFinite() && from_bullet(bullet.getTotalTorque()).allFinite();
  if (!finite) throw sph::NumericalFailure("pose, velocity or force of body " + name + " in its host is not finite");
}

HostRigidBody::Drive drive_of(const btRigidBody& bullet) {
  using Drive = HostRigidBody::Drive;
  if (bullet.isKinematicObject()) return Drive::animated;
  if (bullet.getInvMass() == 0) return Drive::still;
  return bullet.isActive() ? Drive::free : Drive::held;
}

}  // namespace

Body body_of(const btRigidBody& bullet, const rigid::Shape& shape, double boundary_spacing, const Vec3& centre_of_mass,
             const std::string& name) {
  require_inertia_about_all_or_none(bullet, name);
  const bool dynamic = bullet.getInvMass() > 0 && !bullet.isKinematicObject();
  const Dynamics d = dynamics_of(bullet, rigid::enclosing_radius(shape, centre_of_mass), dynamic);
  rigid::BodySpec spec;
  spec.name = name;
  spec.shape = shape;
  spec.boundary_spacing = boundary_spacing;
  spec.mass = {d.mass, centre_of_mass, d.inertia};
  spec.position = from_bullet(bullet.getCenterOfMassTransform().getOrigin());
  spec.orientation = from_bullet(bullet.getCenterOfMassTransform().getRotation());
  if (dynamic) {
    spec.velocity = from_bullet(bullet.getLinearVelocity());
    spec.angular_velocity = from_bullet(bullet.getAngularVelocity());
  } else {
    spec.motion = rigid::Motion::fixed;
  }
  return Body(spec, d.linear_factor, d.angular_factor);
}

HostRigidBody::Facts HostRigidBody::facts_of(const btRigidBody& bullet) {
  return {drive_of(bullet), bullet.getInvMass(), from_bullet(bullet.getInvInertiaDiagLocal()),
          from_bullet(bullet.getLinearFactor()), from_bullet(bullet.getAngularFactor())};
}

HostRigidBody::HostRigidBody(btRigidBody& bullet, double largest_push)
    : bullet_(bullet),
      largest_push_(largest_push),
      flags_(bullet.getFlags()),
      activation_(bullet.getActivationState()),
      facts_(facts_of(bullet)),
      position_(from_bullet(bullet.getCenterOfMassTransform().getOrigin())),
      velocity_(from_bullet(bullet.getLinearVelocity())),
      angular_velocity_(from_bullet(bullet.getAngularVelocity())),
      orientation_(from_bullet(bullet.getCenterOfMassTransform().getRotation())) {
  // body_of takes a dynamic body for free; if it is disabled, the first step finds that out.
  if (facts_.drive == Drive::held) facts_.drive = Drive::free;
  bullet.setFlags(flags_ & ~kGyroscopic);
  bullet.setActivationState(DISABLE_DEACTIVATION);
}

void HostRigidBody::release() {
  bullet_.setFlags((bullet_.getFlags() & ~kGyroscopic) | (flags_ & kGyroscopic));
  // A body that slept when it came may be on its way now: Bullet shall find out by itself.
  const bool slept = activation_ == ISLAND_SLEEPING || activation_ == WANTS_DEACTIVATION;
  if (bullet_.getActivationState() == DISABLE_DEACTIVATION)
    bullet_.forceActivationState(slept ? ACTIVE_TAG : activation_);
}

/// Mass, inertia and locks as the host has them now. What stops being free stops.
bool HostRigidBody::refit(Body& body) {
  const Facts now = facts_of(bullet_);
  if (now == facts_) return false;
  require_inertia_about_all_or_none(bullet_, body.spec().name);
  const bool free = now.drive == Drive::free;
  if (!free) {
    body.accept(-body.state().momentum, -body.state().angular_momentum, Vec3::Zero(), rigid::Quat::Identity());
    velocity_.setZero();
    angular_velocity_.setZero();
  }
  const Dynamics d = dynamics_of(bullet_, body.enclosing_radius(), free);
  body.adopt(d.mass, d.inertia, d.linear_factor, d.angular_factor);
  facts_ = now;
  return true;
}

/// Whether a displacement of the body is more than contact can answer.
bool HostRigidBody::place(Body& body, const Vec3& push, const rigid::Quat& turn) const {
  body.accept(Vec3::Zero(), Vec3::Zero(), push, turn);
  return push.norm() + 2 * turn.vec().norm() * body.enclosing_radius() > largest_push_;
}

HostTurn HostRigidBody::take_over(Body& body, double dt, double) {
  require_finite(bullet_, body.spec().name);
  const bool refitted = refit(body);
  HostTurn turn;
  switch (facts_.drive) {
    case Drive::free:
      turn = follow_flight(body, dt);
      break;
    case Drive::animated:
      turn = follow_animation(body, dt);
      break;
    case Drive::held:
    case Drive::still:
      turn = follow_pose(body);
      break;
  }
  turn.refitted = refitted;
  return turn;
}

HostTurn HostRigidBody::follow_flight(Body& body, double dt) {
  HostTurn host;
  host.load = {from_bullet(bullet_.getTotalForce()), from_bullet(bullet_.getTotalTorque())};
  const Vec3 v = from_bullet(bullet_.getLinearVelocity()), omega = from_bullet(bullet_.getAngularVelocity());
  const double mass = body.spec().mass.mass;
  const Vec3& inertia = body.spec().mass.inertia;

  // Bullet carried the body from where the plugin left it to `reached`; more than that is a push or a jump.
  btTransform reached;
  btTransformUtil::integrateTransform(btTransform(to_bullet(orientation_), to_bullet(position_)),
                                      bullet_.getLinearVelocity(), bullet_.getAngularVelocity(), to_bullet(dt),
                                      reached);
  const btTransform& pose = bullet_.getCenterOfMassTransform();
  const Vec3 x = from_bullet(pose.getOrigin());
  const Vec3 push = without_round_off(x - from_bullet(reached.getOrigin()), x.cwiseAbs() + (dt * v).cwiseAbs());
  const rigid::Quat carried = from_bullet(reached.getRotation()) * orientation_.conjugate();
  const rigid::Quat turn = without_round_off(
      carried.conjugate() * from_bullet(pose.getRotation() * reached.getRotation().inverse()) * carried);

  // Against what Bullet was given, which in single precision is the shadow rounded: that rounding is nobody's doing.
  const Vec3 v0 = from_bullet(to_bullet(velocity_)), omega0 = from_bullet(to_bullet(angular_velocity_));
  const Vec3 dv = v - v0 - facts_.linear_factor.cwiseProduct(host.load.force) * (dt / mass);
  const Vec3 impulse = mass * without_round_off(dv, v);
  const Vec3 L = rigid::angular_momentum_world(turn * orientation_, inertia, omega);
  const Vec3 dL = L - rigid::angular_momentum_world(orientation_, inertia, omega0) -
                  dt * facts_.angular_factor.cwiseProduct(host.load.torque);
  body.accept(impulse, without_round_off(dL, L), Vec3::Zero(), rigid::Quat::Identity());
  host.jumped = place(body, push, turn);
  return host;
}

/// A kinematic body moves steadily towards the pose that its host gave it, with the velocity that Bullet made of that:
/// the pose is that of the end of the whole stepSimulation call, which may be several steps away.
HostTurn HostRigidBody::follow_animation(Body& body, double dt) {
  const Vec3 way = from_bullet(bullet_.getCenterOfMassTransform().getOrigin()) - position_;
  const Eigen::AngleAxisd rest(
      (from_bullet(bullet_.getCenterOfMassTransform().getRotation()) * orientation_.conjugate()).normalized());
  const Vec3 turn_way = rest.angle() * rest.axis();
  // Up to the end of the way in this step; a way that the velocity does not lead along is a displacement by hand.
  const auto pace = [dt](const Vec3& distance, const Vec3& velocity) -> Vec3 {
    if (distance.norm() <= velocity.norm() * dt) return distance / dt;
    return (distance - dt * velocity).norm() < distance.norm() ? velocity : Vec3::Zero();
  };
  const Vec3 v = pace(way, from_bullet(bullet_.getLinearVelocity()));
  const Vec3 omega = pace(turn_way, from_bullet(bullet_.getAngularVelocity()));
  const bool led = !v.isZero(0) || !omega.isZero(0);
  const double mass = body.spec().mass.mass;
  HostTurn host;
  if (!led) host.jumped = place(body, way, rigid::Quat(rest));
  body.accept(mass * v - body.state().momentum,
              rigid::angular_momentum_world(body.state().orientation, body.spec().mass.inertia, omega) -
                  body.state().angular_momentum,
              Vec3::Zero(), rigid::Quat::Identity());
  return host;
}

/// A body that Bullet does not move: where the host put it.
HostTurn HostRigidBody::follow_pose(Body& body) {
  const btTransform& pose = bullet_.getCenterOfMassTransform();
  const Vec3 x = from_bullet(pose.getOrigin());
  HostTurn host;
  host.jumped = place(body, without_round_off(x - position_, x),
                      without_round_off(from_bullet(pose.getRotation()) * orientation_.conjugate()));
  return host;
}

void HostRigidBody::hand_back(const Body& body) {
  position_ = body.state().position;
  orientation_ = body.state().orientation;
  velocity_ = body.velocity();
  angular_velocity_ = body.angular_velocity();
  const bool pressed = body.account().ice_impulse != ice_impulse_;
  ice_impulse_ = body.account().ice_impulse;
  if (bullet_.getActivationState() == ISLAND_SLEEPING && pressed) bullet_.activate(true);
  if (facts_.drive != Drive::free) return;
  const btTransform pose(to_bullet(orientation_), to_bullet(position_));
  bullet_.setCenterOfMassTransform(pose);
  bullet_.setLinearVelocity(to_bullet(velocity_));
  bullet_.setAngularVelocity(to_bullet(angular_velocity_));
  bullet_.setInterpolationWorldTransform(pose);
  bullet_.setInterpolationLinearVelocity(bullet_.getLinearVelocity());
  bullet_.setInterpolationAngularVelocity(bullet_.getAngularVelocity());
}

}  // namespace NILAS_BULLET
}  // namespace nilas
