#include "coupling/rest.hpp"

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

Rest::Rest(const sph::Ice& ice, double sleep_speed, bool undisturbed)
    : sleep_speed_(sleep_speed), crossing_time_(0), margin_(kMarginRatio * ice.spacing()) {
  if (sleep_speed_ <= 0) return;
  bounds(ice, lower_, upper_);
  const sph::ElasticConstants& elastic = ice.elastic_constants();
  crossing_time_ = (upper_ - lower_).maxCoeff() / std::sqrt(elastic.shear_modulus / elastic.density);
  asleep_ = undisturbed;
}

void Rest::wake() {
  asleep_ = false;
  quiet_time_ = 0;
}

bool Rest::quiet(const sph::Ice& ice, double dt) {
  if (sleep_speed_ <= 0) return false;
  const bool calm = ice.fastest() <= sleep_speed_ && ice.largest_acceleration() * crossing_time_ <= sleep_speed_;
  quiet_time_ = calm ? quiet_time_ + dt : 0;
  return quiet_time_ >= kQuietCrossings * crossing_time_;
}

void Rest::sleep(const sph::Ice& ice, const std::vector<Body>& bodies) {
  quiet_time_ = 0;
  bounds(ice, lower_, upper_);
  bodies_.clear();
  for (const Body& body : bodies) bodies_.push_back(body.state());
  asleep_ = true;
}

bool Rest::reached_by(std::size_t index, const Body& body, const ExternalLoad& load, double dt) const {
  const bool rests = !body.moves_freely() && body.state().momentum.isZero(0) && body.state().angular_momentum.isZero(0);
  if (rests && index < bodies_.size() && same_pose(body.state(), bodies_[index])) return false;
  const double reach = body.enclosing_radius() + margin_ + 2 * body.spec().boundary_spacing +
                       dt * (body.velocity().norm() + 0.5 * dt * load.force.norm() / body.spec().mass.mass);
  const Vec3& x = body.state().position;
  return (x - x.cwiseMax(lower_).cwiseMin(upper_)).squaredNorm() <= reach * reach;
}

}  // namespace nilas
