// V37: the free top of moments 1, 2, 3 kg m2 from omega = (1, 1, 1) rad/s, against Jacobi's elliptic functions.
#include <algorithm>
#include <cmath>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/free_top.hpp"

namespace nilas::cases {

namespace {

Measurement run(const Scheme&, int steps_per_second) {
  rigid::State state = spinning(top_inertia, Vec3::Ones());
  const Vec3 momentum = state.angular_momentum;
  const double energy = rigid::kinetic_energy(state, 1, top_inertia);
  Measurement m;
  m.resolution = 1. / steps_per_second;
  double velocity_error = 0, momentum_error = 0, energy_error = 0;
  for (const auto& [time, exact] : euler_top_samples) {
    for (; m.steps < static_cast<std::size_t>(std::lround(time * steps_per_second)); ++m.steps) {
      rigid::drift(state, 1, top_inertia, m.resolution);
      momentum_error = std::max(momentum_error, angular_momentum_error(state, top_inertia, momentum));
      energy_error = std::max(energy_error, std::abs(rigid::kinetic_energy(state, 1, top_inertia) / energy - 1));
    }
    velocity_error = std::max(velocity_error, (angular_velocity_body(state, top_inertia) - exact).norm());
  }
  m.errors = {velocity_error, momentum_error, energy_error};
  return m;
}

}  // namespace

VerificationCase euler_top() {
  return {.name = "V37-euler-top",
          .title = "The free rotation of a body with three different moments of inertia",
          .reference = "Jacobi's elliptic functions at 1, 2, 5 and 10 s",
          .metrics = {{"angular velocity, rad/s", 1e-4, second_order}, {"angular momentum", 1e-12}, {"energy", 1e-6}},
          .resolutions = {250, 500, 1000, 2000},
          .stated_resolution = 1000,
          .quick = 4,
          .tested = 3,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
