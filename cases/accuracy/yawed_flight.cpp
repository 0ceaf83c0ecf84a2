// V41: an HCC flies at 100 m/s with a small yaw theta under the restoring moment -k theta: theta0 cos(sqrt(k/I) t). The
// moment comes as an outside load on the body, as it would from the ice.
#include <algorithm>
#include <cmath>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/free_top.hpp"
#include "coupling/body.hpp"

namespace nilas::cases {

namespace {

constexpr double yaw = 0.05;        // rad, theta0
constexpr double stiffness = 2000;  // N m, k
constexpr double periods = 3;

Measurement run(const Scheme&, int steps_per_period) {
  rigid::BodySpec spec;
  spec.shape = rigid::Hcc{1.8, 0.3, 0.2};
  spec.boundary_spacing = 0.1;
  spec.mass = rigid::from_density(spec.shape, 1500);
  spec.orientation = rigid::Quat(Eigen::AngleAxisd(yaw, Vec3::UnitX()));
  spec.velocity = {0, 0, 100};
  const double rate = std::sqrt(stiffness / spec.mass.inertia.x());
  const double dt = 2 * std::numbers::pi / rate / steps_per_period;
  Body body(spec);
  const sph::Surface no_ice = body.make_surface();
  Measurement m;
  m.resolution = dt;
  double yaw_error = 0;
  // The axis turns in the plane of y and z: theta is the turn about x.
  const auto theta = [&] {
    const Vec3 axis = body.state().orientation * Vec3::UnitZ();
    return std::atan2(-axis.y(), axis.z());
  };
  while (m.steps < static_cast<std::size_t>(periods * steps_per_period)) {
    body.drift(dt / 2);
    body.kick(no_ice, {.torque = Vec3(-stiffness * theta(), 0, 0)}, dt);
    body.drift(dt / 2);
    const double t = dt * static_cast<double>(++m.steps);
    yaw_error = std::max(yaw_error, std::abs(theta() - yaw * std::cos(rate * t)) / yaw);
  }
  const double flown = 100 * dt * static_cast<double>(m.steps);
  m.errors = {yaw_error, (body.state().position - Vec3(0, 0, flown)).norm() / flown};
  return m;
}

}  // namespace

VerificationCase yawed_flight() {
  return {.name = "V41-yawed-flight",
          .title = "An HCC in flight under a moment that turns it back into its path",
          .reference = "theta = theta0 cos(sqrt(k/I) t) over three periods; the tolerance is for steps of 1 ms",
          .metrics = {{"yaw, in its amplitude", 1e-4, second_order}, {"path", 1e-12}},
          .resolutions = {125, 250, 500, 1000},
          .stated_resolution = 1000,
          .quick = 4,
          .tested = 4,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
