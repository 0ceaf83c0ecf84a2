#include "sph/ice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sph/absorbing_rim.hpp"
#include "sph/artificial_stress.hpp"
#include "sph/chunked_sum.hpp"
#include "sph/contact.hpp"
#include "sph/density_diffusion.hpp"
#include "sph/density_reinitialisation.hpp"
#include "sph/hourglass_control.hpp"
#include "sph/neighbours.hpp"
#include "sph/quiet_ice.hpp"
#include "sph/reduced_stiffness.hpp"
#include "sph/shifting.hpp"
#include "sph/state_sums.hpp"
#include "sph/stress_update.hpp"
#include "sph/terms.hpp"

namespace nilas::sph {

namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
// Debris faster than this multiple of the fastest body or ice at the start, and faster than sound in ice, is numerical.
constexpr double kRunawayRatio = 5;

/// What a kick finds on its way through the particles.
struct KickSums {
  double speed2 = 0, acceleration2 = 0;
  Vec3 momentum = Vec3::Zero();
  Vec3 held_impulse = Vec3::Zero(), held_angular_impulse = Vec3::Zero();
  double stabilisation_power = 0;  // W
  Vec3 positions = Vec3::Zero();   // m, sum over all particles: only with gravity
  std::uint32_t bad_id = std::numeric_limits<std::uint32_t>::max();
  KickSums& operator+=(const KickSums& o) {
    speed2 = std::max(speed2, o.speed2);
    acceleration2 = std::max(acceleration2, o.acceleration2);
    momentum += o.momentum;
    held_impulse += o.held_impulse;
    held_angular_impulse += o.held_angular_impulse;
    stabilisation_power += o.stabilisation_power;
    positions += o.positions;
    bad_id = std::min(bad_id, o.bad_id);
    return *this;
  }
};

/// Box of the lattice, widened by whole pairs of layers so that fragments keep columns of their own for a while.
std::pair<Vec3, Vec3> grid_bounds(const Particles& particles, double spacing) {
  Vec3 lower = particles.motion[0].position, upper = lower;
  for (const Motion& m : particles.motion) {
    lower = lower.cwiseMin(m.position);
    upper = upper.cwiseMax(m.position);
  }
  const Vec3 margin = Vec3::Constant(2 * spacing * std::ceil((upper - lower).minCoeff() / (2 * spacing)));
  return {lower - margin, upper + margin};
}

Neighbours make_neighbours(const IceSpec& spec, const Particles& particles, double reach, const Period& period) {
  const auto [lower, upper] = grid_bounds(particles, spec.spacing);
  return Neighbours(reach, spec.spacing, period, lower, upper, particles.size(), spec.numerics.precision);
}

/// By which shifting may move a particle in a step [m].
double largest_shift(const IceSpec& spec) { return spec.numerics.shifting > 0 ? Shifting::kLargest * spec.spacing : 0; }

Period period_of(const IceSpec& spec) {
  Period period = Period::Zero();
  for (int k = 0; k < 3; ++k)
    if (spec.periodic[k]) period[k] = std::round(extent(spec.pieces.front())[k] / spec.spacing) * spec.spacing;
  return period;
}

}  // namespace

struct Ice::Impl {
  Impl(const IceSpec& ice_spec, const std::vector<Surface>& surfaces, const InitialState& initial);

  void allow_speed(double fastest);
  void add_surface(const Surface& surface);
  void move(double dt);
  Vec3 momentum() const { return particles.mass * static_cast<double>(particles.size()) * mean_velocity; }
  void refresh_neighbours(double dt);
  void stabilise(double dt);
  void regularise(double dt);
  void fail(std::size_t particle, const std::string& what) const;

