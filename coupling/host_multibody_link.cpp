#include "coupling/host_multibody_link.hpp"

#include <Eigen/Dense>
#include <array>
#include <stdexcept>

#include "rigid/bullet_body.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

using rigid::to_bullet;

namespace {

constexpr double kNearClamp = 0.9;  // of Bullet's largest coordinate velocity

const btMultiBodyLinkCollider* collider_of(const btMultiBody& multibody, int link) {
  return link < 0 ? multibody.getBaseCollider() : multibody.getLinkCollider(link);
}

/// The coordinates of a multibody, to be restored.
class Coordinates {
 public:
  explicit Coordinates(const btMultiBody& multibody)
      : base_position_(multibody.getBasePos()), world_to_base_(multibody.getWorldToBaseRot()) {
    for (int i = 0; i < multibody.getNumLinks(); ++i) joints_.push_back(std::to_array(multibody.getLink(i).m_jointPos));
  }
  void restore(btMultiBody& multibody) const {
    multibody.setBasePos(base_position_);
    multibody.setWorldToBaseRot(world_to_base_);
    for (int i = 0; i < multibody.getNumLinks(); ++i) multibody.setJointPosMultiDof(i, joints_[i].data());
  }

 private:
  btVector3 base_position_;
  btQuaternion world_to_base_;
  std::vector<std::array<btScalar, 7>> joints_;
};

/// Moves the coordinates by a displacement in the place of a velocity. (Bullet can take the displacement as an
/// argument, but then moves planar joints by their velocity.)
void displace(btMultiBody& multibody, const Eigen::VectorXd& displacement) {
  const Eigen::VectorXd velocities = coordinate_velocities(multibody);
  set_coordinate_velocities(multibody, displacement);
  multibody.stepPositionsMultiDof(1);
  set_coordinate_velocities(multibody, velocities);
}

/// Moves and speeds up a floating mechanism, joints locked, until it has from `before`, where it had the velocities
/// `had`, by exactly what the ice gave: its centre of mass by the double integral of the force, its momentum and, about
/// that centre, its angular momentum.
void close_momentum(btMultiBody& multibody, const MultibodyTree& before, const Eigen::VectorXd& had,
                    const MechanismLoad& load, Eigen::VectorXd& velocities) {
  const Vec3 centre = before.centre_of_mass(), displacement = load.momentum_time / before.mass();
  Vec6 momentum = before.momentum(centre) * had;
  momentum.head<3>() += load.momentum;
  // About the world origin the gain is load.angular_momentum; this is the part that is not the centre's own.
  momentum.tail<3>() +=
      load.angular_momentum - centre.cross(load.momentum) - displacement.cross(Vec3(momentum.head<3>()));

  const MultibodyTree moved(multibody);
  multibody.setBasePos(to_bullet(Vec3(moved.position(-1) + centre + displacement - moved.centre_of_mass())));
  const Jacobian inertia = moved.momentum(moved.centre_of_mass());  // the shift does not change it
  velocities.head<6>() +=
      inertia.leftCols<6>().completeOrthogonalDecomposition().solve(momentum - inertia * velocities);
}

void place_colliders(btMultiBody& multibody) {
  btAlignedObjectArray<btQuaternion> world_to_local;
  btAlignedObjectArray<btVector3> local_origin;
  multibody.forwardKinematics(world_to_local, local_origin);
  multibody.updateCollisionObjectWorldTransforms(world_to_local, local_origin);
}

/// The rotation from a link's axes to the world's, for spatial vectors.
Mat6 link_axes(const rigid::Quat& orientation) {
  Mat6 axes = Mat6::Zero();
  axes.topLeftCorner<3, 3>() = axes.bottomRightCorner<3, 3>() = orientation.toRotationMatrix();
  return axes;
}

rigid::Quat turn_by(const Vec3& angle) {
  const double size = angle.norm();
  return size > 0 ? rigid::Quat(Eigen::AngleAxisd(size, angle / size)) : rigid::Quat(rigid::Quat::Identity());
}

/// How a link goes through a step: steady spin, and a point of it, from its centre of mass along its axes, straight on.
struct Course {
  Vec3 pivot;           // m
  Vec3 velocity, spin;  // m/s, of that point; rad/s
};

/// Puts the body where it was dt before it came, on that course, to a pose. Returns how far the farthest of its points
/// was from there at most [m].
double set_out(Body& body, const Course& course, const Vec3& position, const rigid::Quat& orientation, double dt) {
  const rigid::State& now = body.state();
  const rigid::MassProperties& mass = body.spec().mass;
  const rigid::Quat turn = turn_by(-dt * course.spin), start = turn * orientation;
  const Vec3 arm = orientation * -course.pivot, arm_at_start = turn * arm;
  const Vec3 shift = position - arm - dt * course.velocity + arm_at_start - now.position;
  const rigid::Quat back = start * now.orientation.conjugate();
  body.accept(mass.mass * (course.velocity + course.spin.cross(arm_at_start)) - now.momentum,
              rigid::angular_momentum_world(start, mass.inertia, course.spin) - now.angular_momentum, shift, back);
  return shift.norm() + 2 * back.vec().norm() * body.enclosing_radius();
}

void require_unclamped(const btMultiBody& multibody, const Eigen::VectorXd& velocities, const std::string& name) {
  if (velocities.cwiseAbs().maxCoeff() < multibody.getMaxCoordinateVelocity()) return;
  throw std::runtime_error("IcePlugin: Bullet clamps a coordinate velocity of the multibody of body " + name + " at " +
                           std::to_string(multibody.getMaxCoordinateVelocity()) +
                           ": raise it by setMaxCoordinateVelocity");
}

/// A link's mass properties, of which a part that does not move needs none.
rigid::MassProperties mass_of(const btMultiBody& multibody, int link, const rigid::Shape& shape) {
  if (link < 0 && multibody.hasFixedBase()) return rigid::from_density(shape, 1000);
  rigid::MassProperties mass;
  mass.mass = link < 0 ? multibody.getBaseMass() : multibody.getLinkMass(link);
  mass.inertia = rigid::from_bullet(link < 0 ? multibody.getBaseInertia() : multibody.getLinkInertia(link));
  return mass;
}

/// What makes a link one that cannot be attached, or nothing.
std::string obstacle(const btMultiBody& multibody, int link) {
  if (link < -1 || link >= multibody.getNumLinks()) return "is not there";
  if (!collider_of(multibody, link)) return "has no btMultiBodyLinkCollider";
  if (multibody.isBaseKinematic()) return "has a kinematic base";
  for (int i = 0; i < multibody.getNumLinks(); ++i)
    if (multibody.isLinkStaticOrKinematic(i)) return "belongs to a multibody with a static or kinematic link";
  return {};
}

}  // namespace

