// Kinematics and inertia of a btMultiBody at its present coordinates, in double whatever the host's precision.
//
// Coordinate velocities are Bullet's: base angular velocity (3), base velocity (3), both world frame, then the joints'.
// A fixed base has them too; they do not answer to impulses. Poses and Jacobians follow from Bullet's own joint frames;
// the answer to impulses from the dense mass matrix H = SUM J_i^T M_i J_i. It is that of Bullet's articulated-body
// algorithm (calcAccelerationDeltasMultiDof), without that algorithm's side effects: its caches, which the solver reads
// later, joint feedback, and the lack of joint torque at planar joints in Bullet's constraint Jacobian.
// (R. Featherstone, Rigid Body Dynamics Algorithms, Springer 2008, section 6.)
#pragma once

#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <vector>

#include "coupling/body.hpp"
#include "rigid/bullet_precision.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;  // velocity and angular velocity, by coordinate velocities

/// Coordinate velocities as Bullet has them now.
Eigen::VectorXd coordinate_velocities(const btMultiBody& multibody);
/// Writes them, past Bullet's clamp.
void set_coordinate_velocities(btMultiBody& multibody, const Eigen::VectorXd& velocities);

class MultibodyTree {
 public:
  explicit MultibodyTree(const btMultiBody& multibody);

  // `link`: -1 for the base.
  const Vec3& position(int link) const { return parts_[link + 1].position; }               // m, centre of mass, world
  const rigid::Quat& orientation(int link) const { return parts_[link + 1].orientation; }  // link axes to world
  /// The point of the link that its joints move least, along its own axes from its centre of mass [m]: where it turns
  /// on its parent; if it does not turn there, that point of the parent; the base's centre of mass.
  const Vec3& pivot(int link) const { return parts_[link + 1].pivot; }
  /// Of the link's centre of mass and the link, world frame.
  const Jacobian& jacobian(int link) const { return parts_[link + 1].jacobian; }
  /// Coordinate velocities per impulse on the link's centre of mass and angular impulse, world frame: H^-1 J^T.
  Eigen::Matrix<double, Eigen::Dynamic, 6> response(int link) const;
  double mass() const;          // kg, of the whole tree
  Vec3 centre_of_mass() const;  // m, of the whole tree, world frame
  /// Momentum (N s) and angular momentum about a point of the world (N m s) of the whole tree, by coordinate
  /// velocities. The first six columns are the inertia of the tree with its joints locked.
  Jacobian momentum(const Vec3& point) const;

 private:
  struct Part {
    double mass;
    Vec3 inertia;  // kg m2, own axes
    Vec3 position;
    rigid::Quat orientation;
    Vec3 pivot;
    Jacobian jacobian;
  };
  Part base_part(const btMultiBody& multibody) const;
  Part link_part(const btMultibodyLink& link) const;

  bool fixed_base_;
  Eigen::Index size_;        // of the coordinate velocities
  std::vector<Part> parts_;  // base, then links; parents before children, as in Bullet
};

}  // namespace NILAS_BULLET
}  // namespace nilas
