#include "rigid/state.hpp"

#include <algorithm>

namespace nilas::rigid {
namespace {

constexpr double equal_moments = 1e-12;  // relative difference

/// Rotation by |v| about v.
Quat rotation(const Vec3& v) {
  const double angle = v.norm();
  return angle > 0 ? Quat(Eigen::AngleAxisd(angle, v / angle)) : Quat(Quat::Identity());
}

/// The axis of revolution, that of the moment that differs, or -1.
int axis_of_revolution(const Vec3& inertia) {
  for (int k = 2; k >= 0; --k) {
    const double a = inertia[(k + 1) % 3], b = inertia[(k + 2) % 3];
    if (std::abs(a - b) <= equal_moments * std::max(a, b)) return k;
  }
  return -1;
}

/// omega = L/I_t + (1/I_a - 1/I_t) (L . e) e, e the axis of revolution: a steady turn about L after a steady spin about
/// the body's axis.
Quat rotate_symmetric(const Quat& orientation, const Vec3& angular_momentum, const Vec3& inertia, int axis, double dt) {
  const double transverse = inertia[(axis + 1) % 3];
  const Vec3 in_body = orientation.conjugate() * angular_momentum;
  const double spin = (1 / inertia[axis] - 1 / transverse) * in_body[axis];
  return rotation(dt / transverse * angular_momentum) * orientation * rotation(dt * spin * Vec3::Unit(axis));
}

/// Dullweber, Leimkuhler and McLachlan: the flow of (L . e_i)^2 / (2 I_i) turns the body about its axis e_i by
/// dt (L . e_i) / I_i, and L seen from the body the other way.
Quat rotate_split(Quat orientation, const Vec3& angular_momentum, const Vec3& inertia, double dt) {
  Vec3 in_body = orientation.conjugate() * angular_momentum;
  const auto turn = [&](int axis, double duration) {
    const Quat by = rotation(duration * in_body[axis] / inertia[axis] * Vec3::Unit(axis));
    orientation = orientation * by;
    in_body = by.conjugate() * in_body;
  };
  turn(0, 0.5 * dt);
  turn(1, 0.5 * dt);
  turn(2, dt);
  turn(1, 0.5 * dt);
  turn(0, 0.5 * dt);
  return orientation;
}

}  // namespace

void drift(State& state, double mass, const Vec3& inertia, double dt) {
  state.position += dt / mass * state.momentum;
  const int axis = axis_of_revolution(inertia);
  const Quat turned = axis < 0 ? rotate_split(state.orientation, state.angular_momentum, inertia, dt)
                               : rotate_symmetric(state.orientation, state.angular_momentum, inertia, axis, dt);
  state.orientation = turned.normalized();
}

void kick(State& state, const Vec3& impulse, const Vec3& angular_impulse) {
  state.momentum += impulse;
  state.angular_momentum += angular_impulse;
}

Vec3 velocity(const State& state, double mass) { return state.momentum / mass; }

Vec3 angular_velocity_world(const State& state, const Vec3& inertia) {
  const Vec3 in_body = state.orientation.conjugate() * state.angular_momentum;
  return state.orientation * Vec3(in_body.cwiseQuotient(inertia));
}

Vec3 angular_momentum_world(const Quat& orientation, const Vec3& inertia, const Vec3& angular_velocity_world) {
  const Vec3 in_body = orientation.conjugate() * angular_velocity_world;
  return orientation * Vec3(in_body.cwiseProduct(inertia));
}

double kinetic_energy(const State& state, double mass, const Vec3& inertia) {
  const Vec3 in_body = state.orientation.conjugate() * state.angular_momentum;
  return 0.5 * (state.momentum.squaredNorm() / mass + in_body.cwiseAbs2().cwiseQuotient(inertia).sum());
}

Quat orientation_along(const Vec3& axis) {
  const double across2 = axis.x() * axis.x() + axis.y() * axis.y();
  if (across2 == 0 && axis.z() < 0) return Quat(0, 1, 0, 0);
  // (1 + cos, z x axis), which is twice the cosine of the half angle times the quaternion; 1 + cos without cancellation
  // near -z.
  const double one_plus_cos = axis.z() < 0 ? across2 / (1 - axis.z()) : 1 + axis.z();
  return Quat(one_plus_cos, -axis.y(), axis.x(), 0).normalized();
}

}  // namespace nilas::rigid
