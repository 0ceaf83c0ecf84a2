#include "coupling/rest.hpp"

#include <algorithm>
#include <cmath>

namespace nilas {

namespace {
// Contact begins half a spacing from a surface; more room than that for the boundary particles' own spread.
constexpr double kMarginRatio = 4;  // margin / spacing
constexpr double kQuietCrossings = 2;

void bounds(const sph::Ice& ice, Vec3& lower, Vec3& upper) {
  const auto& motion = ice.particles().motion;
  lower = upper = motion[0].position;
  for (const sph::Motion& m : motion) {
    lower = lower.cwiseMin(m.position);
    upper = upper.cwiseMax(m.position);
  }
}

bool same_pose(const rigid::State& a, const rigid::State& b) {
  return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs();
}
}  // namespace

Rest::Rest(const sph::Ice& ice, double sleep_speed, double gravity)
    : sleep_speed_(sleep_speed), margin_(kMarginRatio * ice.spacing()) {
  if (sleep_speed_ <= 0) return;
  bounds(ice, lower_, upper_);
  const sph::ElasticConstants& elastic = ice.elastic_constants();
  crossing_time_ = (upper_ - lower_).maxCoeff() / std::sqrt(elastic.shear_modulus / elastic.density);
  quiet_before_sleep_ = kQuietCrossings * crossing_time_;
  if (gravity > 0) quiet_before_sleep_ = std::max(quiet_before_sleep_, 4 * sleep_speed_ / gravity);
  asleep_ = gravity == 0 && ice.fastest() == 0;
}

void Rest::wake() {
  asleep_ = false;
  quiet_time_ = 0;
}

bool Rest::quiet(const sph::Ice& ice, double dt) {
  if (sleep_speed_ <= 0) return false;
  const bool calm = ice.fastest() <= sleep_speed_ && ice.largest_acceleration() * crossing_time_ <= sleep_speed_;
  quiet_time_ = calm ? quiet_time_ + dt : 0;
  return quiet_time_ >= quiet_before_sleep_;
}

void Rest::sleep(const sph::Ice& ice, const std::vector<Body>& bodies, const std::vector<Presence>& presence) {
  quiet_time_ = 0;
  bounds(ice, lower_, upper_);
  bodies_.clear();
  for (const Body& body : bodies) bodies_.push_back(body.state());
  presence_ = presence;
  asleep_ = true;
}

bool Rest::woken_by(std::size_t index, const Body& body, Presence presence, const ExternalLoad& load, double dt) const {
  const bool known = index < bodies_.size();
  if (known && presence_[index] == Presence::felt && presence != Presence::felt && within_reach(bodies_[index], body))
    return true;  // what may have carried the ice has gone
  if (presence != Presence::felt) return false;
  const bool rests = !body.moves_freely() && body.state().momentum.isZero(0) && body.state().angular_momentum.isZero(0);
  if (rests && known && presence_[index] == Presence::felt) return !same_pose(body.state(), bodies_[index]);
  const double way = dt * (body.velocity().norm() + 0.5 * dt * load.force.norm() / body.spec().mass.mass);
  return within_reach(body.state(), body, way);
}

bool Rest::within_reach(const rigid::State& state, const Body& body, double way) const {
  const double reach = body.enclosing_radius() + margin_ + 2 * body.spec().boundary_spacing + way;
  const Vec3& x = state.position;
  return (x - x.cwiseMax(lower_).cwiseMin(upper_)).squaredNorm() <= reach * reach;
}

}  // namespace nilas
