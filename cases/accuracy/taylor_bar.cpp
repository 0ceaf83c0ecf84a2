// V19: a copper cylinder strikes a rigid, frictionless wall at 227 m/s (Taylor 1948; the benchmark of hydrocodes). Von
// Mises plasticity with linear hardening: Drucker-Prager ice without friction angle or dilation, cohesion
// sigma_y/sqrt(3). Length and radius of the foot after 80 us, against the middle of the published range.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "cases/accuracy/catalogue.hpp"
#include "coupling/simulation.hpp"

namespace nilas::cases {

namespace {

constexpr double length = 32.4e-3, diameter = 6.4e-3;              // m
constexpr double speed = 227;                                      // m/s
constexpr double end = 80e-6;                                      // s
constexpr double final_length = 21.45e-3, foot_radius = 7.125e-3;  // m, published: 21.4-21.5 and 7.0-7.25 mm

sph::MaterialSpec copper() {
  sph::MaterialSpec m;
  m.model = sph::Model::drucker_prager;
  m.density = 8930;
  m.young_modulus = 117e9;
  m.poisson_ratio = 0.35;
  m.cohesion = 0.4e9 / std::numbers::sqrt3;
  m.friction_angle_deg = 0;
  m.dilation_angle_deg = 0;
  m.after_failure = sph::AfterFailure::plastic;
  m.hardening_modulus = 0.1e9;
  return m;
}

/// The wall: the upper face of a fixed plate at z = 0.
rigid::BodySpec make_wall(double dx) {
  rigid::BodySpec wall;
  wall.name = "wall";
  wall.shape = rigid::Box{Vec3(4 * diameter, 4 * diameter, diameter)};
  wall.boundary_spacing = 0.75 * dx;
  wall.mass = rigid::from_mass(wall.shape, 1);
  wall.motion = rigid::Motion::fixed;
  wall.position = {0, 0, -diameter / 2};
  return wall;
}

Measurement run(const Scheme& scheme, int cells_per_diameter) {
  Measurement m;
  m.resolution = m.spacing = diameter / cells_per_diameter;
  sph::IceSpec spec;
  sph::PieceSpec piece;
  piece.diameter = diameter;
  piece.thickness = std::round(length / m.spacing) * m.spacing;
  piece.centre[2] = piece.thickness / 2;
  piece.velocity[2] = -speed;
  spec.pieces = {piece};
  spec.spacing = m.spacing;
  spec.material = copper();
  spec.numerics = scheme.numerics;
  spec.contact = scheme.contact;
  spec.contact.friction_coefficient = 0;
  spec.contact.stick = false;
  Simulation simulation(spec, {make_wall(m.spacing)}, end);
  const sph::Ice& ice = simulation.impact().ice();
  m.particles = ice.particles().size();

  simulation.advance_to(end);
  m.steps = simulation.impact().last_step().number;
  // Outermost particle of each sector, as the lattice has a rim of its own making.
  double top = 0;
  std::array<double, 16> rim{};
  for (const sph::Motion& particle : ice.particles().motion) {
    const Vec3& x = particle.position;
    top = std::max(top, x[2]);
    const double turn = 0.5 + std::atan2(x[1], x[0]) / (2 * std::numbers::pi);
    double& sector = rim[std::min(static_cast<std::size_t>(turn * rim.size()), rim.size() - 1)];
    sector = std::max(sector, x.head<2>().norm());
  }
  top += m.spacing / 2;
  const double foot = std::accumulate(rim.begin(), rim.end(), m.spacing / 2 * rim.size()) / rim.size();
  m.errors = {std::abs(top / (final_length * piece.thickness / length) - 1), std::abs(foot / foot_radius - 1),
              simulation.impact().ledger().energy_residual};
  return m;
}

}  // namespace

VerificationCase taylor_bar() {
  return {.name = "V19-taylor-bar",
          .title = "A copper cylinder of 32.4 mm by 6.4 mm strikes a rigid wall at 227 m/s",
          .reference = "published hydrocode results after 80 us: length 21.4-21.5 mm, radius of the foot 7.0-7.25 mm",
          .metrics = {{"length", 0.02}, {"radius of the foot", 0.05}, {"energy residual", 0.01}},
          .resolutions = {8, 12, 16, 24},
          .stated_resolution = 16,
          .quick = 2,
          .tested = 1,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
