// A rigid body as the coupling sees it: its rigid state, its boundary particles, and the two verbs between them,
// poses in (state -> boundary particles) and loads out (boundary forces -> impulse on the body).
#pragma once

#include <vector>

#include "rigid/spec.hpp"
#include "sph/boundary.hpp"

#pragma GCC visibility push(default)

namespace nilas {

/// Loads from outside the ice that act on a body during a step: gravity, a host's forces. World frame.
struct ExternalLoad {
  Vec3 force = Vec3::Zero();   // N, at the centre of mass
  Vec3 torque = Vec3::Zero();  // N m
};

/// What reached a body since the start. World frame; angular impulses about the world origin.
struct BodyAccount {
  Vec3 ice_impulse = Vec3::Zero();               // N s
  Vec3 ice_angular_impulse = Vec3::Zero();       // N m s, about the body's own centre of mass at each instant
  double ice_work = 0;                           // J
  Vec3 external_impulse = Vec3::Zero();          // N s: host, constraints of the motion
  Vec3 external_angular_impulse = Vec3::Zero();  // N m s
  double external_work = 0;                      // J
};

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

  const rigid::BodySpec& spec() const { return spec_; }
  const rigid::State& state() const { return state_; }
  Vec3 velocity() const;
  Vec3 angular_velocity() const;
  double kinetic_energy() const;
  bool is_free() const { return linear_factor_ == Vec3::Ones() && angular_factor_ == Vec3::Ones(); }
  bool moves_freely() const { return !linear_factor_.isZero(0) || !angular_factor_.isZero(0); }
  const BodyAccount& account() const { return account_; }
  const std::vector<rigid::SurfacePoint>& surface_body() const { return surface_body_; }
  /// An unloaded surface at the present pose, for the ice.
  sph::Surface make_surface() const;

 private:
  /// What an angular impulse leaves in the body once the locked axes have taken up theirs.
  Vec3 allowed_twist(const Vec3& twist) const;

  rigid::BodySpec spec_;
  Vec3 linear_factor_, angular_factor_;
  rigid::State state_;
  std::vector<rigid::SurfacePoint> surface_body_;  // body frame
  BodyAccount account_;
};

}  // namespace nilas

#pragma GCC visibility pop
