// V26: a column of dry grains, H = 0.1 m by d = 0.2 m, collapses in plane strain over a rough floor (size and stiffness
// of Bui et al. 2008; phi = 30 deg, about the angle of repose of the grains that the law below was found with; no
// cohesion, no dilation). A smooth wall stands at x = 0; the floor is
// held ice of the same material. The front comes to rest at (Lube et al. 2005, two dimensions, a = H/d < 2.3)
//
//   x_f = d + 1.2 a d = 0.32 m.
#include <numbers>

#include "cases/accuracy/advance.hpp"
#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/periodic_bar.hpp"

namespace nilas::cases {

namespace {

constexpr double height = 0.1, width = 0.2;  // m, H, d
constexpr double floor_length = 0.5;         // m
constexpr double gravity = 9.81;             // m/s2
constexpr double end = 1;                    // s: ten times sqrt(H/g)

sph::MaterialSpec grains() {
  sph::MaterialSpec m;
  m.model = sph::Model::drucker_prager;
  m.density = 2650;
  m.poisson_ratio = 0.3;
  m.young_modulus = 3 * 0.7e6 * (1 - 2 * m.poisson_ratio);  // K = 0.7 MPa
  m.cohesion = 0;
  m.friction_angle_deg = 30;
  m.dilation_angle_deg = 0;
  m.after_failure = sph::AfterFailure::plastic;
  m.pressure = sph::PressureLaw::density;  // a void between grains closes before they press again
  return m;
}

/// The wall x = 0, facing +x, between -z and z far past the periodic sides.
sph::Surface make_wall(double dx, double across) {
  sph::Surface wall;
  wall.spacing = 0.75 * dx;
  const int up = static_cast<int>(std::ceil(2 * height / wall.spacing));
  const int along = static_cast<int>(std::ceil(across / wall.spacing)) + 4;
  for (int i = 0; i < up; ++i)
    for (int k = -along; k <= along; ++k)
      wall.particles.push_back({.position = {0, (i - 4) * wall.spacing, k * wall.spacing},
                                .velocity = Vec3::Zero(),
                                .normal = Vec3::UnitX(),
                                .area = wall.spacing * wall.spacing,
                                .force = Vec3::Zero()});
  return wall;
}

Measurement run(const Scheme& scheme, int cells_per_height) {
  Measurement m;
  const double dx = m.resolution = m.spacing = height / cells_per_height;
  const double layers = std::ceil(2 * scheme.numerics.smoothing_ratio - 0.5) * dx;
  const double across = cells_across(scheme.numerics) * dx;
  sph::IceSpec spec;
  sph::PieceSpec column;
  column.shape = sph::IceShape::block;
  column.size = {width, height, across};
  column.centre = {width / 2, height / 2, 0};
  sph::PieceSpec floor = column;
  floor.size = {floor_length, layers, across};
  floor.centre = {floor_length / 2, -layers / 2, 0};
  floor.fixed.faces[2] = true;
  spec.pieces = {column, floor};
  spec.spacing = dx;
  spec.periodic = {false, false, true};
  spec.gravity = {0, -gravity, 0};
  spec.material = grains();
  spec.numerics = scheme.numerics;
  spec.contact = scheme.contact;
  spec.contact.friction_coefficient = 0;
  spec.contact.stick = false;
  std::vector<sph::Surface> wall{make_wall(dx, across)};
  sph::Ice ice(spec, wall);
  m.particles = ice.particles().size();
  m.steps = advance(ice, wall, end, [](double, double) {});

  // The front: where the deposit thins out to one particle, grains that have jumped ahead left out.
  std::vector<double> front;
  const sph::Particles& p = ice.particles();
  double potential = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!p.held[i]) front.push_back(p.motion[i].position[0]), potential += p.mass * gravity * height / 2;
  std::sort(front.begin(), front.end(), std::greater<>());
  const double layer = across / dx;  // particles in one row
  const double reached = front[static_cast<std::size_t>(layer)] + dx / 2;
  m.errors = {std::abs((reached - width) / (1.2 * height) - 1), ice.ledger().kinetic / potential};
  return m;
}

}  // namespace

VerificationCase column_collapse() {
  return {.name = "V26-column-collapse",
          .title = "A column of dry grains, 0.2 m by 0.1 m, collapses over a rough floor",
          .reference = "Lube et al. 2005: run-out 1.2 H for H < 2.3 d",
          .metrics = {{"run-out", 0.15}, {"kinetic energy left after 1 s, of the potential one", 1e-4}},
          .resolutions = {8, 12, 16, 24},
          .stated_resolution = 16,
          .quick = 3,
          .tested = 1,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
