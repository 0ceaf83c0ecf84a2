// Updated-Lagrangian SPH ice: owns its particles and advances them by position Verlet (drift-kick-drift). It meets
// rigid bodies only as Boundary particles and can run alone.
//
// One step, for a caller that moves bodies along (Cai et al. 2025, Eq. 27-28, in updated-Lagrangian form):
//
//     ice.drift(dt / 2);              r, V, sigma  -> n + 1/2   with v and L of n
//     ice.interact(surfaces, dt);     contact and pair forces at n + 1/2
//     ice.kick(dt);                   v            -> n + 1
//     ice.drift_and_differentiate(dt / 2);  r, L, V, sigma -> n + 1   with v of n + 1
//
// State at the end of a step is synchronous. SI units, world frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sph/boundary.hpp"
#include "sph/lattice.hpp"
#include "sph/material.hpp"
#include "sph/numerical_failure.hpp"
#include "sph/pair_passes.hpp"
#include "sph/time_step.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

/// Where kinetic energy and momentum of the ice went since the start. World frame, moments about the origin.
struct IceLedger {
  double kinetic = 0;                           // J, now
  double elastic = 0;                           // J, stored now
  double stress_work = 0;                       // J, SUM V sigma:D dt = stored + plastic
  double viscous = 0;                           // J, taken by artificial viscosity
  double stabilisation = 0;                     // J, taken by artificial stress and hourglass control; they store, too
  double gravity_work = 0;                      // J
  Vec3 gravity_impulse = Vec3::Zero();          // N s
  Vec3 gravity_angular_impulse = Vec3::Zero();  // N m s
  double contact_work = 0;                      // J, of contact forces on the ice
  Vec3 momentum = Vec3::Zero();                 // N s, now
  Vec3 angular_momentum = Vec3::Zero();         // N m s, now
  double absorbed = 0;                          // J, taken by an absorbing rim
  Vec3 held_impulse = Vec3::Zero();             // N s, of fixed parts, an absorbing rim and sleeping ice
  Vec3 held_angular_impulse = Vec3::Zero();     // N m s
  double momentum_scale = 0;                    // N s, SUM m |v| now
};

class Ice {
 public:
  /// Throws std::invalid_argument for a spec that leaves no particle, and as with_reduced_stiffness. `surfaces`: the
  /// bodies' boundary particles at the start; later calls pass the same surfaces, moved, and those added since.
  explicit Ice(const IceSpec& spec, const std::vector<Surface>& surfaces = {}, const InitialState& initial = {});
  ~Ice();
  Ice(Ice&&) noexcept;

  /// One more surface, behind those it has.
  void add_surface(const Surface& surface);

  /// Largest stable step now, and why.
  StepLimit stable_step() const;

  /// First half of a step.
  void drift(double half_dt);
  /// Contact with each surface (boundary forces are written) and pair forces; dt is the whole step.
  void interact(std::vector<Surface>& surfaces, double dt);
  /// Throws NumericalFailure at the first non-finite or runaway particle (lowest index in order of creation).
  void kick(double dt);
  /// Second half of a step. Throws NumericalFailure if a density left the sane range.
  void drift_and_differentiate(double half_dt);

  /// All four, for ice whose surroundings do not move within the step.
  void step(std::vector<Surface>& surfaces, double dt);

  const Particles& particles() const;
  double spacing() const;
  double smoothing_length() const;
  const ElasticConstants& elastic_constants() const;
  Vec3 mean_velocity() const;  // m/s, of all particles
  /// Bounds on the speed of any particle [m/s] and, of the last step, on its acceleration [m/s2].
  double fastest() const;
  double largest_acceleration() const;
  /// Index in particles() of each particle in order of creation.
  std::vector<std::uint32_t> creation_order() const;

  IceLedger ledger() const;
  double absorbed() const;           // J, taken by an absorbing rim since the start
  std::size_t failed_count() const;  // particles that have failed (Particles::failed); 0 for elastic ice
  double failed_fraction() const;    // of all particles
  double asleep_fraction() const;    // of all particles, now; only with a quiet speed
  /// Deepest ice-particle centre behind a surface in the last step [m].
  double penetration(std::size_t surface) const;
  std::size_t correction_fallbacks() const;  // particle-steps whose moment matrix was singular
  std::size_t rebuilds() const;              // of the neighbour list
  std::size_t bytes() const;                 // memory held by particles and lists
  /// Terms that this ice does not use: no memory, no work.
  std::vector<std::string> terms_left_out() const;

 private:
  struct [[gnu::visibility("hidden")]] Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nilas::sph

#pragma GCC visibility pop
