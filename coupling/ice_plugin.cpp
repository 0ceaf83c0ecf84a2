#include "coupling/ice_plugin.hpp"

#include <LinearMath/btTransformUtil.h>

#include <limits>
#include <stdexcept>

#include "rigid/bullet_body.hpp"

namespace nilas {

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
  return turn.vec().norm() <= kAngleRoundOff ? rigid::Quat::Identity() : turn;
}

/// Mass, inertia and motion of a dynamic body as its host made it; angular_factor: its own.
void take_mass_and_motion(const btRigidBody& bullet, rigid::BodySpec& spec, Vec3& angular_factor) {
  const Vec3 inverse = from_bullet(bullet.getInvInertiaDiagLocal());
  spec.mass.mass = 1 / bullet.getInvMass();
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

IcePlugin::IcePlugin(sph::IceSpec ice, Impact::Observer observer)
    : ice_spec_(std::move(ice)), observer_(std::move(observer)) {}

IcePlugin::IcePlugin(sph::IceSpec ice, const sph::ContactSpec& contact, Impact::Observer observer)
    : IcePlugin(std::move(ice), std::move(observer)) {
  ice_spec_.contact = contact;
}

void IcePlugin::attach(btRigidBody& bullet, const rigid::Shape& shape, double boundary_spacing,
                       const std::string& name) {
  const double spacing = boundary_spacing > 0 ? boundary_spacing : 0.75 * ice_spec_.spacing;
  attach(bullet, shape, spacing, rigid::centroid(shape), name);
}

void IcePlugin::attach(btRigidBody& bullet, const rigid::Shape& shape, double boundary_spacing,
                       const Vec3& centre_of_mass, const std::string& name) {
  if (impact_) throw std::logic_error("IcePlugin::attach after the first step");
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

  bullet.setFlags(bullet.getFlags() &
                  ~(BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT | BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD |
                    BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY));
  bullet.setActivationState(DISABLE_DEACTIVATION);
  bodies_.emplace_back(spec, linear_factor, angular_factor);
  attached_.push_back({&bullet, spec.position, spec.velocity, spec.angular_velocity, spec.orientation});
}

Impact& IcePlugin::impact() {
  if (!impact_) impact_ = std::make_unique<Impact>(ice_spec_, std::move(bodies_), std::move(observer_));
  return *impact_;
}

void IcePlugin::updateAction(btCollisionWorld*, btScalar dt) {
  Impact& impact = this->impact();
  std::vector<ExternalLoad> loads;
  for (std::size_t k = 0; k < attached_.size(); ++k) loads.push_back(take_over(attached_[k], impact.body(k), dt));
  impact.advance(dt, loads);
  for (std::size_t k = 0; k < attached_.size(); ++k) hand_back(attached_[k], impact.bodies()[k]);
}

/// What Bullet did to the body in this step beyond its total force: applied at the start of the step (spread over the
/// step it would leave a penetration that Bullet turns into a bounce). Returns the total force and torque.
ExternalLoad IcePlugin::take_over(Attached& a, Body& body, double dt) {
  const btRigidBody& bullet = *a.bullet;
  if (bullet.getInvMass() == 0) return {};
  const ExternalLoad load{from_bullet(bullet.getTotalForce()), from_bullet(bullet.getTotalTorque())};
  const Vec3 v = from_bullet(bullet.getLinearVelocity()), omega = from_bullet(bullet.getAngularVelocity());
  const double mass = body.spec().mass.mass;
  const Vec3& inertia = body.spec().mass.inertia;
  const Vec3 linear_factor = from_bullet(bullet.getLinearFactor()),
             angular_factor = from_bullet(bullet.getAngularFactor());

  // Bullet carried the body from where the plugin left it to `reached`; more than that is a push or a teleport.
  btTransform reached;
  btTransformUtil::integrateTransform(btTransform(to_bullet(a.orientation), to_bullet(a.position)),
                                      bullet.getLinearVelocity(), bullet.getAngularVelocity(), dt, reached);
  const btTransform& pose = bullet.getCenterOfMassTransform();
  const Vec3 x = from_bullet(pose.getOrigin());
  const Vec3 push = without_round_off(x - from_bullet(reached.getOrigin()), x.cwiseAbs() + (dt * v).cwiseAbs());
  const rigid::Quat carried = from_bullet(reached.getRotation()) * a.orientation.conjugate();
  const rigid::Quat turn = without_round_off(
      carried.conjugate() * from_bullet(pose.getRotation() * reached.getRotation().inverse()) * carried);

  const Vec3 dv = v - a.velocity - linear_factor.cwiseProduct(load.force) * (dt / mass);
  const Vec3 impulse = mass * without_round_off(dv, v);
  const Vec3 L = rigid::angular_momentum_world(turn * a.orientation, inertia, omega);
  const Vec3 dL = L - rigid::angular_momentum_world(a.orientation, inertia, a.angular_velocity) -
                  dt * angular_factor.cwiseProduct(load.torque);
  body.accept(impulse, without_round_off(dL, L), push, turn);
  return load;
}

void IcePlugin::hand_back(Attached& a, const Body& body) {
  btRigidBody& bullet = *a.bullet;
  if (bullet.getInvMass() == 0) return;
  a.position = body.state().position;
  a.orientation = body.state().orientation;
  a.velocity = body.velocity();
  a.angular_velocity = body.angular_velocity();
  const btTransform pose(to_bullet(a.orientation), to_bullet(a.position));
  bullet.setCenterOfMassTransform(pose);
  bullet.setLinearVelocity(to_bullet(a.velocity));
  bullet.setAngularVelocity(to_bullet(a.angular_velocity));
  bullet.setInterpolationWorldTransform(pose);
  bullet.setInterpolationLinearVelocity(bullet.getLinearVelocity());
  bullet.setInterpolationAngularVelocity(bullet.getAngularVelocity());
}

}  // namespace nilas
