// V20, St Venant: a rigid mass M strikes a long elastic bar of cross-section A in uniaxial strain. Until the wave is
// back from the far end,
//
//     v = v0 exp(-t/tau),  F = rho c A v0 exp(-t/tau),  tau = M / (rho c A).
//
// The ice meets the mass through a penalty spring k and the first layer of particles m: k = s M_p dx and m = rho dx^3
// with the P-wave modulus M_p and the contact's stiffness s. The force therefore rises within one period of m on k, T =
// 2 pi sqrt(m / k) = 2 pi dx / (c sqrt(s)), and rings in that period; it is compared by its mean over one T, from one T
// after the touch. The spring also delays it, by dx / (s c): the error is of first order in dx.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/force_history.hpp"
#include "cases/accuracy/struck_bar.hpp"
#include "coupling/simulation.hpp"

namespace nilas::cases {

namespace {

constexpr double decay_length = 0.1;  // m, c tau: the length of bar that weighs as much as the mass
constexpr double speed = 1;           // m/s, v0
constexpr double bar_length = 1.6;    // c tau; the wave is back after 3.2 tau
constexpr double end = 3;             // tau
constexpr double first_order = 0.75;  // as two resolutions show it: it comes up to 1 from below

Measurement run(const Scheme& scheme, int cells) {
  const double dx = decay_length / cells;
  const sph::IceSpec ice = elastic_bar(scheme, bar_length * decay_length, dx, false);
  const sph::ElasticConstants elastic(ice.material);
  const double c = elastic.p_wave_speed(), tau = decay_length / c;
  const double period = 2 * std::numbers::pi * dx / (c * std::sqrt(scheme.contact.stiffness));
  const double area = ice.pieces[0].size.y() * ice.pieces[0].size.z();
  const double mass = tau * elastic.impedance() * area, momentum = mass * speed;
  const auto exact = [&](double t) { return momentum * (1 - std::exp(-t / tau)); };

  ForceHistory force;
  double velocity_error = 0;
  const auto record = [&](const Impact& impact) {
    const double t = impact.last_step().time, impulse = -impact.bodies()[0].account().ice_impulse.x();
    force.add(t, impulse);
    velocity_error = std::max(velocity_error, std::abs(impulse - exact(t)) / momentum);
  };
  Simulation simulation(ice, {mass_on_end(ice, mass, speed, rigid::Motion::translation_only)}, tau / 10, record);
  simulation.advance_to(end * tau);

  double force_error = 0, impulse_error = 0;
  for (double t = period; t < 2 * tau; t += period / 4) {
    const double mean = (exact(t + period) - exact(t)) / period;
    force_error = std::max(force_error, std::abs(force.mean(t, t + period) / mean - 1));
  }
  for (const double t : {1., 2., 3.})
    impulse_error = std::max(impulse_error, std::abs(force.impulse(t * tau) / exact(t * tau) - 1));
  const Impact& impact = simulation.impact();
  const Vec3 total = impact.ice().ledger().momentum + impact.bodies()[0].state().momentum;
  return {.resolution = dx,
          .spacing = dx,
          .particles = impact.ice().particles().size(),
          .steps = impact.last_step().number,
          .errors = {force_error, impulse_error, velocity_error, (total - Vec3(momentum, 0, 0)).norm() / momentum}};
}

}  // namespace

VerificationCase st_venant() {
  return {.name = "V20-st-venant",
          .title = "A rigid mass strikes a long elastic bar",
          .reference = "St Venant: v = v0 exp(-t/tau), F = rho c A v0 exp(-t/tau), until the wave is back",
          .metrics = {{"force", 0.03},
                      {"impulse", 0.01},
                      {"velocity, in v0", Metric::none, first_order},
                      {"momentum", 1e-10}},
          .resolutions = {25, 50, 100, 200, 400},
          .stated_resolution = 50,
          .quick = 4,
          .tested = 3,
          .compared = 3,
          .run = run};
}

}  // namespace nilas::cases
