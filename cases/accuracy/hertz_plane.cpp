// V22: an elastic ice sphere strikes a rigid plane: Hertz's impact,
//
//     d = (15 m v^2/(16 E* sqrt R))^(2/5),  F = 4/3 E* sqrt(R) d^(3/2),  t = 2.943 d/v,  E* = E/(1 - nu^2).
//
// The speed is such that at forty cells per diameter the contact is four cells in radius; it is then 0.2 R. Hertz has d
// << R: at 0.2 R the sphere as a whole gives by some per cent of d, which the reference leaves out.
//
// The outermost particles are put on the sphere. On the bare lattice its lowest layer is a flat patch of radius sqrt(R
// dx), larger than the contact at any spacing within reach here: a punch, not a sphere.
#include <cmath>
#include <numbers>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/contact_oracles.hpp"
#include "cases/accuracy/force_history.hpp"
#include "coupling/impact.hpp"

namespace nilas::cases {

namespace {

constexpr double radius = 0.03;   // m
constexpr double relative = 0.2;  // contact radius / R

sph::IceSpec sphere_above_plane(const Scheme& scheme, double dx, double speed) {
  sph::IceSpec ice;
  sph::PieceSpec sphere;
  sphere.shape = sph::IceShape::sphere;
  sphere.diameter = 2 * radius;
  sphere.centre = {0, 0, radius};
  sphere.velocity = {0, 0, -speed};
  ice.pieces = {sphere};
  ice.spacing = dx;
  ice.material.model = sph::Model::elastic;
  ice.numerics = scheme.numerics;
  ice.contact = scheme.contact;
  return ice;
}

Body plane(double dx) {
  rigid::BodySpec body;
  body.name = "plane";
  const double thickness = 0.3 * radius;
  body.shape = rigid::Box{Vec3(2 * radius, 2 * radius, thickness)};
  body.boundary_spacing = 0.75 * dx;
  body.mass = rigid::from_mass(body.shape, 1);
  body.motion = rigid::Motion::fixed;
  body.position = {0, 0, -thickness / 2};
  return Body(body);
}

/// Puts the outermost particles, whose centres are less than a spacing inside the sphere, at half a spacing.
std::function<Vec3(const Vec3&)> smooth_surface(double dx) {
  return [dx](const Vec3& x) {
    const Vec3 r = x - Vec3(0, 0, radius);
    const double depth = radius - r.norm();
    return Vec3(depth < dx ? (depth - 0.5 * dx) * r.normalized() : Vec3::Zero().eval());
  };
}

Measurement run(const Scheme& scheme, int cells_per_diameter) {
  const double dx = 2 * radius / cells_per_diameter;
  const sph::MaterialSpec material;
  const double nu = material.poisson_ratio, modulus = material.young_modulus / (1 - nu * nu);
  const double mass = 4. / 3 * std::numbers::pi * std::pow(radius, 3) * material.density;
  // The speed at which d = relative^2 R.
  const double speed = std::sqrt(16 * modulus * std::pow(radius, 3) * std::pow(relative, 5) / (15 * mass));
  const HertzImpact hertz(mass, radius, modulus, speed);

  ForceHistory force;
  const auto record = [&](const Impact& impact) {
    force.add(impact.last_step().time, -impact.bodies()[0].account().ice_impulse.z());
  };
  std::vector<Body> bodies;
  bodies.push_back(plane(dx));
  Impact impact(sphere_above_plane(scheme, dx, speed), std::move(bodies), record, {.displacement = smooth_surface(dx)});
  impact.advance(1.6 * hertz.duration);

  const double window = hertz.duration / 20, level = 0.1;
  const double peak = force.peak(window), duration = force.time_above(level * peak, window);
  const sph::IceLedger ice = impact.ice().ledger();
  const double ice_mass = impact.ice().particles().mass * static_cast<double>(impact.ice().particles().size());
  return {
      .resolution = dx,
      .spacing = dx,
      .particles = impact.ice().particles().size(),
      .steps = impact.last_step().number,
      .errors = {std::abs(peak / hertz.force - 1), std::abs(duration / (hertz_time_above(level) * hertz.duration) - 1),
                 std::abs(ice.momentum.z() / (ice_mass * speed) - 1)}};
}

}  // namespace

VerificationCase hertz_plane() {
  return {.name = "V22-hertz-plane",
          .title = "An elastic ice sphere strikes a rigid plane; contact radius a fifth of its own",
          .reference = "Hertz: F = 4/3 E* sqrt(R) d^1.5, duration 2.943 d/v, restitution 1",
          .metrics = {{"peak force", 0.10}, {"duration", 0.10}, {"restitution", 0.05}},
          .resolutions = {20, 30, 40, 60, 80},
          .stated_resolution = 40,
          .quick = 3,
          .tested = 2,
          .compared = 2,
          .run = run};
}

}  // namespace nilas::cases
