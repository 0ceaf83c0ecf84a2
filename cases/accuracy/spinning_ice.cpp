// V16: a disc and a cube of elastic ice, free, spin through ten turns about their axis z at w R = c_p/10. Angular
// momentum is conserved. The disc's ends are periodic (plane strain); about the stress (Timoshenko, Goodier)
//
//   sigma_r = (3 - 2nu)/(8 (1 - nu)) rho w^2 (R^2 - r^2)
//
// it oscillates, for it starts without stress: the mean over time is compared, at r < R/2.
#include <numbers>

#include "cases/accuracy/advance.hpp"
#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/periodic_bar.hpp"

namespace nilas::cases {

namespace {

constexpr double radius = 0.1;  // m, of the disc; half the edge of the cube
constexpr double mach = 0.1;    // w R / c_p
constexpr int turns = 10;

sph::Ice make_spinning(const Scheme& scheme, double dx, sph::IceShape shape) {
  sph::IceSpec spec;
  sph::PieceSpec piece;
  piece.shape = shape;
  piece.diameter = 2 * radius;
  piece.thickness = cells_across(scheme.numerics) * dx;
  piece.size = Vec3::Constant(2 * radius);
  spec.pieces = {piece};
  spec.spacing = dx;
  spec.periodic = {false, false, shape == sph::IceShape::disc};
  spec.material.model = sph::Model::elastic;
  spec.numerics = scheme.numerics;
  const double w = mach * sph::ElasticConstants(spec.material).p_wave_speed() / radius;
  return sph::Ice(spec, {}, {.velocity = [w](const Vec3& r) { return Vec3(-w * r[1], w * r[0], 0); }});
}

/// Mean over the particles at r < R/2 of sigma_r, and of its exact value [Pa].
struct RadialStress {
  double measured = 0, exact = 0;
};
RadialStress radial_stress(const sph::Ice& ice, double w, double nu) {
  RadialStress stress;
  double count = 0;
  const sph::Particles& p = ice.particles();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double x = p.motion[i].position[0], y = p.motion[i].position[1], r2 = x * x + y * y;
    if (r2 >= radius * radius / 4 || r2 == 0) continue;
    const sph::Sym3& s = p.stress[i];
    stress.measured += (s.xx * x * x + 2 * s.xy * x * y + s.yy * y * y) / r2;
    stress.exact += (3 - 2 * nu) / (8 * (1 - nu)) * ice.elastic_constants().density * w * w * (radius * radius - r2);
    ++count;
  }
  return {stress.measured / count, stress.exact / count};
}

Measurement spin(const Scheme& scheme, int cells_across_body, sph::IceShape shape) {
  Measurement m;
  m.resolution = m.spacing = 2 * radius / cells_across_body;
  sph::Ice ice = make_spinning(scheme, m.spacing, shape);
  m.particles = ice.particles().size();
  const double w = mach * ice.elastic_constants().p_wave_speed() / radius;
  const double turn = 2 * std::numbers::pi / w;
  const Vec3 start = ice.ledger().angular_momentum;
  double drift = 0, measured = 0, exact = 0;
  m.steps = advance(ice, turns * turn, [&](double, double dt) {
    const sph::IceLedger ledger = ice.ledger();
    drift = std::max(drift, (ledger.angular_momentum - start).norm() / start.norm());
    const RadialStress stress = radial_stress(ice, w, sph::MaterialSpec{}.poisson_ratio);
    measured += dt * stress.measured, exact += dt * stress.exact;
  });
  const sph::IceLedger ledger = ice.ledger();
  m.errors = {drift, ledger.momentum.norm() / ledger.momentum_scale};
  if (shape == sph::IceShape::disc) m.errors.push_back(std::abs(measured / exact - 1));
  return m;
}

VerificationCase spinning(const char* name, const char* title, sph::IceShape shape) {
  return {.name = name,
          .title = title,
          .reference = "conservation of angular momentum and momentum",
          .metrics = {{.name = "angular momentum", .tolerance = 1e-3}, {"momentum, of the sum of magnitudes", 1e-10}},
          .resolutions = {8, 12, 16, 24},
          .stated_resolution = 8,
          .quick = 3,
          .tested = 1,
          .compared = 0,
          .run = [shape](const Scheme& scheme, int resolution) { return spin(scheme, resolution, shape); }};
}

}  // namespace

VerificationCase spinning_disc() {
  VerificationCase c =
      spinning("V16-spinning-disc", "A free elastic disc in plane strain spins through ten turns", sph::IceShape::disc);
  c.reference += "; radial stress (3 - 2nu)/(8 (1 - nu)) rho w^2 (R^2 - r^2)";
  c.metrics.push_back({.name = "radial stress, mean over time, r < R/2", .tolerance = 0.05});
  return c;
}

VerificationCase spinning_cube() {
  VerificationCase c =
      spinning("V16-spinning-cube", "A free elastic cube spins through ten turns", sph::IceShape::block);
  c.quick = 2;
  return c;
}

}  // namespace nilas::cases