  IceSpec spec;
  ElasticConstants elastic;
  WendlandC2 kernel;
  Particles particles;
  Period period;
  double skin;
  Neighbours neighbours;
  PairPasses passes;
  PairConstants pair_constants;
  Material material;
  ContactConstants contact_constants;
  std::vector<Contact> contacts;
  // Empty where the term is off.
  std::optional<ArtificialStress> artificial_stress;
  std::optional<DensityDiffusion> density_diffusion;
  std::optional<Shifting> shifting;
  std::optional<HourglassControl> hourglass_control;
  std::optional<AbsorbingRim> absorbing_rim;
  std::optional<QuietIce> quiet_ice;

  double speed = 0, acceleration = 0;  // largest magnitudes after the last kick
  Vec3 mean_velocity = Vec3::Zero();
  double runaway_speed = 0;
  std::size_t failed = 0, fallbacks = 0, rebuild_count = 0;
  int since_reinitialisation = 0;  // steps
  bool neighbours_valid = false;
  double stress_work = 0, viscous = 0, contact_work = 0, stabilisation = 0, gravity_work = 0;
  Vec3 gravity_impulse = Vec3::Zero(), gravity_angular_impulse = Vec3::Zero();
  Vec3 held_impulse = Vec3::Zero(), held_angular_impulse = Vec3::Zero();
};

Ice::Impl::Impl(const IceSpec& ice_spec, const std::vector<Surface>& surfaces, const InitialState& initial)
    : spec(with_reduced_stiffness(ice_spec)),
      elastic(spec.material),
      kernel(spec.numerics.smoothing_ratio * spec.spacing),
      particles(lattice(spec, initial)),
      period(period_of(spec)),
      skin(spec.numerics.skin_ratio * kernel.support_radius() + 2 * largest_shift(spec)),
      neighbours(make_neighbours(spec, particles, kernel.support_radius() + skin, period)),
      passes(pair_passes({spec.numerics.gradient_correction,
                          spec.numerics.viscosity_alpha > 0 || spec.numerics.viscosity_beta > 0,
                          period != Period::Zero(), spec.numerics.precision == Precision::single})),
      pair_constants{kernel.smoothing_length(),       kernel.gradient_scale(),      elastic.bulk_sound_speed(),
                     spec.numerics.viscosity_alpha,   spec.numerics.viscosity_beta, period,
                     particles.mass / elastic.density},
      material(make_material(spec.material, spec.spacing, kernel.smoothing_length())),
      contact_constants(spec.contact, elastic, spec.spacing) {
  const NumericsSpec& numerics = spec.numerics;
  if (numerics.artificial_stress > 0) artificial_stress.emplace(numerics, spec.spacing, period);
  if (numerics.density_diffusion > 0)
    density_diffusion.emplace(numerics.density_diffusion * kernel.smoothing_length() * elastic.bulk_sound_speed(),
                              pair_constants.solid_volume, kernel, period);
  if (numerics.shifting > 0)
    shifting.emplace(numerics.shifting, spec.spacing, pair_constants.solid_volume, kernel, period);
  if (has_absorbing_rim(spec)) absorbing_rim.emplace(spec, elastic, particles, kernel.support_radius());
  for (const Motion& m : particles.motion) mean_velocity += m.velocity / static_cast<double>(particles.size());
  double fastest = 0;
  for (const Motion& m : particles.motion) {
    speed = std::max(speed, (m.velocity - mean_velocity).norm());
    fastest = std::max(fastest, m.velocity.norm());
  }
  allow_speed(fastest);
  for (const Surface& s : surfaces) add_surface(s);
  if (spec.numerics.hourglass_control > 0)
    hourglass_control.emplace(spec.numerics.hourglass_control, elastic, kernel, period, particles.size());
  refresh_neighbours(0);
  fallbacks += passes.velocity_gradient(particles, neighbours, pair_constants);
  if (has_quiet_ice(spec)) quiet_ice.emplace(spec.numerics.quiet_speed, elastic).follow(neighbours, particles);
}

void Ice::Impl::allow_speed(double fastest) {
  runaway_speed = std::max({runaway_speed, elastic.p_wave_speed() + fastest, kRunawayRatio * fastest});
}

