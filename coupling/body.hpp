// A rigid body as the coupling sees it: its rigid state, its boundary particles, and the two verbs between them,
// poses in (state -> boundary particles) and loads out (boundary forces -> impulse on the body).
#pragma once

#include <optional>
#include <vector>

#include "rigid/spec.hpp"
#include "sph/boundary.hpp"

#pragma GCC visibility push(default)

namespace nilas {

/// Spatial vectors and matrices: linear part first, then angular, both at a centre of mass.
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Loads from outside the ice that act on a body during a step: gravity, a host's forces. World frame.
struct ExternalLoad {
  Vec3 force = Vec3::Zero();   // N, at the centre of mass
  Vec3 torque = Vec3::Zero();  // N m
};

/// What reached a body since the start. World frame; angular impulses about the world origin.
struct BodyAccount {
  Vec3 ice_impulse = Vec3::Zero();          // N s
  Vec3 ice_angular_impulse = Vec3::Zero();  // N m s, about the body's own centre of mass at each instant
  double ice_work = 0;                      // J
  double contact_impulse = 0;               // N s, SUM |f_b| dt over boundary particles and sub-steps
  Vec3 contact_impulse_moment_body =
      Vec3::Zero();                              // N m s, SUM |f_b| r_b dt with their positions r_b in the body frame
  Vec3 external_impulse = Vec3::Zero();          // N s: host, constraints of the motion
  Vec3 external_angular_impulse = Vec3::Zero();  // N m s
  double external_work = 0;                      // J
};

/// What the ice did to a body that is part of a mechanism since the mechanism's step began; *_time: its integral over
/// time.
struct MechanismLoad {
  // As the body felt it, along its own axes: N s, N m s.
  Vec6 impulse = Vec6::Zero(), impulse_time = Vec6::Zero();
  // What mechanism and mounting must gain, world frame; angular momentum about the world origin: N s, N m s.
  Vec3 momentum = Vec3::Zero(), momentum_time = Vec3::Zero();
  Vec3 angular_momentum = Vec3::Zero();
};

/// How a body takes part. away: not in its host's world, stays as it is. unfelt: moves, but does not meet the ice.
enum class Presence { away, unfelt, felt };

class Body {
 public:
  /// Samples the surface of the shape. World axes along which the motion is locked take no impulse: what the ice gives
  /// there is taken up by the constraint and booked as external.
  explicit Body(const rigid::BodySpec& spec);
  /// With locks stated per world axis (1 free, 0 locked), as Bullet's linear and angular factors.
  Body(const rigid::BodySpec& spec, const Vec3& linear_factor, const Vec3& angular_factor);

  /// Free flight over dt. A body whose rotation is locked about any axis keeps its angular velocity.
  void drift(double dt);
  /// Poses in: places the boundary particles for the present state.
  void place(sph::Surface& surface) const;
  /// Loads out: applies the impulse of the ice's forces on the surface over dt, and the external load's.
  void kick(const sph::Surface& surface, const ExternalLoad& external, double dt);
  /// Takes a change of momentum and position that a host has made (contacts, joints, damping, impulses, a push).
  void accept(const Vec3& impulse, const Vec3& angular_impulse, const Vec3& displacement, const rigid::Quat& rotation);
  /// Takes mass [kg], principal inertia [kg m2] and locks that a host has changed; velocity and spin stay.
  void adopt(double mass, const Vec3& inertia, const Vec3& linear_factor, const Vec3& angular_factor);
  /// Makes the body a part of a mechanism (a link of a multibody) for a step of its host; mechanism_load() starts anew.
  /// Loads then change the velocities by `mobility`, velocity (m/s, rad/s) per impulse (N s, N m s) along the body's
  /// axes, instead of by mass and inertia; between loads the spin is steady and the point `pivot` of the body goes
  /// straight. pivot [m]: from the centre of mass, along the body's axes. The momentum is that of the body alone; what
  /// joints take of the ice's impulse is booked as external.
  void join_mechanism(const Mat6& mobility, const Vec3& pivot);
  /// What the ice did since join_mechanism.
  const MechanismLoad& mechanism_load() const { return mechanism_->load; }

  const rigid::BodySpec& spec() const { return spec_; }
  const rigid::State& state() const { return state_; }
  Vec3 velocity() const;
  Vec3 angular_velocity() const;
  double kinetic_energy() const;
  double enclosing_radius() const { return enclosing_radius_; }  // m, about the centre of mass
  bool is_free() const { return linear_factor_ == Vec3::Ones() && angular_factor_ == Vec3::Ones(); }
  bool moves_freely() const { return !linear_factor_.isZero(0) || !angular_factor_.isZero(0); }
  const BodyAccount& account() const { return account_; }
  const std::vector<rigid::SurfacePoint>& surface_body() const { return surface_body_; }
  /// An unloaded surface at the present pose, for the ice.
  sph::Surface make_surface() const;

 private:
  struct Mechanism {
    Mat6 mobility;
    Vec3 pivot;
    MechanismLoad load;
  };
  /// A linear and an angular impulse; world frame, the latter about the centre of mass.
  struct Impulse {
    Vec3 linear, angular;
  };
  void drift_in_mechanism(double dt);
  /// What an impulse leaves in the body once joints and locked axes have taken up theirs.
  Impulse left_in_body(const Impulse& impulse) const;
  /// The same for an angular impulse and locked axes.
  Vec3 allowed_twist(const Vec3& twist) const;
  Vec6 along_own_axes(const Impulse& impulse) const;

  rigid::BodySpec spec_;
  Vec3 linear_factor_, angular_factor_;
  rigid::State state_;
  std::vector<rigid::SurfacePoint> surface_body_;  // body frame
  double enclosing_radius_;                        // m
  BodyAccount account_;
  std::optional<Mechanism> mechanism_;
};

}  // namespace nilas

#pragma GCC visibility pop
