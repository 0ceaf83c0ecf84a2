#include "coupling/ice_plugin.hpp"

#include <stdexcept>

#include "coupling/host_rigid_body.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

IcePlugin::IcePlugin(SameBullet, sph::IceSpec ice, Impact::Observer observer)
    : ice_spec_(std::move(ice)), observer_(std::move(observer)) {}

void IcePlugin::attach(btRigidBody& bullet, const rigid::Shape& shape, double boundary_spacing,
                       const std::string& name) {
  const double spacing = boundary_spacing > 0 ? boundary_spacing : 0.75 * ice_spec_.spacing;
  attach(bullet, shape, spacing, rigid::centroid(shape), name);
}

void IcePlugin::attach(btRigidBody& bullet, const rigid::Shape& shape, double boundary_spacing,
                       const Vec3& centre_of_mass, const std::string& name) {
  if (impact_) throw std::logic_error("IcePlugin::attach after the first step");
  bodies_.push_back(body_of(bullet, shape, boundary_spacing, centre_of_mass, name));
  hosts_.push_back(std::make_unique<HostRigidBody>(bullet));
}

Impact& IcePlugin::impact() {
  if (!impact_) impact_ = std::make_unique<Impact>(ice_spec_, std::move(bodies_), std::move(observer_));
  return *impact_;
}

void IcePlugin::updateAction(btCollisionWorld*, btScalar dt) {
  Impact& impact = this->impact();
  std::vector<ExternalLoad> loads;
  for (std::size_t k = 0; k < hosts_.size(); ++k) loads.push_back(hosts_[k]->take_over(impact.body(k), dt));
  impact.advance(dt, loads);
  for (std::size_t k = 0; k < hosts_.size(); ++k) hosts_[k]->hand_back(impact.bodies()[k]);
}

}  // namespace NILAS_BULLET
}  // namespace nilas
