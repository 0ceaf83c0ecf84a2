// V17: two rubber rings in plane strain collide (Swegle; Gray, Monaghan and Swift 2001). They must rebound whole:
// without a remedy for the tensile instability they fall apart into clumps. Energy: kinetic and stored.
#include <array>

#include "cases/accuracy/advance.hpp"
#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/lattice_bonds.hpp"
#include "cases/accuracy/periodic_bar.hpp"
#include "cases/accuracy/stabilised.hpp"

namespace nilas::cases {

namespace {

constexpr double inner = 0.03, outer = 0.04;               // m, radii
constexpr double density = 1000, modulus = 1e7, nu = 0.4;  // kg/m3, Pa
constexpr double mach = 0.059;                             // v/c_0 of each, c_0 = sqrt(K/rho)

sph::Ice make_rings(const Scheme& scheme, double dx) {
  sph::IceSpec spec;
  sph::PieceSpec ring;
  ring.diameter = 2 * outer;
  ring.inner_diameter = 2 * inner;
  ring.thickness = cells_across(scheme.numerics) * dx;
  spec.pieces = {ring, ring};
  spec.spacing = dx;
  spec.periodic = {false, false, true};
  spec.material.model = sph::Model::elastic;
  spec.material.density = density;
  spec.material.young_modulus = modulus;
  spec.material.poisson_ratio = nu;
  spec.numerics = stabilised(scheme.numerics);
  const double speed = mach * sph::ElasticConstants(spec.material).bulk_sound_speed();
  const double reach = 2 * spec.numerics.smoothing_ratio * dx;
  for (const int side : {-1, 1}) {
    spec.pieces[side < 0 ? 0 : 1].centre[0] = side * (outer + 0.5 * reach);
    spec.pieces[side < 0 ? 0 : 1].velocity[0] = -side * speed;
  }
  return sph::Ice(spec);
}

/// Mean velocity of the right ring less that of the left one, and the gap between the two [m/s, m].
std::array<double, 2> parting(const sph::Ice& ice) {
  const sph::Particles& p = ice.particles();
  const std::size_t half = p.size() / 2;
  double velocity = 0, left = -1e300, right = 1e300;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const bool is_left = p.id[i] < half;
    velocity += (is_left ? -1 : 1) * p.motion[i].velocity[0] / static_cast<double>(half);
    double& edge = is_left ? left : right;
    edge = is_left ? std::max(edge, p.motion[i].position[0]) : std::min(edge, p.motion[i].position[0]);
  }
  return {velocity, right - left};
}

Measurement run(const Scheme& scheme, int cells_per_wall) {
  Measurement m;
  m.resolution = m.spacing = (outer - inner) / cells_per_wall;
  sph::Ice ice = make_rings(scheme, m.spacing);
  m.particles = ice.particles().size();
  const LatticeBonds bonds(ice);
  const double speed = mach * ice.elastic_constants().bulk_sound_speed(), kinetic = ice.ledger().kinetic;
  double stretch = 0, energy = kinetic, next_look = 0;
  const double end = 3 * outer / speed;
  m.steps = advance(ice, end, [&](double time, double) {
    if (time < next_look) return;
    const sph::IceLedger ledger = ice.ledger();
    stretch = std::max(stretch, bonds.largest_stretch(ice));
    energy = std::max(energy, ledger.kinetic + ledger.elastic);
    next_look += end / 100;
  });
  const sph::IceLedger ledger = ice.ledger();
  const auto [velocity, gap] = parting(ice);
  const bool apart = velocity > 0 && gap > 2 * ice.smoothing_length();
  m.errors = {apart ? 0. : 1., std::max(0., stretch), energy / kinetic - 1, std::abs(ledger.kinetic / kinetic - 0.7),
              ledger.momentum.norm() / ledger.momentum_scale};
  return m;
}

}  // namespace

VerificationCase colliding_rings() {
  return {.name = "V17-colliding-rings",
          .title = "Two rubber rings collide at 0.059 c_0 each and rebound, with hourglass control",
          .reference = "Gray, Monaghan and Swift 2001: whole rebound, 0.5 to 0.9 of the kinetic energy kept",
          .metrics = {{"1 unless the rings part", 0},
                      {"fracture: stretch between lattice neighbours, in spacings", 0.5},
                      {"energy gained", 0.01},
                      {"kinetic energy kept, distance from 0.7", 0.2},
                      {"momentum, of the sum of magnitudes", 1e-10}},
          .resolutions = {4, 5, 7, 10},
          .stated_resolution = 10,
          .quick = 2,
          .tested = 0,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
