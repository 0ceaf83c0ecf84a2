// V10: two equal elastic bars in uniaxial strain meet head-on at +-v. Where they touch they stand still, under
//
//   sigma = rho c v,  c = c_p,
//
// until both waves are back from the free ends, 2L/c later: then the bars part with velocities exchanged and without
// stress. The bars start out of each other's reach; what presses them apart are the pair forces alone.
#include <array>

#include "cases/accuracy/advance.hpp"
#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/periodic_bar.hpp"

namespace nilas::cases {

namespace {

constexpr double length = 1;      // m, L
constexpr double speed = 39.296;  // m/s, c_p/100: slower, and the pairs' soft beginning outlasts the contact

struct Bars {
  std::array<double, 2> velocity{};  // m/s, mean of each
  double stress = 0;                 // Pa, mean compression over the middle third of the left one
};
Bars look_at(const sph::Ice& ice) {
  const sph::Particles& p = ice.particles();
  const std::size_t half = p.size() / 2;
  Bars bars;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    bars.velocity[p.id[i] < half ? 0 : 1] += p.motion[i].velocity[0] / static_cast<double>(half);
    const double x = p.motion[i].position[0];
    if (x > -2 * length / 3 && x < -length / 3) bars.stress -= p.stress[i].xx, ++inside;
  }
  bars.stress /= static_cast<double>(std::max<std::size_t>(inside, 1));
  return bars;
}

Measurement run(const Scheme& scheme, int cells_per_length) {
  Measurement m;
  m.resolution = m.spacing = length / cells_per_length;
  sph::IceSpec spec = periodic_bar(scheme, m.spacing, length);
  const double reach = 2 * scheme.numerics.smoothing_ratio * m.spacing;
  spec.pieces.push_back(spec.pieces[0]);
  for (const int side : {-1, 1}) {
    sph::PieceSpec& bar = spec.pieces[side < 0 ? 0 : 1];
    bar.centre[0] = side * 0.5 * (length + reach);
    bar.velocity[0] = -side * speed;
  }
  sph::Ice ice(spec);
  m.particles = ice.particles().size();
  const double c = ice.elastic_constants().p_wave_speed(), kinetic = ice.ledger().kinetic;

  // The left bar's momentum goes from m v to -m v, evenly while they touch: 80 % of it in 80 % of the contact time.
  double stress = 0, tenth = 0, nine_tenths = 0;
  const auto record = [&](double time, double) {
    const Bars bars = look_at(ice);
    const double turned = 0.5 * (1 - bars.velocity[0] / speed);
    if (turned < 0.1) tenth = time;
    if (turned < 0.9) nine_tenths = time;
    stress = std::max(stress, bars.stress);
  };
  m.steps = advance(ice, 3 * length / c + reach / speed, record);
  const sph::IceLedger ledger = ice.ledger();
  const Bars bars = look_at(ice);
  m.errors = {std::abs(stress / (ice.elastic_constants().impedance() * speed) - 1),
              std::abs((nine_tenths - tenth) / 0.8 * c / (2 * length) - 1),
              std::max(std::abs(bars.velocity[0] / speed + 1), std::abs(bars.velocity[1] / speed - 1)),
              1 - ledger.kinetic / kinetic, ledger.momentum.norm() / ledger.momentum_scale};
  m.errors[3] = std::abs(m.errors[3]);
  return m;
}

}  // namespace

VerificationCase colliding_bars() {
  return {.name = "V10-colliding-bars",
          .title = "Two equal elastic bars meet head-on and exchange their velocities",
          .reference = "waves of uniaxial strain: contact stress rho c_p v, contact time 2L/c_p",
          .metrics = {{"contact stress", 0.05},
                      {"contact time", 0.05},
                      {"velocities exchanged", Metric::none},
                      {.name = "kinetic energy lost", .tolerance = 0.1, .missed = true},
                      {"momentum, of the sum of magnitudes", 1e-10}},
          .resolutions = {25, 50, 100, 200},
          .stated_resolution = 50,
          .quick = 3,
          .tested = 2,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
