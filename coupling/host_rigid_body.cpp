#include "coupling/host_rigid_body.hpp"

#include <LinearMath/btTransformUtil.h>

#include <limits>
#include <stdexcept>

#include "rigid/bullet_body.hpp"

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

/// Mass, inertia and motion of a dynamic body as its host made it; angular_factor: its own.
void take_mass_and_motion(const btRigidBody& bullet, rigid::BodySpec& spec, Vec3& angular_factor) {
  const Vec3 inverse = from_bullet(bullet.getInvInertiaDiagLocal());
  spec.mass.mass = 1 / static_cast<double>(bullet.getInvMass());
  if (inverse.isZero(0)) {
    // A body without inertia does not turn in Bullet; the inertia is then never used, but has to be a number.
    angular_factor.setZero();
    spec.mass.inertia = rigid::from_mass(spec.shape, spec.mass.mass).inertia;
  } else if ((inverse.array() == 0).any()) {
    throw std::invalid_argument("IcePlugin::attach: body " + spec.name +
                                " has inertia about some axes only, must have it about all three or none");
  } else {
    spec.mass.inertia = inverse.cwiseInverse();
  }
  spec.velocity = from_bullet(bullet.getLinearVelocity());
  spec.angular_velocity = from_bullet(bullet.getAngularVelocity());
  if (angular_factor.isZero(0))
    spec.motion = bullet.getLinearFactor().isZero() ? rigid::Motion::fixed_path : rigid::Motion::translation_only;
}

}  // namespace

Body body_of(const btRigidBody& bullet, const rigid::Shape& shape, double boundary_spacing, const Vec3& centre_of_mass,
             const std::string& name) {
  if (bullet.isKinematicObject())
    throw std::invalid_argument("IcePlugin::attach: body " + name +
                                " is kinematic; allowed: static, or dynamic with linear and angular factor 0");
  const bool still = bullet.getInvMass() == 0;
  Vec3 linear_factor = from_bullet(bullet.getLinearFactor()), angular_factor = from_bullet(bullet.getAngularFactor());
  rigid::BodySpec spec;
  spec.name = name;
  spec.shape = shape;
  spec.boundary_spacing = boundary_spacing;
  if (still) {
    // Bullet's static bodies have no mass; a locked body's mass is never used, but has to be a number.
    spec.mass = rigid::from_density(shape, 1000);
    spec.motion = rigid::Motion::fixed;
    linear_factor = angular_factor = Vec3::Zero();
  } else {
    take_mass_and_motion(bullet, spec, angular_factor);
  }
  spec.mass.centre_of_mass = centre_of_mass;
  spec.position = from_bullet(bullet.getCenterOfMassTransform().getOrigin());
  spec.orientation = from_bullet(bullet.getCenterOfMassTransform().getRotation());
  return Body(spec, linear_factor, angular_factor);
}

HostRigidBody::HostRigidBody(btRigidBody& bullet)
    : bullet_(bullet),
      position_(from_bullet(bullet.getCenterOfMassTransform().getOrigin())),
      velocity_(from_bullet(bullet.getLinearVelocity())),
      angular_velocity_(from_bullet(bullet.getAngularVelocity())),
      orientation_(from_bullet(bullet.getCenterOfMassTransform().getRotation())) {
  bullet.setFlags(bullet.getFlags() &
                  ~(BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT | BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD |
                    BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY));
  bullet.setActivationState(DISABLE_DEACTIVATION);
}

/// What Bullet did is applied at the start of the step: spread over the step it would leave a penetration that Bullet
/// turns into a bounce.
ExternalLoad HostRigidBody::take_over(Body& body, double dt) {
  if (bullet_.getInvMass() == 0) return {};
  const ExternalLoad load{from_bullet(bullet_.getTotalForce()), from_bullet(bullet_.getTotalTorque())};
  const Vec3 v = from_bullet(bullet_.getLinearVelocity()), omega = from_bullet(bullet_.getAngularVelocity());
  const double mass = body.spec().mass.mass;
  const Vec3& inertia = body.spec().mass.inertia;
  const Vec3 linear_factor = from_bullet(bullet_.getLinearFactor()),
             angular_factor = from_bullet(bullet_.getAngularFactor());

  // Bullet carried the body from where the plugin left it to `reached`; more than that is a push or a teleport.
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
  const Vec3 dv = v - v0 - linear_factor.cwiseProduct(load.force) * (dt / mass);
  const Vec3 impulse = mass * without_round_off(dv, v);
  const Vec3 L = rigid::angular_momentum_world(turn * orientation_, inertia, omega);
  const Vec3 dL =
      L - rigid::angular_momentum_world(orientation_, inertia, omega0) - dt * angular_factor.cwiseProduct(load.torque);
  body.accept(impulse, without_round_off(dL, L), push, turn);
  return load;
}

void HostRigidBody::hand_back(const Body& body) {
  if (bullet_.getInvMass() == 0) return;
  position_ = body.state().position;
  orientation_ = body.state().orientation;
  velocity_ = body.velocity();
  angular_velocity_ = body.angular_velocity();
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
