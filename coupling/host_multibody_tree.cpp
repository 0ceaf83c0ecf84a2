#include "coupling/host_multibody_tree.hpp"

#include <Eigen/Dense>

#include "rigid/bullet_body.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

using rigid::from_bullet;
using rigid::to_bullet;

namespace {

constexpr int kBase = 6;  // coordinate velocities of the base

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// World frame.
Mat3 inertia_world(const rigid::Quat& orientation, const Vec3& inertia) {
  const Mat3 R = orientation.toRotationMatrix();
  return R * inertia.asDiagonal() * R.transpose();
}

Vec3 pivot_of(const btMultibodyLink& link, const Vec3& pivot_of_parent) {
  switch (link.m_jointType) {
    case btMultibodyLink::eRevolute:
    case btMultibodyLink::eSpherical:
      return -from_bullet(link.m_dVector);
    case btMultibodyLink::ePlanar:
      return Vec3::Zero();
    default:
      return from_bullet(link.m_cachedRotParentToThis) * pivot_of_parent - from_bullet(link.m_cachedRVector);
  }
}

}  // namespace

Eigen::VectorXd coordinate_velocities(const btMultiBody& multibody) {
  Eigen::VectorXd velocities(kBase + multibody.getNumDofs());
  for (Eigen::Index k = 0; k < velocities.size(); ++k) velocities[k] = multibody.getVelocityVector()[k];
  return velocities;
}

void set_coordinate_velocities(btMultiBody& multibody, const Eigen::VectorXd& velocities) {
  multibody.setBaseOmega(to_bullet(Vec3(velocities.head<3>())));
  multibody.setBaseVel(to_bullet(Vec3(velocities.segment<3>(3))));
  for (int i = 0; i < multibody.getNumLinks(); ++i)
    multibody.setJointVelMultiDof(i, velocities.data() + kBase + multibody.getLink(i).m_dofOffset);
}

MultibodyTree::MultibodyTree(const btMultiBody& multibody)
    : fixed_base_(multibody.hasFixedBase()), size_(kBase + multibody.getNumDofs()) {
  parts_.push_back(base_part(multibody));
  for (int i = 0; i < multibody.getNumLinks(); ++i) parts_.push_back(link_part(multibody.getLink(i)));
}

MultibodyTree::Part MultibodyTree::base_part(const btMultiBody& multibody) const {
  Part base{multibody.getBaseMass(),
            from_bullet(multibody.getBaseInertia()),
            from_bullet(multibody.getBasePos()),
            from_bullet(multibody.getWorldToBaseRot()).conjugate().normalized(),
            Vec3::Zero(),
            Jacobian::Zero(6, size_)};
  base.jacobian.block<3, 3>(0, 3).setIdentity();
  base.jacobian.block<3, 3>(3, 0).setIdentity();
  return base;
}

MultibodyTree::Part MultibodyTree::link_part(const btMultibodyLink& link) const {
  const Part& parent = parts_[link.m_parent + 1];
  const rigid::Quat orientation =
      (parent.orientation * from_bullet(link.m_cachedRotParentToThis).conjugate()).normalized();
  const Vec3 lever = orientation * from_bullet(link.m_cachedRVector);  // from the parent's centre of mass
  Part part{link.m_mass, from_bullet(link.m_inertiaLocal), parent.position + lever,
            orientation, pivot_of(link, parent.pivot),     parent.jacobian};
  part.jacobian.topRows<3>() -= cross_matrix(lever) * parent.jacobian.bottomRows<3>();
  // Bullet's joint axes are those of the link's centre of mass, along the link's axes.
  for (int dof = 0; dof < link.m_dofCount; ++dof) {
    part.jacobian.col(kBase + link.m_dofOffset + dof) << orientation * from_bullet(link.getAxisBottom(dof)),
        orientation * from_bullet(link.getAxisTop(dof));
  }
  return part;
}

Eigen::Matrix<double, Eigen::Dynamic, 6> MultibodyTree::response(int link) const {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size_, size_);
  for (const Part& part : parts_) {
    const auto v = part.jacobian.topRows<3>(), omega = part.jacobian.bottomRows<3>();
    H += part.mass * v.transpose() * v + omega.transpose() * inertia_world(part.orientation, part.inertia) * omega;
  }
  const Eigen::Index held = fixed_base_ ? kBase : 0, free = size_ - held;
  Eigen::Matrix<double, Eigen::Dynamic, 6> response = Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(size_, 6);
  // A joint without any inertia behind it does not answer, as in Bullet: LDLT leaves out zero pivots.
  if (free > 0)
    response.bottomRows(free) =
        H.bottomRightCorner(free, free).ldlt().solve(jacobian(link).rightCols(free).transpose().eval());
  return response;
}

double MultibodyTree::mass() const {
  double mass = 0;
  for (const Part& part : parts_) mass += part.mass;
  return mass;
}

Vec3 MultibodyTree::centre_of_mass() const {
  Vec3 moment = Vec3::Zero();
  for (const Part& part : parts_) moment += part.mass * part.position;
  return moment / mass();
}

Jacobian MultibodyTree::momentum(const Vec3& point) const {
  Jacobian momentum = Jacobian::Zero(6, size_);
  for (const Part& part : parts_) {
    const Eigen::Matrix<double, 3, Eigen::Dynamic> linear = part.mass * part.jacobian.topRows<3>();
    momentum.topRows<3>() += linear;
    momentum.bottomRows<3>() += cross_matrix(part.position - point) * linear +
                                inertia_world(part.orientation, part.inertia) * part.jacobian.bottomRows<3>();
  }
  return momentum;
}

}  // namespace NILAS_BULLET
}  // namespace nilas
