// V40: constant force and constant torque about a principal axis, each step put together from another list of point
// forces on the body (wrench reduction): position, velocity, angle and angular velocity in closed form.
#include <cmath>

#include "cases/accuracy/catalogue.hpp"
#include "coupling/body.hpp"

namespace nilas::cases {

namespace {

const Vec3 force(3, -2, 7);     // N
constexpr double torque = 0.6;  // N m
constexpr double end = 2;       // s

struct PointForce {
  Vec3 arm;    // m, from the centre of mass, world
  Vec3 force;  // N
};

/// Point forces with the resultant `force` and the moment torque * axis: n shares of the force at the ends of opposite
/// arms, and n couples of arms that grow; another n every step.
std::vector<PointForce> point_forces(const Vec3& axis, int n) {
  const Vec3 along = axis.unitOrthogonal(), across = axis.cross(along);
  std::vector<PointForce> list;
  for (int k = 1; k <= n; ++k) {
    const Vec3 arm = 0.1 * k * (along + 0.5 * axis);
    const Vec3 couple = torque / (n * 2 * arm.dot(along)) * across;
    // The couple's own moment, 2 arm x couple, has a part across the axis where the arm has one along it.
    const Vec3 level = arm.dot(along) * along;
    list.push_back({arm, force / (2 * n)});
    list.push_back({-arm, force / (2 * n)});
    list.push_back({level, couple});
    list.push_back({-level, -couple});
  }
  return list;
}

/// The wrench of the list about the centre of mass.
ExternalLoad reduced(const std::vector<PointForce>& list) {
  ExternalLoad load;
  for (const PointForce& p : list) load.force += p.force, load.torque += p.arm.cross(p.force);
  return load;
}

Measurement run(const Scheme&, int steps) {
  rigid::BodySpec spec;
  spec.shape = rigid::Box{Vec3(0.3, 0.4, 0.5)};
  spec.boundary_spacing = 0.1;
  spec.mass = {4, Vec3::Zero(), Vec3(0.2, 0.25, 0.3)};
  spec.orientation = rigid::Quat(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()));
  spec.velocity = {0.25, 0.5, 0.75};
  const double dt = end / steps, mass = spec.mass.mass;
  Measurement m;
  m.resolution = dt;
  m.errors.assign(4, 0);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 direction = spec.orientation * Vec3::Unit(axis);
    Body body(spec);
    const sph::Surface no_ice = body.make_surface();
    for (int n = 0; n < steps; ++n, ++m.steps) {
      body.drift(dt / 2);
      body.kick(no_ice, reduced(point_forces(direction, 1 + n % 7)), dt);
      body.drift(dt / 2);
    }
    const double spin = torque / spec.mass.inertia[axis];  // rad/s2
    const Vec3 velocity = spec.velocity + end / mass * force;
    const Vec3 position = end * spec.velocity + 0.5 * end * end / mass * force;
    const rigid::Quat turned = rigid::Quat(Eigen::AngleAxisd(0.5 * spin * end * end, direction)) * spec.orientation;
    const double errors[] = {(body.state().position - position).norm() / position.norm(),
                             (body.velocity() - velocity).norm() / velocity.norm(),
                             body.state().orientation.angularDistance(turned),
                             (body.angular_velocity() - spin * end * direction).norm() / (spin * end)};
    for (int k = 0; k < 4; ++k) m.errors[k] = std::max(m.errors[k], errors[k]);
  }
  return m;
}

}  // namespace

VerificationCase constant_load() {
  return {.name = "V40-constant-load",
          .title = "Constant force and torque on a free body, from a list of point forces that changes every step",
          .reference = "x = v0 t + F t^2/(2M), angle = T t^2/(2I), in closed form",
          .metrics = {{"position", 1e-10}, {"velocity", 1e-10}, {"angle, rad", 1e-10}, {"angular velocity", 1e-10}},
          .resolutions = {10, 100, 1000},
          .stated_resolution = 10,
          .quick = 3,
          .tested = 3,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
