// V39: the free rotation of the homogeneous HCC, omega = (1, 0, 100) rad/s in its frame. Seen from the body omega turns
// about the axis at (I_t - I_a)/I_t 100 rad/s; seen from the world the axis turns about L at L/I_t. The integrator
// rotates a body with two equal moments exactly, whatever the step: no order, only round-off.
#include <algorithm>
#include <cmath>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/free_top.hpp"

namespace nilas::cases {

namespace {

Measurement run(const Scheme&, int steps_per_second) {
  const Vec3 inertia = rigid::from_density(rigid::Hcc{1.8, 0.3, 0.2}, 1500).inertia;
  const double spin = 100;  // rad/s
  rigid::State state = spinning(inertia, {1, 0, spin});
  const Vec3 momentum = state.angular_momentum;
  const double nutation = (inertia.x() - inertia.z()) / inertia.x() * spin;
  const double precession = momentum.norm() / inertia.x();
  Measurement m;
  m.resolution = 1. / steps_per_second;
  double velocity_error = 0, axis_error = 0, momentum_error = 0;
  while (m.steps < static_cast<std::size_t>(steps_per_second)) {
    rigid::drift(state, 1, inertia, m.resolution);
    const double t = m.resolution * static_cast<double>(++m.steps);
    const Vec3 exact(std::cos(nutation * t), -std::sin(nutation * t), spin);
    const Vec3 axis = Eigen::AngleAxisd(precession * t, momentum.normalized()) * Vec3::UnitZ();
    velocity_error = std::max(velocity_error, (angular_velocity_body(state, inertia) - exact).norm());
    axis_error = std::max(axis_error, (state.orientation * Vec3::UnitZ() - axis).norm());
    momentum_error = std::max(momentum_error, angular_momentum_error(state, inertia, momentum));
  }
  m.errors = {velocity_error, axis_error, momentum_error};
  return m;
}

}  // namespace

VerificationCase symmetric_top() {
  return {.name = "V39-symmetric-top",
          .title = "The free rotation of an HCC that spins about its axis",
          .reference = "Closed form: nutation 95.69005 rad/s, precession 4.42444 rad/s; any step is exact",
          .metrics = {{"angular velocity, rad/s", 1e-3}, {"direction of the axis", 1e-3}, {"angular momentum", 1e-12}},
          .resolutions = {10, 100, 1000},
          .stated_resolution = 10,
          .quick = 3,
          .tested = 3,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
