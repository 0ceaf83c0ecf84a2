// V38: the free top of moments 1, 2, 3 kg m2 spun about the axis of the middle one, omega = (0.01, 5, 0.01) rad/s: it
// flips over every 5.026 s.
#include <algorithm>
#include <cmath>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/free_top.hpp"

namespace nilas::cases {

namespace {

Measurement run(const Scheme&, int steps_per_second) {
  rigid::State state = spinning(top_inertia, {0.01, 5, 0.01});
  const Vec3 momentum = state.angular_momentum;
  Measurement m;
  m.resolution = 1. / steps_per_second;
  double velocity_error = 0, momentum_error = 0;
  std::vector<double> crossings;  // times at which the large component changes sign
  double before = 5;
  for (const auto& [time, exact] : dzhanibekov_samples) {
    while (m.steps < static_cast<std::size_t>(std::lround(time * steps_per_second))) {
      rigid::drift(state, 1, top_inertia, m.resolution);
      ++m.steps;
      momentum_error = std::max(momentum_error, angular_momentum_error(state, top_inertia, momentum));
      const double now = angular_velocity_body(state, top_inertia).y();
      if (before * now < 0) crossings.push_back(m.resolution * (static_cast<double>(m.steps) - now / (now - before)));
      before = now;
    }
    velocity_error = std::max(velocity_error, (angular_velocity_body(state, top_inertia) - exact).norm());
  }
  // A body that has not flipped twice in 10 s is wrong by the whole time.
  const double flip = crossings.size() < 2 ? 0 : crossings[1] - crossings[0];
  m.errors = {std::abs(flip - dzhanibekov_flip), velocity_error, momentum_error};
  return m;
}

}  // namespace

VerificationCase dzhanibekov() {
  return {.name = "V38-dzhanibekov",
          .title = "The free rotation of a body about the axis of its middle moment of inertia: it flips",
          .reference = "Jacobi's elliptic functions at 2, 3, 5 and 10 s; 5.025929138 s from flip to flip",
          .metrics = {{"flip time, s", 1e-3},
                      {"angular velocity, rad/s", Metric::none, second_order},
                      {"angular momentum", 1e-12}},
          .resolutions = {500, 1000, 2000, 4000},
          .stated_resolution = 1000,
          .quick = 4,
          .tested = 3,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
