// V34: a collision of two balls, turned by 37 degrees about x against the lattice: the force turns with it. The force
// is the mean over 2.5 spacings of closing, as the windows of the scenes.
#include <deque>
#include <numbers>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/colliding_balls.hpp"

namespace nilas::cases {

namespace {

struct Collision {
  double peak = 0;             // N, of the window's mean of the axial force
  double impulse = 0;          // N s, axial
  double lateral_impulse = 0;  // N s
};

Collision collide(const Scheme& scheme, double dx, double angle, Measurement& m) {
  CollidingBalls balls;
  balls.axis = {0, -std::sin(angle), std::cos(angle)};
  sph::Ice ice = balls.make(scheme, dx);
  m.particles += ice.particles().size();
  const double window = 2.5 * dx / (2 * CollidingBalls::speed);
  const Vec3 start = momentum_of_first(ice);
  Collision result;
  std::deque<std::pair<double, double>> past{{0, 0}};  // time, impulse
  m.steps += advance(ice, CollidingBalls::duration(scheme, dx), [&](double time, double) {
    const Vec3 impulse = momentum_of_first(ice) - start;
    result.impulse = -impulse.dot(balls.axis);
    result.lateral_impulse = (impulse + result.impulse * balls.axis).norm();
    past.emplace_back(time, result.impulse);
    while (past.size() > 1 && past[1].first <= time - window) past.pop_front();
    result.peak = std::max(result.peak, (result.impulse - past.front().second) / window);
  });
  return result;
}

Measurement run(const Scheme& scheme, int cells_per_diameter) {
  Measurement m;
  m.resolution = m.spacing = CollidingBalls::diameter / cells_per_diameter;
  const Collision along = collide(scheme, m.spacing, 0, m);
  const Collision turned = collide(scheme, m.spacing, 37 * std::numbers::pi / 180, m);
  m.errors = {std::abs(turned.peak / along.peak - 1), std::abs(turned.impulse / along.impulse - 1),
              turned.lateral_impulse / along.impulse};
  return m;
}

}  // namespace

VerificationCase rotated_impact() {
  return {.name = "V34-rotated-impact",
          .title = "A collision of two ice balls, turned by 37 degrees against the lattice",
          .reference = "the same collision along an axis of the lattice",
          .metrics = {{"peak force", 0.05}, {"impulse", 0.05}, {"lateral impulse, of the axial one", 0.05}},
          .resolutions = {12, 16, 24, 32},
          .stated_resolution = 24,
          .quick = 3,
          .tested = 1,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
