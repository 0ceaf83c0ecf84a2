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

std::vector<sph::Surface> surfaces_of(const std::vector<Body>& bodies) {
  std::vector<sph::Surface> surfaces;
  for (const Body& body : bodies) surfaces.push_back(body.make_surface());
  return surfaces;
}

double longest_coupled_step(const sph::IceSpec& ice, const std::vector<Body>& bodies) {
  const double rate = ice.numerics.max_coupling_number > 0
                          ? stability_rate(bodies, sph::ElasticConstants(ice.material), ice.contact)
                          : 0;
  return rate > 0 ? ice.numerics.max_coupling_number / rate : std::numeric_limits<double>::infinity();
}

/// The fastest that any part of the surface moves into ice of that velocity, along its own normal [m/s].
double advance_speed(const sph::Surface& surface, const Vec3& ice_velocity) {
  double speed = 0;
  for (const sph::BoundaryParticle& b : surface.particles)
    speed = std::max(speed, (b.velocity - ice_velocity).dot(b.normal));
  return speed;
}

void require_finite(const Body& body) {
  const rigid::State& s = body.state();
  if (!s.momentum.allFinite() || !s.angular_momentum.allFinite())
    throw sph::NumericalFailure("the momentum of body " + body.spec().name + " is not finite");
}

}  // namespace

Impact::Impact(const sph::IceSpec& ice, std::vector<Body> bodies, Observer observer, const sph::InitialState& initial)
    : bodies_(std::move(bodies)),
      surfaces_(surfaces_of(bodies_)),
      ice_(ice, surfaces_, initial),
      ledger_(ice_, bodies_),
      longest_step_(longest_coupled_step(ice, bodies_)),
      observer_(std::move(observer)) {}

void Impact::substep(double dt, const std::vector<ExternalLoad>& loads) {
  // Drift: bodies, boundary particles and ice to the middle of the step.
  for (Body& body : bodies_) body.drift(dt / 2);
  for (std::size_t k = 0; k < bodies_.size(); ++k) bodies_[k].place(surfaces_[k]);
  ice_.drift(dt / 2);
  // Kick: every interaction once, on both sides.
  ice_.interact(surfaces_, dt);
  ice_.kick(dt);
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    bodies_[k].kick(surfaces_[k], loads.empty() ? ExternalLoad{} : loads[k], dt);
  for (const Body& body : bodies_) require_finite(body);
  // Drift: to the end of the step.
  for (Body& body : bodies_) body.drift(dt / 2);
  ice_.drift_and_differentiate(dt / 2);
}

sph::StepLimit Impact::stable_step() const {
  sph::StepLimit limit = ice_.stable_step();
  if (longest_step_ < limit.dt) limit = {longest_step_, sph::Limiter::coupling};
  for (const Body& body : bodies_) {
    const double rate = body.angular_velocity().norm();
    if (rate * limit.dt > kLargestTurn) limit = {kLargestTurn / rate, sph::Limiter::body_rotation};
  }
  for (const sph::Surface& surface : surfaces_) {
    const double speed = advance_speed(surface, ice_.mean_velocity()), advance = kLargestAdvance * ice_.spacing();
    if (speed * limit.dt > advance) limit = {advance / speed, sph::Limiter::body_speed};
  }
  return limit;
}

void Impact::advance(double duration, const std::vector<ExternalLoad>& loads) {
  double remaining = duration;
  while (remaining > 0) {
    sph::StepLimit limit = stable_step();
    const double steps_left = std::ceil(remaining / limit.dt);
    const bool last = steps_left <= 1;
    const double dt = last ? remaining : remaining / steps_left;
    substep(dt, loads);
    remaining = last ? 0 : remaining - dt;
    record_ = {dt, limit.limiter, record_.number + 1, record_.time + dt};
    if (observer_) observer_(*this);
  }
}

}  // namespace nilas
