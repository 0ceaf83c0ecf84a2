// V33: a head-on collision of two balls on lattices that are symmetric about its axis exerts no lateral force.
#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/colliding_balls.hpp"

namespace nilas::cases {

namespace {

Measurement run(const Scheme& scheme, int cells_per_diameter) {
  Measurement m;
  m.resolution = m.spacing = CollidingBalls::diameter / cells_per_diameter;
  sph::Ice ice = CollidingBalls{}.make(scheme, m.spacing);
  m.particles = ice.particles().size();
  const double start = momentum_of_first(ice)[2];
  m.steps = advance(ice, CollidingBalls::duration(scheme, m.spacing), [](double, double) {});
  const Vec3 momentum = momentum_of_first(ice);
  m.errors = {momentum.head<2>().norm() / std::abs(momentum[2] - start)};
  return m;
}

}  // namespace

VerificationCase mirror_symmetry() {
  return {.name = "V33-mirror-symmetry",
          .title = "Two ice balls collide head-on along an axis of the lattice",
          .reference = "symmetry: no lateral impulse",
          .metrics = {{"lateral impulse, of the axial one", 1e-9}},
          .resolutions = {8, 12, 16},
          .stated_resolution = 8,
          .quick = 3,
          .tested = 3,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
