// V21: a rigid mass M on an elastic bar of mass m_b and length L that is fixed at its far end, in the lowest mode
//
//     u(x, t) = U sin(beta x/L) sin(omega t),   omega = beta c/L,   beta tan beta = m_b/M   (x from the fixed end).
//
// Contact cannot pull. Set off in this mode at its largest velocity, moving into compression, the mass presses for half
// a period: it comes to rest after a quarter, which is what is measured, and leaves the bar after half, both going back
// at the velocity they came with. Half a period is run at every ratio of the masses.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/contact_oracles.hpp"
#include "cases/accuracy/struck_bar.hpp"
#include "coupling/impact.hpp"

namespace nilas::cases {

namespace {

constexpr double length = 1;  // m
constexpr double speed = 1;   // m/s, of the mass
constexpr double ratios[] = {0.01, 0.1, 0.5, 1, 2, 10, 100};

struct Vibration {
  double period_error = 0;  // of the quarter period
  double energy_gain = 0;   // largest energy of ice and mass over that at the start, - 1
};

Vibration vibrate(const Scheme& scheme, double dx, double ratio, Measurement& m) {
  const sph::IceSpec bar = elastic_bar(scheme, length, dx, true);
  const sph::ElasticConstants elastic(bar.material);
  const double area = bar.pieces[0].size.y() * bar.pieces[0].size.z();
  const double mass = elastic.density * area * length / ratio;
  const double beta = mode_of_mass_on_bar(ratio);
  const double quarter = std::numbers::pi / 2 * length / (beta * elastic.p_wave_speed());

  double reversal = 0, time_before = 0, speed_before = speed, start_energy = 0, largest_energy = 0;
  const auto energy = [](const Impact& impact) {
    const sph::IceLedger ice = impact.ice().ledger();
    return ice.kinetic + ice.elastic + impact.bodies()[0].kinetic_energy();
  };
  const auto record = [&](const Impact& impact) {
    const double time = impact.last_step().time, v = impact.bodies()[0].velocity().x();
    if (reversal == 0 && v <= 0) reversal = time_before + (time - time_before) * speed_before / (speed_before - v);
    time_before = time, speed_before = v;
    if (impact.last_step().number % 8 == 0) largest_energy = std::max(largest_energy, energy(impact));
  };
  const auto mode = [&](const Vec3& x) {
    return Vec3(speed * std::sin(beta * std::max(0.0, 1 - x[0] / length)) / std::sin(beta), 0, 0);
  };
  std::vector<Body> bodies;
  bodies.emplace_back(mass_on_end(bar, mass, speed, rigid::Motion::translation_only));
  Impact impact(bar, std::move(bodies), record, {.velocity = mode});
  start_energy = energy(impact);
  impact.advance(2 * quarter);
  m.particles = impact.ice().particles().size();
  m.steps += impact.last_step().number;
  // A mass that has not come to rest by then is as wrong as can be said: by the whole quarter.
  return {reversal > 0 ? std::abs(reversal / quarter - 1) : 1, std::max(0.0, largest_energy / start_energy - 1)};
}

Measurement run(const Scheme& scheme, int cells) {
  Measurement m;
  m.resolution = m.spacing = length / cells;
  double gain = 0;
  for (const double ratio : ratios) {
    const Vibration vibration = vibrate(scheme, m.spacing, ratio, m);
    m.errors.push_back(vibration.period_error);
    gain = std::max(gain, vibration.energy_gain);
  }
  m.errors.push_back(gain);
  return m;
}

}  // namespace

VerificationCase mass_on_fixed_bar() {
  return {.name = "V21-mass-on-fixed-bar",
          .title = "A rigid mass on an elastic bar fixed at its far end, lowest mode, bar to mass from 0.01 to 100",
          .reference = "beta tan beta = m_bar/M, omega = beta c/L; no energy is made at any ratio",
          .metrics = {{"period, ratio 0.01", 0.02},
                      {"period, ratio 0.1", 0.02},
                      {"period, ratio 0.5", 0.02},
                      {"period, ratio 1", 0.02},
                      {"period, ratio 2", 0.02},
                      {"period, ratio 10", 0.02},
                      {"period, ratio 100", 0.02},
                      {"energy made", 0.01}},
          .resolutions = {25, 50, 100, 200},
          .stated_resolution = 100,
          .quick = 3,
          .tested = 1,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