Body body_of(const btMultiBody& multibody, int link, const rigid::Shape& shape, double boundary_spacing,
             const Vec3& centre_of_mass, const std::string& name) {
  const std::string refused =
      "IcePlugin::attach: body " + name + ", link " + std::to_string(link) + " of a btMultiBody, ";
  if (const std::string why = obstacle(multibody, link); !why.empty()) throw std::invalid_argument(refused + why);
  const Eigen::VectorXd velocities = coordinate_velocities(multibody);
  if (velocities.cwiseAbs().maxCoeff() > kNearClamp * multibody.getMaxCoordinateVelocity())
    throw std::invalid_argument(refused + "has a coordinate velocity of " +
                                std::to_string(velocities.cwiseAbs().maxCoeff()) + ", which Bullet clamps at " +
                                std::to_string(multibody.getMaxCoordinateVelocity()) +
                                ": raise it by setMaxCoordinateVelocity");
  rigid::BodySpec spec;
  spec.name = name;
  spec.shape = shape;
  spec.boundary_spacing = boundary_spacing;
  spec.mass = mass_of(multibody, link, shape);
  if (!(spec.mass.mass > 0) || !(spec.mass.inertia.minCoeff() > 0))
    throw std::invalid_argument(refused + "must have mass, and inertia about all three axes");
  spec.mass.centre_of_mass = centre_of_mass;
  const MultibodyTree tree(multibody);
  const Vec6 velocity = tree.jacobian(link) * velocities;
  spec.position = tree.position(link);
  spec.orientation = tree.orientation(link);
  spec.velocity = velocity.head<3>();
  spec.angular_velocity = velocity.tail<3>();
  return Body(spec);
}

const btCollisionShape& collision_shape(const btMultiBody& multibody, int link) {
  const btMultiBodyLinkCollider* collider = collider_of(multibody, link);
  if (!collider || !collider->getCollisionShape())
    throw std::invalid_argument("IcePlugin::attach: link " + std::to_string(link) + " has no collision shape");
  return *collider->getCollisionShape();
}

HostMultibodyLink::HostMultibodyLink(btMultiBody& multibody, int link, const std::string& name, double largest_push)
    : multibody_(multibody),
      link_(link),
      collider_(collider_of(multibody, link)),
      name_(name),
      largest_push_(largest_push),
      could_sleep_(multibody.getCanSleep()),
      lost_(Eigen::VectorXd::Zero(coordinate_velocities(multibody).size())) {
  multibody.setCanSleep(false);
  multibody.wakeUp();
}

void HostMultibodyLink::release() { multibody_.setCanSleep(could_sleep_); }

HostTurn HostMultibodyLink::take_over(Body& body, double dt, double behind) {
  multibody_.setCanSleep(false);  // another of its links may have been released
  const double way = dt + behind;
  const Eigen::VectorXd velocities = coordinate_velocities(multibody_);
  require_unclamped(multibody_, velocities, name_);
  const Coordinates reached(multibody_);
  const MultibodyTree end(multibody_);
  multibody_.stepPositionsMultiDof(to_bullet(-way / 2));
  const MultibodyTree middle(multibody_);
  reached.restore(multibody_);

  const Mat6 axes = link_axes(middle.orientation(link_));
  const Vec6 velocity = middle.jacobian(link_) * velocities;
  const Vec3 pivot = middle.pivot(link_), spin = velocity.tail<3>();
  const Course course{pivot, velocity.head<3>() + spin.cross(middle.orientation(link_) * pivot), spin};
  response_ = middle.response(link_) * axes;
  HostTurn turn;
  turn.jumped = set_out(body, course, end.position(link_), end.orientation(link_), way) > largest_push_;
  body.join_mechanism(axes.transpose() * middle.jacobian(link_) * response_, pivot);
  return turn;
}

void HostMultibodyLink::hand_back(const Body& body) {
  const MechanismLoad& load = body.mechanism_load();
  if (load.impulse.isZero(0)) return;
  const MultibodyTree before(multibody_);
  const Eigen::VectorXd had = coordinate_velocities(multibody_) + lost_;
  displace(multibody_, response_ * load.impulse_time);
  Eigen::VectorXd velocities = had + response_ * load.impulse;
  if (!multibody_.hasFixedBase()) close_momentum(multibody_, before, had, load, velocities);

  require_unclamped(multibody_, velocities, name_);
  set_coordinate_velocities(multibody_, velocities);
  lost_ = velocities - coordinate_velocities(multibody_);
  place_colliders(multibody_);
}

}  // namespace NILAS_BULLET
}  // namespace nilas
