// V25: an HCC on a fixed path through a von Mises medium of known strength: Poncelet's force,
//
//     F = A (a + b v^2),  A = pi R^2,  b = B N rho,
//
// with N = 0.40515 the inertia factor of the nose (INT (1-s)/(1-s+s k) ds, k = (nose length / R)^2 = 16/9) and B about
// 1: 0.8 to 1.5. The nose starts embedded and the force is averaged over the second of two radii of travel, at three
// speeds. The strength is such that it and inertia share the force.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/force_history.hpp"
#include "coupling/impact.hpp"

namespace nilas::cases {

namespace {

constexpr double radius = 0.15;           // m, R
constexpr double nose = 4. / 3 * radius;  // m
constexpr double travel = 2;              // R
constexpr double strength = 20e6;         // Pa, uniaxial yield stress
constexpr double inertia_factor = 0.40515;
constexpr double smallest_B = 0.8, largest_B = 1.5;
constexpr double speeds[] = {200, 400, 600};  // m/s

/// Faces at x, y = +-5 R, z = -2 R behind the tip and 6 R ahead of it; the one ahead is held.
sph::IceSpec medium(const Scheme& scheme, double dx) {
  sph::IceSpec ice;
  sph::PieceSpec block;
  block.shape = sph::IceShape::block;
  block.size = radius * Vec3(10, 10, 8);
  block.centre = radius * Vec3(0, 0, 2);
  block.fixed.faces[5] = true;
  ice.pieces = {block};
  ice.spacing = dx;
  ice.material.cohesion = strength / std::sqrt(3.);  // phi = 0: the shear strength
  ice.material.friction_angle_deg = ice.material.dilation_angle_deg = 0;
  ice.material.after_failure = sph::AfterFailure::plastic;
  ice.numerics = scheme.numerics;
  ice.contact = scheme.contact;
  return ice;
}

/// Mean force [N] over the second half of the travel at this speed.
double force_at(const Scheme& scheme, double dx, double speed, Measurement& m) {
  rigid::BodySpec body;
  body.name = "hcc";
  body.shape = rigid::Hcc{6 * radius, 2 * radius, nose};
  body.boundary_spacing = 0.75 * dx;
  body.mass = rigid::from_density(body.shape, 1500);
  body.motion = rigid::Motion::fixed_path;
  body.position = body.mass.centre_of_mass;  // the tip at the origin
  body.velocity = {0, 0, speed};
  const sph::InitialState initial{
      .keep = [&](const Vec3& x) { return rigid::closest_point(body.shape, x).distance > 0.5 * dx; }};
  ForceHistory force;
  std::vector<Body> bodies;
  bodies.emplace_back(body);
  Impact impact(
      medium(scheme, dx), std::move(bodies),
      [&](const Impact& i) { force.add(i.last_step().time, -i.bodies()[0].account().ice_impulse.z()); }, initial);
  const double end = travel * radius / speed;
  impact.advance(end);
  m.particles = impact.ice().particles().size();
  m.steps += impact.last_step().number;
  return force.mean(end / 2, end);
}

Measurement run(const Scheme& scheme, int cells_per_radius) {
  Measurement m;
  m.resolution = m.spacing = radius / cells_per_radius;
  const double area = std::numbers::pi * radius * radius, density = sph::MaterialSpec{}.density;
  double pressure[3], square[3];
  for (int k = 0; k < 3; ++k) {
    pressure[k] = force_at(scheme, m.spacing, speeds[k], m) / area;
    square[k] = speeds[k] * speeds[k];
  }
  const auto slope = [&](int from, int to) { return (pressure[to] - pressure[from]) / (square[to] - square[from]); };
  const double B = slope(0, 2) / (inertia_factor * density);
  m.errors = {std::max({0.0, smallest_B - B, B - largest_B}), std::abs(slope(1, 2) / slope(0, 1) - 1), std::abs(B - 1)};
  return m;
}

}  // namespace

VerificationCase penetration() {
  return {.name = "V25-penetration",
          .title = "An HCC on a fixed path through a von Mises medium at 200, 400 and 600 m/s",
          .reference = "Poncelet: F = A (a + b v^2), b = B N rho, N = 0.40515, B in 0.8-1.5; one slope over all speeds",
          .metrics = {{.name = "B outside 0.8-1.5, absolute", .tolerance = 0, .missed = true},
                      {"slope, faster pair to slower", 0.20},
                      {"B from 1"}},
          .resolutions = {3, 4, 5, 6},
          .stated_resolution = 3,
          .quick = 2,
          .tested = 1,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
