#include "coupling/impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/stability_number.hpp"

namespace nilas {

namespace {

// A body turns by at most this per sub-step [rad]: boundary velocities are linear in the angle only for small ones.
constexpr double kLargestTurn = 0.05;
// Its surface moves into the ice by at most this per sub-step [spacings]: contact reaches two spacings deep, and ice
// that a step leaves behind that is never pushed out.
constexpr double kLargestAdvance = 0.25;

// Flight beside sleeping ice: turning by this much per step keeps the second-order splitting's error in attitude below
// 1e-6 of the turn.
constexpr double kFlightTurn = 0.005;
constexpr double kMostFlightSteps = 1e4;

/// The fastest that any part of the surface moves into ice of that velocity, along its own normal [m/s].
double advance_speed(const sph::Surface& surface, const Vec3& ice_velocity) {
  double speed = 0;
  for (const sph::BoundaryParticle& b : surface.particles)
    speed = std::max(speed, (b.velocity - ice_velocity).dot(b.normal));
  return speed;
}

void require_finite(const Body& body) {
  const rigid::State& s = body.state();
  if (!s.momentum.allFinite() || !s.angular_momentum.allFinite() || !s.position.allFinite() ||
      !s.orientation.coeffs().allFinite())
    throw sph::NumericalFailure("the pose or the momentum of body " + body.spec().name + " is not finite");
}

}  // namespace

Impact::Impact(const sph::IceSpec& ice, const std::vector<Body>& bodies, Observer observer,
               const sph::InitialState& initial, double sleep_speed)
    : ice_(ice, {}, initial),
      ledger_(ice_),
      rest_(ice_, sleep_speed, ice.gravity.norm()),
      max_coupling_number_(ice.numerics.max_coupling_number),
      contact_(ice.contact),
      observer_(std::move(observer)) {
  for (const Body& body : bodies) add(body);
}

std::size_t Impact::add(const Body& body) {
  bodies_.push_back(body);
  presence_.push_back(Presence::felt);
  surfaces_.push_back(body.make_surface());
  ice_.add_surface(surfaces_.back());
  ledger_.add(body);
  limit_coupling();
  return bodies_.size() - 1;
}

void Impact::limit_coupling() {
  double rate = 0;
  for (std::size_t k = 0; k < bodies_.size() && max_coupling_number_ > 0; ++k)
    if (presence_[k] == Presence::felt)
      rate = std::max(rate, stability_rate({bodies_[k]}, ice_.elastic_constants(), contact_));
  longest_step_ = rate > 0 ? max_coupling_number_ / rate : std::numeric_limits<double>::infinity();
}

void Impact::presence(std::size_t body, Presence presence) {
  if (presence == presence_[body]) return;
  presence_[body] = presence;
  surfaces_[body].present = presence == Presence::felt;
  limit_coupling();
}

void Impact::substep(double dt, const std::vector<ExternalLoad>& loads) {
  const auto moves = [&](std::size_t k) { return presence_[k] != Presence::away; };
  const auto load = [&](std::size_t k) { return k < loads.size() ? loads[k] : ExternalLoad{}; };
  // Drift: bodies, boundary particles and ice to the middle of the step.
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (moves(k)) bodies_[k].drift(dt / 2), bodies_[k].place(surfaces_[k]);
  ice_.drift(dt / 2);
  // Kick: every interaction once, on both sides.
  ice_.interact(surfaces_, dt);
  ice_.kick(dt);
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (moves(k)) bodies_[k].kick(surfaces_[k], load(k), dt), require_finite(bodies_[k]);
  // Drift: to the end of the step.
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (moves(k)) bodies_[k].drift(dt / 2);
  ice_.drift_and_differentiate(dt / 2);
}

void Impact::fly(double duration, const std::vector<ExternalLoad>& loads) {
  const sph::Surface untouched;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (presence_[k] == Presence::away) continue;
    const double turn = bodies_[k].angular_velocity().norm() * duration;
    const double steps = std::clamp(std::ceil(turn / kFlightTurn), 1.0, kMostFlightSteps);
    for (int n = 0; n < steps; ++n) {
      bodies_[k].drift(duration / steps / 2);
      bodies_[k].kick(untouched, k < loads.size() ? loads[k] : ExternalLoad{}, duration / steps);
      bodies_[k].drift(duration / steps / 2);
    }
    require_finite(bodies_[k]);
  }
}

bool Impact::body_within_reach(double duration, const std::vector<ExternalLoad>& loads) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (rest_.woken_by(k, bodies_[k], presence_[k], k < loads.size() ? loads[k] : ExternalLoad{}, duration))
      return true;
  return false;
}

sph::StepLimit Impact::stable_step() const {
  sph::StepLimit limit = ice_.stable_step();
  if (longest_step_ < limit.dt) limit = {longest_step_, sph::Limiter::coupling};
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    if (presence_[k] == Presence::away) continue;
    const double rate = bodies_[k].angular_velocity().norm();
    if (rate * limit.dt > kLargestTurn) limit = {kLargestTurn / rate, sph::Limiter::body_rotation};
  }
  for (const sph::Surface& surface : surfaces_) {
    if (!surface.present) continue;
    const double speed = advance_speed(surface, ice_.mean_velocity()), advance = kLargestAdvance * ice_.spacing();
    if (speed * limit.dt > advance) limit = {advance / speed, sph::Limiter::body_speed};
  }
  return limit;
}

double Impact::advance(double duration, const std::vector<ExternalLoad>& loads, const std::function<bool()>& enough) {
  double remaining = duration;
  while (remaining > 0) {
    if (rest_.asleep() && !body_within_reach(remaining, loads)) {
      fly(remaining, loads);
      record_.time += remaining;
      if (observer_) observer_(*this);
      return 0;
    }
    if (rest_.asleep()) rest_.wake();
    const sph::StepLimit limit = stable_step();
    const double steps_left = std::ceil(remaining / limit.dt);
    const bool last = steps_left <= 1;
    const double dt = last ? remaining : remaining / steps_left;
    substep(dt, loads);
    remaining = last ? 0 : remaining - dt;
    record_ = {dt, limit.limiter, record_.number + 1, record_.time + dt};
    if (observer_) observer_(*this);
    if (rest_.quiet(ice_, dt)) {
      rest_.sleep(ice_, bodies_, presence_);
      if (body_within_reach(0, loads)) rest_.wake();
    }
    if (enough && enough()) break;
  }
  return remaining;
}

}  // namespace nilas
