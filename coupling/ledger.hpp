// The ledger: where momentum, angular momentum and energy of ice and bodies went, and how well the books close.
#pragma once

#include <vector>

#include "coupling/body.hpp"
#include "sph/ice.hpp"

#pragma GCC visibility push(default)

namespace nilas {

/// State of the books at one time. World frame, angular momentum about the world origin.
struct LedgerEntry {
  double start = 0;                            // J, kinetic and elastic, at the start
  double kinetic_ice = 0, kinetic_bodies = 0;  // J, now
  double elastic = 0;                          // J, stored now
  double plastic = 0;                          // J, plastic work and what failure released, since the start
  double viscous = 0;                          // J, artificial viscosity, since the start
  double stabilisation = 0;                    // J, artificial stress and hourglass control, since the start
  double contact = 0;                          // J, stored in and dissipated by contact, since the start; never < 0
  double absorbed = 0;                         // J, taken by an absorbing rim, since the start
  double external = 0;                         // J, work of hosts, gravity and of whatever locks a motion
  Vec3 momentum = Vec3::Zero();                // N s, ice and bodies, now
  Vec3 angular_momentum = Vec3::Zero();        // N m s, ice and bodies, now
  Vec3 held_impulse = Vec3::Zero();            // N s, of fixed parts and rims on the ice, since the start
  Vec3 held_angular_impulse = Vec3::Zero();    // N m s. Fixed parts do not move: their work is zero
  // Relative residuals, see Ledger.
  double momentum_residual = 0, angular_momentum_residual = 0, energy_residual = 0;
};

/// Compares every entry with the state at the start:
///   momentum   |P - P0 - external (hosts, gravity) - held impulses| / (SUM m|v| + SUM |P_body| + |those impulses|,
///   largest
///              so far: ice at rest on a plate passes on the impulse of gravity for as long as it lies there)
///   angular    the same about the world origin, over the momentum scale times the largest radius of ice or body;
///              SPH forces with shear are not central, so this one closes with resolution only
///   energy     (|E - E0 - external| + energy that contact made) / (energy that changed hands: the largest term of ice
///              or contact so far, but at least 1 % of E0: the first touch changes too little to measure against);
///              E = kinetic + elastic + plastic + viscous + stabilisation + contact + absorbed. What contact stores and
///              dissipates is the work that ice and bodies did against it; a sum below zero is energy made from nothing
///              (an unstable exchange with a light body, a body that starts inside the ice) and counts as error.
class Ledger {
 public:
  explicit Ledger(const sph::Ice& ice);
  /// A body that comes after the start, with what it brings.
  void add(const Body& body);
  LedgerEntry enter(const sph::Ice& ice, const std::vector<Body>& bodies);

 private:
  struct Totals {
    Vec3 momentum = Vec3::Zero(), angular_momentum = Vec3::Zero();
    double energy = 0, momentum_scale = 0;
  };
  static Totals totals(const sph::IceLedger& ice, const std::vector<Body>& bodies, LedgerEntry& entry);

  Totals start_;
  double length_;
  double momentum_scale_, energy_scale_;
};

}  // namespace nilas

#pragma GCC visibility pop
