#include "coupling/body.hpp"

namespace nilas {

namespace {
Vec3 linear_factor_of(rigid::Motion motion) {
  const bool moves = motion == rigid::Motion::free || motion == rigid::Motion::translation_only;
  return moves ? Vec3::Ones() : Vec3::Zero();
}
Vec3 angular_factor_of(rigid::Motion motion) { return motion == rigid::Motion::free ? Vec3::Ones() : Vec3::Zero(); }
}  // namespace

Body::Body(const rigid::BodySpec& spec) : Body(spec, linear_factor_of(spec.motion), angular_factor_of(spec.motion)) {}

Body::Body(const rigid::BodySpec& spec, const Vec3& linear_factor, const Vec3& angular_factor)
    : spec_(spec),
      linear_factor_(linear_factor),
      angular_factor_(angular_factor),
      enclosing_radius_(rigid::enclosing_radius(spec.shape, spec.mass.centre_of_mass)) {
  const bool still = spec.motion == rigid::Motion::fixed;
  state_.position = spec.position;
  state_.orientation = spec.orientation.normalized();
  if (!still) {
    state_.momentum = spec.mass.mass * spec.velocity;
    state_.angular_momentum =
        rigid::angular_momentum_world(state_.orientation, spec.mass.inertia, spec.angular_velocity);
  }
  surface_body_ = rigid::surface_points(spec.shape, spec.boundary_spacing);
  for (rigid::SurfacePoint& p : surface_body_) p.position -= spec.mass.centre_of_mass;
}

Vec3 Body::velocity() const { return rigid::velocity(state_, spec_.mass.mass); }
Vec3 Body::angular_velocity() const { return rigid::angular_velocity_world(state_, spec_.mass.inertia); }
double Body::kinetic_energy() const { return rigid::kinetic_energy(state_, spec_.mass.mass, spec_.mass.inertia); }

void Body::drift(double dt) {
  if (mechanism_) return drift_in_mechanism(dt);
  if (angular_factor_ == Vec3::Ones()) {
    rigid::drift(state_, spec_.mass.mass, spec_.mass.inertia, dt);
    return;
  }
  state_.position += dt * velocity();
  const Vec3 omega = angular_velocity();
  const double rate = omega.norm();
  if (rate == 0) return;
  const Vec3 before = state_.angular_momentum;
  state_.orientation = (rigid::Quat(Eigen::AngleAxisd(rate * dt, omega / rate)) * state_.orientation).normalized();
  state_.angular_momentum = rigid::angular_momentum_world(state_.orientation, spec_.mass.inertia, omega);
  account_.external_angular_impulse += state_.angular_momentum - before;  // what keeps the spin steady
}

void Body::drift_in_mechanism(double dt) {
  MechanismLoad& load = mechanism_->load;
  load.impulse_time += dt * load.impulse;
  load.momentum_time += dt * load.momentum;
  const Vec3 v = velocity(), omega = angular_velocity();
  const double rate = omega.norm();
  const rigid::Quat turn =
      rate > 0 ? rigid::Quat(Eigen::AngleAxisd(rate * dt, omega / rate)) : rigid::Quat(rigid::Quat::Identity());
  const Vec3 arm = state_.orientation * -mechanism_->pivot, turned_arm = turn * arm;
  accept(spec_.mass.mass * omega.cross(turned_arm - arm),
         rigid::angular_momentum_world(turn * state_.orientation, spec_.mass.inertia, omega) - state_.angular_momentum,
         dt * (v - omega.cross(arm)) + (turned_arm - arm), turn);
}

Vec3 Body::allowed_twist(const Vec3& twist) const {
  if (angular_factor_ == Vec3::Ones()) return twist;
  if (angular_factor_.isZero(0)) return Vec3::Zero();
  const Mat3 R = state_.orientation.toRotationMatrix();
  const Mat3 inertia = R * spec_.mass.inertia.asDiagonal() * R.transpose();
  // (P I P) d(omega) = P twist in the free axes, d(omega) = 0 in the locked ones.
  const Mat3 P = angular_factor_.asDiagonal();
  const Mat3 reduced = P * inertia * P + (Mat3::Identity() - P);
  return inertia * reduced.inverse() * (P * twist);
}

Vec6 Body::along_own_axes(const Impulse& impulse) const {
  const rigid::Quat to_body = state_.orientation.conjugate();
  Vec6 own;
  own << to_body * impulse.linear, to_body * impulse.angular;
  return own;
}

Body::Impulse Body::left_in_body(const Impulse& impulse) const {
  if (!mechanism_) return {linear_factor_.cwiseProduct(impulse.linear), allowed_twist(impulse.angular)};
  const Vec6 change = mechanism_->mobility * along_own_axes(impulse);
  return {spec_.mass.mass * (state_.orientation * change.head<3>()),
          state_.orientation * spec_.mass.inertia.cwiseProduct(change.tail<3>())};
}

sph::Surface Body::make_surface() const {
  sph::Surface surface;
  surface.spacing = spec_.boundary_spacing;
  surface.particles.resize(surface_body_.size());
  place(surface);
  for (sph::BoundaryParticle& b : surface.particles) b.force.setZero();
  return surface;
}

void Body::place(sph::Surface& surface) const {
  const Mat3 R = state_.orientation.toRotationMatrix();
  const Vec3 v = velocity(), omega = angular_velocity();
  surface.reference = state_.position;
  for (std::size_t b = 0; b < surface_body_.size(); ++b) {
    const Vec3 lever = R * surface_body_[b].position;
    sph::BoundaryParticle& particle = surface.particles[b];
    particle.position = state_.position + lever;
    particle.velocity = v + omega.cross(lever);
    particle.normal = R * surface_body_[b].normal;
    particle.area = surface_body_[b].area;
  }
}

void Body::kick(const sph::Surface& surface, const ExternalLoad& external, double dt) {
  const Vec3 v_before = velocity(), omega_before = angular_velocity();
  const Vec3 ice_impulse = dt * surface.force, ice_twist = dt * surface.moment;
  const Vec3 host_impulse = dt * external.force, host_twist = dt * external.torque;
  const auto [impulse, twist] = left_in_body({ice_impulse + host_impulse, ice_twist + host_twist});
  rigid::kick(state_, impulse, twist);

  const Vec3 v = 0.5 * (v_before + velocity()), omega = 0.5 * (omega_before + angular_velocity());
  const double ice_work = v.dot(ice_impulse) + omega.dot(ice_twist);
  account_.ice_impulse += ice_impulse;
  account_.ice_angular_impulse += ice_twist;
  account_.ice_work += ice_work;
  for (std::size_t b = 0; b < surface.particles.size() && !surface.force.isZero(0); ++b) {
    const Vec3& force = surface.particles[b].force;
    if (force.isZero(0)) continue;
    account_.contact_impulse += dt * force.norm();
    account_.contact_impulse_moment_body += dt * force.norm() * surface_body_[b].position;
  }
  // All that is not the ice's: the host's loads and the reaction of whatever locks the motion.
  const Vec3 other = impulse - ice_impulse;
  account_.external_impulse += other;
  account_.external_angular_impulse += state_.position.cross(other) + (twist - ice_twist);
  account_.external_work += v.dot(impulse) + omega.dot(twist) - ice_work;
  if (!mechanism_) return;
  MechanismLoad& load = mechanism_->load;
  load.impulse += along_own_axes({ice_impulse, ice_twist});
  load.momentum += ice_impulse;
  load.angular_momentum += state_.position.cross(ice_impulse) + ice_twist;
}

void Body::join_mechanism(const Mat6& mobility, const Vec3& pivot) { mechanism_ = Mechanism{mobility, pivot, {}}; }

void Body::adopt(double mass, const Vec3& inertia, const Vec3& linear_factor, const Vec3& angular_factor) {
  const Vec3 v = velocity(), omega = angular_velocity();
  spec_.mass.mass = mass;
  spec_.mass.inertia = inertia;
  linear_factor_ = linear_factor;
  angular_factor_ = angular_factor;
  accept(mass * v - state_.momentum,
         rigid::angular_momentum_world(state_.orientation, inertia, omega) - state_.angular_momentum, Vec3::Zero(),
         rigid::Quat::Identity());
}

void Body::accept(const Vec3& impulse, const Vec3& angular_impulse, const Vec3& displacement,
                  const rigid::Quat& rotation) {
  const double energy_before = kinetic_energy();
  const Vec3 orbital_before = state_.position.cross(state_.momentum);
  rigid::kick(state_, impulse, angular_impulse);
  state_.position += displacement;
  state_.orientation = (rotation * state_.orientation).normalized();
  account_.external_impulse += impulse;
  account_.external_angular_impulse += state_.position.cross(state_.momentum) - orbital_before + angular_impulse;
  account_.external_work += kinetic_energy() - energy_before;
}

}  // namespace nilas