void Ice::Impl::add_surface(const Surface& surface) {
  contacts.emplace_back(contact_constants, surface.spacing, skin);
  double fastest = 0;
  for (const BoundaryParticle& b : surface.particles) fastest = std::max(fastest, b.velocity.norm());
  allow_speed(fastest);
}

void Ice::Impl::move(double dt) {
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (particles.awake(i)) particles.motion[i].position += dt * particles.motion[i].velocity;
}

/// Rebuilds the neighbour list unless it will stay valid over a step of dt.
void Ice::Impl::refresh_neighbours(double dt) {
  if (neighbours_valid) {
    const double expected = dt * (speed + mean_velocity.norm() + dt * acceleration) + largest_shift(spec);
    if (neighbours.largest_displacement(particles) + expected <= 0.5 * skin) return;
  }
  neighbours.rebuild(particles);
  for (Contact& c : contacts) c.invalidate();
  if (hourglass_control) hourglass_control->follow(neighbours, particles);
  if (absorbing_rim) absorbing_rim->follow(particles);
  if (quiet_ice) quiet_ice->follow(neighbours, particles);
  neighbours_valid = true;
  ++rebuild_count;
}

/// Adds to the acceleration what the stabilising terms contribute, and keeps their sum for the ledger.
void Ice::Impl::stabilise(double dt) {
  if (particles.stabilisation.empty()) return;
  std::fill(particles.stabilisation.begin(), particles.stabilisation.end(), Vec3::Zero());
  if (artificial_stress) artificial_stress->apply(particles, neighbours);
  if (hourglass_control) hourglass_control->apply(particles, dt);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < particles.size(); ++i) particles.acceleration[i] += particles.stabilisation[i];
}

/// What changes positions and volumes for the sake of the pair sums; dt is the whole step.
void Ice::Impl::regularise(double dt) {
  if (shifting) shifting->apply(particles, neighbours);
  if (density_diffusion) density_diffusion->apply(particles, neighbours, dt);
  const int every = spec.numerics.density_reinitialisation;
  if (every > 0 && ++since_reinitialisation == every) {
    reinitialise_density(particles, neighbours, pair_constants.solid_volume, kernel, period);
    since_reinitialisation = 0;
  }
}

void Ice::Impl::fail(std::size_t particle, const std::string& what) const {
  throw failure_of(particles, neighbours, period, particle, what);
}

Ice::Ice(const IceSpec& spec, const std::vector<Surface>& surfaces, const InitialState& initial)
    : impl_(std::make_unique<Impl>(spec, surfaces, initial)) {}
Ice::~Ice() = default;
Ice::Ice(Ice&&) noexcept = default;

void Ice::add_surface(const Surface& surface) { impl_->add_surface(surface); }

StepLimit Ice::stable_step() const {
  const Impl& s = *impl_;
  return sph::stable_step(s.spec.numerics, s.elastic, s.contact_constants, s.particles.mass,
                          s.kernel.smoothing_length(), s.speed, s.acceleration, !s.contacts.empty(),
                          kelvin_voigt_viscosity(s.spec.material, s.kernel.smoothing_length()));
}

void Ice::drift(double half_dt) {
  Impl& s = *impl_;
  s.refresh_neighbours(2 * half_dt);
  s.move(half_dt);
  const StressUpdateSums sums = update_stress(s.particles, s.material, s.elastic.density, half_dt);
  if (sums.out_of_range != kNone) s.fail(sums.out_of_range, "has collapsed");
  s.stress_work += sums.work;
  turn_correction(s.particles, half_dt);
}

void Ice::interact(std::vector<Surface>& surfaces, double dt) {
  Impl& s = *impl_;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < s.particles.size(); ++i) s.particles.acceleration[i] = s.spec.gravity;
  for (std::size_t k = 0; k < surfaces.size(); ++k) s.contacts[k].apply(s.particles, surfaces[k]);
  if (s.quiet_ice) s.quiet_ice->wake_touched(s.neighbours, s.contacts, s.particles);
  s.stabilise(dt);
  s.viscous += dt * s.passes.acceleration(s.particles, s.neighbours, s.pair_constants, dt).viscous_power;
  for (const Contact& contact : s.contacts)
    for (const ContactForce& f : contact.forces()) {
      if (s.particles.held[f.particle]) continue;
      s.contact_work +=
          dt * f.force.dot(s.particles.motion[f.particle].velocity + 0.5 * dt * s.particles.acceleration[f.particle]);
    }
}

