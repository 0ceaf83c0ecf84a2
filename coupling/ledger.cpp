#include "coupling/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace nilas {

namespace {
constexpr double kSmallestExchange = 0.01;  // of the energy at the start

double ratio(double difference, double scale) { return scale > 0 ? std::abs(difference) / scale : 0; }
}  // namespace

Ledger::Totals Ledger::totals(const sph::IceLedger& ice, const std::vector<Body>& bodies, LedgerEntry& entry) {
  Totals t;
  t.momentum = ice.momentum - ice.held_impulse - ice.gravity_impulse;
  t.angular_momentum = ice.angular_momentum - ice.held_angular_impulse - ice.gravity_angular_impulse;
  t.momentum_scale = ice.momentum_scale + ice.gravity_impulse.norm() + ice.held_impulse.norm();
  entry.kinetic_ice = ice.kinetic;
  entry.elastic = ice.elastic;
  entry.plastic = ice.stress_work - ice.elastic;
  entry.viscous = ice.viscous;
  entry.stabilisation = ice.stabilisation;
  entry.absorbed = ice.absorbed;
  entry.external = ice.gravity_work;
  entry.contact = -ice.contact_work;
  entry.momentum = ice.momentum;
  entry.angular_momentum = ice.angular_momentum;
  entry.held_impulse = ice.held_impulse;
  entry.held_angular_impulse = ice.held_angular_impulse;
  for (const Body& body : bodies) {
    const rigid::State& s = body.state();
    t.momentum += s.momentum - body.account().external_impulse;
    t.angular_momentum += s.position.cross(s.momentum) + s.angular_momentum - body.account().external_angular_impulse;
    t.momentum_scale += s.momentum.norm() + body.account().external_impulse.norm();
    entry.kinetic_bodies += body.kinetic_energy();
    entry.contact -= body.account().ice_work;
    entry.external += body.account().external_work;
    entry.momentum += s.momentum;
    entry.angular_momentum += s.position.cross(s.momentum) + s.angular_momentum;
  }
  t.energy = entry.kinetic_ice + entry.kinetic_bodies + ice.stress_work + entry.viscous + entry.stabilisation +
             entry.contact + entry.absorbed - entry.external;
  return t;
}

Ledger::Ledger(const sph::Ice& ice) : length_(0), momentum_scale_(0), energy_scale_(0) {
  LedgerEntry entry;
  start_ = totals(ice.ledger(), {}, entry);
  energy_scale_ = kSmallestExchange * start_.energy;
  const sph::Particles& p = ice.particles();
  Vec3 lower = p.motion[0].position, upper = lower;
  for (const sph::Motion& m : p.motion) {
    lower = lower.cwiseMin(m.position);
    upper = upper.cwiseMax(m.position);
  }
  length_ = std::max(length_, 0.5 * (upper - lower).norm());
}

void Ledger::add(const Body& body) {
  const rigid::State& s = body.state();
  start_.momentum += s.momentum;
  start_.angular_momentum += s.position.cross(s.momentum) + s.angular_momentum;
  start_.energy += body.kinetic_energy();
  energy_scale_ = std::max(energy_scale_, kSmallestExchange * start_.energy);
  length_ = std::max(length_, body.enclosing_radius());
}

LedgerEntry Ledger::enter(const sph::Ice& ice, const std::vector<Body>& bodies) {
  LedgerEntry entry;
  const Totals now = totals(ice.ledger(), bodies, entry);
  entry.start = start_.energy;
  momentum_scale_ = std::max(momentum_scale_, now.momentum_scale);
  energy_scale_ =
      std::max({energy_scale_, entry.kinetic_ice, entry.elastic, std::abs(entry.plastic), std::abs(entry.viscous),
                std::abs(entry.stabilisation), std::abs(entry.contact), std::abs(entry.external), entry.absorbed});
  entry.momentum_residual = ratio((now.momentum - start_.momentum).norm(), momentum_scale_);
  entry.angular_momentum_residual =
      ratio((now.angular_momentum - start_.angular_momentum).norm(), momentum_scale_ * length_);
  const double made_by_contact = std::max(0.0, -entry.contact);
  entry.energy_residual = ratio(std::abs(now.energy - start_.energy) + made_by_contact, energy_scale_);
  return entry;
}

}  // namespace nilas
