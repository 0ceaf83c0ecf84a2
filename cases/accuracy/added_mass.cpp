// V24: a rigid sphere that is suddenly set in motion in a medium without strength: added mass.
//
// The motion is a dipole, odd in z about the plane through the centre across the motion, where the pressure therefore
// vanishes: a sphere half immersed under a free surface meets half of the force that it would meet in unbounded medium.
// That half is run, because the other would be pulled and contact cannot pull. For the same reason the sphere, which is
// given the velocity v0, is also pushed by a steady force: it keeps the medium pressed where the force after the start
// alone would swing through zero. The solution (contact_oracles.hpp) is exact for all times; the box is so large that
// its echo comes when the run ends. The layer of particles at the sphere is put on it: a lattice cut off at the sphere
// would touch it here and there only, and motions this small do not close the gaps.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/contact_oracles.hpp"
#include "coupling/impact.hpp"

namespace nilas::cases {

namespace {

constexpr double radius = 0.1;    // m, a
constexpr double speed = 1;       // m/s, v0
constexpr double push = 0.25;     // steady force over M c v0/a
constexpr double half_box = 3;    // a
constexpr double end = 4;         // a/c: when the echo from the box is back
constexpr double mass_ratio = 1;  // of the medium that the immersed half displaces to the sphere

sph::IceSpec medium(const Scheme& scheme, double dx) {
  sph::IceSpec ice;
  sph::PieceSpec block;
  block.shape = sph::IceShape::block;
  block.size = radius * Vec3(2 * half_box, 2 * half_box, half_box);
  block.centre = {0, 0, -block.size.z() / 2};
  ice.pieces = {block};
  ice.spacing = dx;
  // Von Mises with next to no strength and no limit to tension: pressure of either sign, nothing else.
  ice.material.cohesion = 1;
  ice.material.friction_angle_deg = ice.material.dilation_angle_deg = 0;
  ice.material.after_failure = sph::AfterFailure::plastic;
  ice.numerics = scheme.numerics;
  ice.contact = scheme.contact;
  return ice;
}

Body sphere(double dx, double mass) {
  rigid::BodySpec body;
  body.name = "sphere";
  body.shape = rigid::Sphere{2 * radius};
  body.boundary_spacing = 0.75 * dx;
  body.mass = rigid::from_mass(body.shape, mass);
  body.motion = rigid::Motion::translation_only;
  body.velocity = {0, 0, -speed};
  return Body(body);
}

Measurement run(const Scheme& scheme, int cells_per_radius) {
  const double dx = radius / cells_per_radius;
  const sph::IceSpec ice = medium(scheme, dx);
  const double c = sph::ElasticConstants(ice.material).bulk_sound_speed();
  const double mass = 2. / 3 * std::numbers::pi * std::pow(radius, 3) * ice.material.density / mass_ratio;
  const SphereInFluid exact(mass_ratio);
  const auto velocity = [&](double sigma) { return speed * (exact.velocity(sigma) + push * exact.path(sigma)); };

  double largest = 0;
  const auto record = [&](const Impact& impact) {
    const double sigma = impact.last_step().time * c / radius;
    largest = std::max(largest, std::abs(-impact.bodies()[0].velocity().z() - velocity(sigma)) / speed);
  };
  // The particles next to the sphere, whose centres are less than a spacing from it, are moved to half a spacing.
  const sph::InitialState initial{.keep = [&](const Vec3& x) { return x.norm() > radius; },
                                  .displacement =
                                      [&](const Vec3& x) {
                                        const double gap = x.norm() - radius;
                                        return Vec3(gap < dx ? (0.5 * dx - gap) * x.normalized() : Vec3::Zero().eval());
                                      }};
  std::vector<Body> bodies;
  bodies.push_back(sphere(dx, mass));
  Impact impact(ice, std::move(bodies), record, initial);
  impact.advance(end * radius / c, {{.force = Vec3(0, 0, -push * mass * c * speed / radius)}});

  const double late = -impact.bodies()[0].velocity().z();
  // M (v0 + push end) = (M + added) v once the waves are gone.
  const double added = (speed * (1 + push * end) / late - 1) / (mass_ratio / 2);
  return {.resolution = dx,
          .spacing = dx,
          .particles = impact.ice().particles().size(),
          .steps = impact.last_step().number,
          .errors = {std::abs(late / velocity(end) - 1), largest, std::abs(added - 1)}};
}

}  // namespace

VerificationCase added_mass() {
  return {.name = "V24-added-mass",
          .title = "A rigid sphere is suddenly set in motion in a medium without strength",
          .reference = "Acoustic dipole, exact for all times; late velocity of momentum over M + half of the displaced",
          .metrics = {{.name = "late velocity", .tolerance = 0.10, .missed = true},
                      {"velocity, largest, in v0"},
                      {"added mass"}},
          .resolutions = {6, 8, 12, 16},
          .stated_resolution = 8,
          .quick = 3,
          .tested = 2,
          .compared = 2,
          .run = run};
}

}  // namespace nilas::cases