void Ice::kick(double dt) {
  Impl& s = *impl_;
  if (s.absorbing_rim) s.absorbing_rim->apply(s.particles, dt);
  const double limit2 = s.runaway_speed * s.runaway_speed;
  const bool gravity = s.spec.gravity != Vec3::Zero(), stabilised = !s.particles.stabilisation.empty();
  const KickSums sums = chunked_sum<KickSums>(s.particles.size(), [&](std::size_t i, KickSums& k) {
    Motion& m = s.particles.motion[i];
    Vec3& a = s.particles.acceleration[i];
    if (gravity) k.positions += m.position;
    if (s.particles.sleep_depth(i) > 1) return;
    if (s.particles.held[i] || !s.particles.awake(i)) {
      const Vec3 impulse = -s.particles.mass * dt * a;
      k.held_impulse += impulse;
      k.held_angular_impulse += m.position.cross(impulse);
      a.setZero();
      return;
    }
    if (stabilised)
      k.stabilisation_power -= s.particles.mass * s.particles.stabilisation[i].dot(m.velocity + 0.5 * dt * a);
    m.velocity += dt * a;
    k.momentum += s.particles.mass * m.velocity;
    k.acceleration2 = std::max(k.acceleration2, a.squaredNorm());
    k.speed2 = std::max(k.speed2, (m.velocity - s.mean_velocity).squaredNorm());
    // Also true for a NaN.
    if (!(m.velocity.squaredNorm() <= limit2)) k.bad_id = std::min(k.bad_id, s.particles.id[i]);
  });
  if (sums.bad_id != std::numeric_limits<std::uint32_t>::max()) {
    const auto at = std::find(s.particles.id.begin(), s.particles.id.end(), sums.bad_id);
    s.fail(static_cast<std::size_t>(at - s.particles.id.begin()), "is non-finite or has run away");
  }
  if (s.quiet_ice) s.quiet_ice->wake_stirred(s.neighbours, s.particles);
  s.speed = std::sqrt(sums.speed2);
  s.acceleration = std::sqrt(sums.acceleration2);
  const double count = static_cast<double>(s.particles.size());
  if (gravity) {
    s.gravity_work += dt * s.spec.gravity.dot(0.5 * (s.momentum() + sums.momentum));
    s.gravity_impulse += dt * count * s.particles.mass * s.spec.gravity;
    s.gravity_angular_impulse += dt * s.particles.mass * sums.positions.cross(s.spec.gravity);
  }
  s.stabilisation += dt * sums.stabilisation_power;
  s.mean_velocity = sums.momentum / (s.particles.mass * count);
  s.held_impulse += sums.held_impulse;
  s.held_angular_impulse += sums.held_angular_impulse;
}

void Ice::drift_and_differentiate(double half_dt) {
  Impl& s = *impl_;
  s.move(half_dt);
  s.regularise(2 * half_dt);
  s.fallbacks += s.passes.velocity_gradient(s.particles, s.neighbours, s.pair_constants);
  const StressUpdateSums sums = update_stress(s.particles, s.material, s.elastic.density, half_dt);
  if (sums.out_of_range != kNone) s.fail(sums.out_of_range, "has collapsed");
  s.stress_work += sums.work;
  s.failed = sums.failed;
}

void Ice::step(std::vector<Surface>& surfaces, double dt) {
  drift(dt / 2);
  interact(surfaces, dt);
  kick(dt);
  drift_and_differentiate(dt / 2);
}

