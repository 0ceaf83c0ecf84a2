// V32: the same collision, displaced by 1 km and seen from a frame that moves with 1 km/s: identical but for round-off.
#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/colliding_balls.hpp"

namespace nilas::cases {

namespace {

Measurement run(const Scheme& scheme, int cells_per_diameter) {
  Measurement m;
  m.resolution = m.spacing = CollidingBalls::diameter / cells_per_diameter;
  const CollidingBalls at_rest;
  const CollidingBalls moving{.centre = Vec3(600, 0, 800), .velocity = Vec3(0, 800, 600)};
  sph::Ice a = at_rest.make(scheme, m.spacing), b = moving.make(scheme, m.spacing);
  m.particles = a.particles().size() + b.particles().size();
  const double end = CollidingBalls::duration(scheme, m.spacing);
  const auto ignore = [](double, double) {};
  m.steps = advance(a, end, ignore) + advance(b, end, ignore);
  const auto in_a = a.creation_order(), in_b = b.creation_order();
  double velocity = 0, stress = 0, largest_stress = 0;
  for (std::size_t i = 0; i < in_a.size(); ++i) {
    const sph::Motion &of_a = a.particles().motion[in_a[i]], &of_b = b.particles().motion[in_b[i]];
    velocity = std::max(velocity, (of_b.velocity - moving.velocity - of_a.velocity).norm());
    const sph::Sym3 s = a.particles().stress[in_a[i]], difference = s + (-1) * b.particles().stress[in_b[i]];
    stress = std::max(stress, std::sqrt(contract(difference, difference)));
    largest_stress = std::max(largest_stress, std::sqrt(contract(s, s)));
  }
  m.errors = {velocity / CollidingBalls::speed, stress / largest_stress};
  return m;
}

}  // namespace

VerificationCase galilean_invariance() {
  return {.name = "V32-galilean-invariance",
          .title = "A collision of two ice balls, displaced by 1 km and moving with 1 km/s",
          .reference = "the same collision at rest at the origin; largest difference of any particle",
          .metrics = {{"velocity", 1e-6}, {"stress", 1e-6}},
          .resolutions = {8, 12, 16},
          .stated_resolution = 8,
          .quick = 3,
          .tested = 2,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
