#include "coupling/ice_plugin.hpp"

#include <stdexcept>

#include "coupling/debug_drawing.hpp"
#include "coupling/host_rigid_body.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

IcePlugin::IcePlugin(sph::IceSpec ice, Impact::Observer observer)
    : ice_spec_(std::move(ice)), observer_(std::move(observer)) {}

IcePlugin::IcePlugin(sph::IceSpec ice, const sph::ContactSpec& contact, Impact::Observer observer)
    : IcePlugin(std::move(ice), std::move(observer)) {
  ice_spec_.contact = contact;
}

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

BodyLoad IcePlugin::load(const btCollisionObject& body) const {
  for (std::size_t k = 0; k < hosts_.size(); ++k) {
    if (&hosts_[k]->object() != &body) continue;
    return k < accounts_.size() ? load_since(accounts_[k], impact_->bodies()[k], last_step_) : BodyLoad{};
  }
  throw std::invalid_argument("IcePlugin::load: this body is not attached");
}

void IcePlugin::debugDraw(btIDebugDraw* drawer) {
  // Bullet asks its actions in other modes, too.
  if (impact_ && (drawer->getDebugMode() & btIDebugDraw::DBG_DrawWireframe)) debug_draw(*impact_, *drawer);
}

void IcePlugin::updateAction(btCollisionWorld*, btScalar dt) {
  Impact& impact = this->impact();
  last_step_ = dt;
  accounts_.clear();
  for (const Body& body : impact.bodies()) accounts_.push_back(body.account());
  std::vector<ExternalLoad> loads;
  for (std::size_t k = 0; k < hosts_.size(); ++k) loads.push_back(hosts_[k]->take_over(impact.body(k), dt));
  impact.advance(dt, loads);
  for (std::size_t k = 0; k < hosts_.size(); ++k) hosts_[k]->hand_back(impact.bodies()[k]);
}

}  // namespace NILAS_BULLET
}  // namespace nilas