const Particles& Ice::particles() const { return impl_->particles; }
double Ice::spacing() const { return impl_->spec.spacing; }
double Ice::smoothing_length() const { return impl_->kernel.smoothing_length(); }
const ElasticConstants& Ice::elastic_constants() const { return impl_->elastic; }
Vec3 Ice::mean_velocity() const { return impl_->mean_velocity; }
double Ice::fastest() const { return impl_->mean_velocity.norm() + impl_->speed; }
double Ice::largest_acceleration() const { return impl_->acceleration; }

std::vector<std::uint32_t> Ice::creation_order() const {
  std::vector<std::uint32_t> order(impl_->particles.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[impl_->particles.id[i]] = i;
  return order;
}

IceLedger Ice::ledger() const {
  const Impl& s = *impl_;
  const StateSums sums = state_sums(s.particles);
  IceLedger ledger;
  ledger.kinetic = sums.kinetic;
  ledger.elastic = elastic_energy(s.particles, s.material);
  ledger.stress_work = s.stress_work;
  ledger.viscous = s.viscous;
  ledger.stabilisation = s.stabilisation;
  ledger.gravity_work = s.gravity_work;
  ledger.gravity_impulse = s.gravity_impulse;
  ledger.gravity_angular_impulse = s.gravity_angular_impulse;
  ledger.contact_work = s.contact_work;
  ledger.momentum = sums.momentum;
  ledger.angular_momentum = sums.angular_momentum;
  ledger.held_impulse = s.held_impulse;
  ledger.held_angular_impulse = s.held_angular_impulse;
  if (s.absorbing_rim) {
    ledger.absorbed = s.absorbing_rim->account().energy;
    ledger.held_impulse += s.absorbing_rim->account().impulse;
    ledger.held_angular_impulse += s.absorbing_rim->account().angular_impulse;
  }
  ledger.momentum_scale = sums.momentum_scale;
  return ledger;
}

double Ice::absorbed() const { return impl_->absorbing_rim ? impl_->absorbing_rim->account().energy : 0; }

std::size_t Ice::failed_count() const { return impl_->failed; }
double Ice::asleep_fraction() const {
  const auto& sleep = impl_->particles.sleep;
  const auto awake = static_cast<std::size_t>(std::count(sleep.begin(), sleep.end(), 0));
  return static_cast<double>(sleep.size() - awake) / static_cast<double>(impl_->particles.size());
}
double Ice::failed_fraction() const {
  return static_cast<double>(failed_count()) / static_cast<double>(impl_->particles.size());
}
std::size_t Ice::correction_fallbacks() const { return impl_->fallbacks; }
std::size_t Ice::rebuilds() const { return impl_->rebuild_count; }

double Ice::penetration(std::size_t surface) const { return impl_->contacts[surface].penetration(); }

std::size_t Ice::bytes() const {
  const Particles& p = impl_->particles;
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  const auto of_term = [](const auto& term) { return term ? term->bytes() : 0; };
  std::size_t contacts = 0;
  for (const Contact& contact : impl_->contacts) contacts += contact.bytes();
  return contacts + of(p.motion) + of(p.stress) + of(p.velocity_gradient) + of(p.acceleration) + of(p.held) + of(p.id) +
         of(p.correction) + of(p.stabilisation) + of(p.plastic_strain) + of(p.failed) + of(p.bulking) +
         of_term(impl_->artificial_stress) + of_term(impl_->density_diffusion) + of_term(impl_->hourglass_control) +
         of_term(impl_->shifting) + of_term(impl_->absorbing_rim) + of_term(impl_->quiet_ice) + of(p.sleep) +
         of(p.strain_rate) + of(p.tensile_damage) + of(p.shear_damage) + of(p.deformation_gradient) +
         of(p.piece_begin) + p.pair_records.bytes() + p.single_pair_records.bytes() + impl_->neighbours.bytes();
}

std::vector<std::string> Ice::terms_left_out() const {
  return sph::terms_left_out(impl_->spec, !impl_->contacts.empty());
}

}  // namespace nilas::sph
