// V23: two equal elastic ice spheres collide head-on: Hertz with R/2, m/2 and E* = E/(2 (1 - nu^2)); they exchange
// their velocities. There is no body: ice meets ice through the kernel alone, and parts as it met.
#include <cmath>
#include <numbers>

#include "cases/accuracy/advance.hpp"
#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/contact_oracles.hpp"
#include "cases/accuracy/force_history.hpp"

namespace nilas::cases {

namespace {

constexpr double radius = 0.03;   // m
constexpr double relative = 0.2;  // contact radius / R, as in V22

sph::Ice make_spheres(const Scheme& scheme, double dx, double speed) {
  sph::IceSpec ice;
  sph::PieceSpec left;
  left.shape = sph::IceShape::sphere;
  left.diameter = 2 * radius;
  left.centre = {-radius, 0, 0};
  left.velocity = {speed, 0, 0};
  sph::PieceSpec right = left;
  right.centre = -left.centre;
  right.velocity = -left.velocity;
  ice.pieces = {left, right};
  ice.spacing = dx;
  ice.material.model = sph::Model::elastic;
  ice.numerics = scheme.numerics;
  return sph::Ice(ice);
}

/// Of the right sphere, along x [N s].
double right_momentum(const sph::Ice& ice) {
  const sph::Particles& p = ice.particles();
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.id[i] >= p.size() / 2) sum += p.mass * p.motion[i].velocity[0];
  return sum;
}

Measurement run(const Scheme& scheme, int cells_per_diameter) {
  const double dx = 2 * radius / cells_per_diameter;
  const sph::MaterialSpec material;
  const double nu = material.poisson_ratio, modulus = material.young_modulus / (2 * (1 - nu * nu));
  const double mass = 4. / 3 * std::numbers::pi * std::pow(radius, 3) * material.density;
  // Each sphere's speed: half of the relative one, at which d = relative^2 R/2 (contact radius^2 = R d/2).
  const double closing = std::sqrt(16 * modulus * std::sqrt(radius / 2) *
                                   std::pow(2 * relative * relative * radius, 2.5) / (15 * mass / 2));
  const HertzImpact hertz(mass / 2, radius / 2, modulus, closing);

  sph::Ice ice = make_spheres(scheme, dx, closing / 2);
  const double start = right_momentum(ice);
  ForceHistory force;
  Measurement m;
  m.resolution = m.spacing = dx;
  m.particles = ice.particles().size();
  m.steps =
      advance(ice, 1.6 * hertz.duration, [&](double time, double) { force.add(time, right_momentum(ice) - start); });

  const double window = hertz.duration / 20, level = 0.1;
  const double peak = force.peak(window), duration = force.time_above(level * peak, window);
  m.errors = {std::abs(peak / hertz.force - 1), std::abs(duration / (hertz_time_above(level) * hertz.duration) - 1),
              std::abs(right_momentum(ice) / start + 1)};
  return m;
}

}  // namespace

VerificationCase hertz_spheres() {
  return {.name = "V23-hertz-spheres",
          .title = "Two equal elastic ice spheres collide head-on; contact radius a fifth of theirs",
          .reference = "Hertz with R/2, m/2, E/(2 (1 - nu^2)); the velocities are exchanged",
          .metrics = {{"peak force", 0.10}, {"duration", 0.10}, {"exchanged velocity", 0.10}},
          .resolutions = {20, 30, 40, 60},
          .stated_resolution = 40,
          .quick = 2,
          .tested = 1,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
