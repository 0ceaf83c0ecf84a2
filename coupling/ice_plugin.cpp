#include "coupling/ice_plugin.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "coupling/clearance.hpp"
#include "coupling/debug_drawing.hpp"
#include "coupling/host_multibody_link.hpp"
#include "coupling/host_rigid_body.hpp"
#include "rigid/bullet_shape.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

namespace {

// All in spacings of the ice.
constexpr double kLargestPush = 0.25;
constexpr double kDeepest = -0.5;  // clearance from which on a body is in the ice
constexpr double kClear = 0.5;     // clearance at which contact ends
constexpr double kBoundarySpacing = 0.75;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

IcePlugin::IcePlugin(SameBullet, const sph::IceSpec& ice, const HostOptions& options, Impact::Observer observer)
    : impact_(ice, {}, std::move(observer), {}, options.sleep_speed), options_(options) {}

std::size_t IcePlugin::attach(btRigidBody& bullet, const rigid::Shape& shape, double boundary_spacing,
                              const std::string& name) {
  const double spacing = boundary_spacing > 0 ? boundary_spacing : kBoundarySpacing * impact_.ice().spacing();
  return attach(bullet, shape, spacing, rigid::centroid(shape), name);
}

std::size_t IcePlugin::attach(btRigidBody& bullet, const rigid::Shape& shape, double boundary_spacing,
                              const Vec3& centre_of_mass, const std::string& name) {
  const Body body = body_of(bullet, shape, boundary_spacing, centre_of_mass, name);
  return admit(std::make_unique<HostRigidBody>(bullet, kLargestPush * impact_.ice().spacing()), body);
}

std::size_t IcePlugin::attach(btRigidBody& bullet, double boundary_spacing, const std::string& name) {
  const double spacing = boundary_spacing > 0 ? boundary_spacing : kBoundarySpacing * impact_.ice().spacing();
  return attach(bullet, rigid::shape_of(*bullet.getCollisionShape()), spacing, Vec3::Zero(), name);
}

std::size_t IcePlugin::attach(btMultiBody& multibody, int link, const rigid::Shape& shape, double boundary_spacing,
                              const std::string& name) {
  const double spacing = boundary_spacing > 0 ? boundary_spacing : kBoundarySpacing * impact_.ice().spacing();
  return attach(multibody, link, shape, spacing, rigid::centroid(shape), name);
}

std::size_t IcePlugin::attach(btMultiBody& multibody, int link, const rigid::Shape& shape, double boundary_spacing,
                              const Vec3& centre_of_mass, const std::string& name) {
  const Body body = body_of(multibody, link, shape, boundary_spacing, centre_of_mass, name);
  return admit(std::make_unique<HostMultibodyLink>(multibody, link, name, kLargestPush * impact_.ice().spacing()),
               body);
}

std::size_t IcePlugin::attach(btMultiBody& multibody, int link, double boundary_spacing, const std::string& name) {
  const double spacing = boundary_spacing > 0 ? boundary_spacing : kBoundarySpacing * impact_.ice().spacing();
  return attach(multibody, link, rigid::shape_of(collision_shape(multibody, link)), spacing, Vec3::Zero(), name);
}

std::size_t IcePlugin::admit(std::unique_ptr<HostBody> host, const Body& body) {
  for (const Guest& guest : guests_)
    if (guest.host && &guest.host->object() == &host->object())
      throw std::invalid_argument("IcePlugin::attach: body " + body.spec().name + " is attached already");
  guests_.push_back({std::move(host), true});
  return impact_.add(body);
}

void IcePlugin::detach(const btCollisionObject& body) {
  const auto guest = std::find_if(guests_.begin(), guests_.end(),
                                  [&](const Guest& g) { return g.host && &g.host->object() == &body; });
  if (guest == guests_.end()) throw std::invalid_argument("IcePlugin::detach: the body is not attached");
  guest->host->release();
  guest->host.reset();
  impact_.presence(static_cast<std::size_t>(guest - guests_.begin()), Presence::away);
}

/// What the host did to body k in this step, and whether the ice meets it.
ExternalLoad IcePlugin::take_over(std::size_t k, const btCollisionWorld* world, double dt) {
  Guest& guest = guests_[k];
  if (!guest.host) return {};
  if (!guest.host->in(world)) {
    impact_.presence(k, Presence::away);
    guest.placed = true;
    return {};
  }
  const HostTurn turn = guest.host->take_over(impact_.body(k), dt, last_step_.time_behind);
  if (turn.refitted) impact_.limit_coupling();
  if (turn.jumped) guest.placed = true;
  if (guest.placed) {
    const double least = impact_.presence(k) == Presence::unfelt ? kClear : kDeepest;
    guest.placed = clearance(impact_.ice(), impact_.bodies()[k]) < least * impact_.ice().spacing();
  }
  impact_.presence(k, guest.placed ? Presence::unfelt : Presence::felt);
  return turn.load;
}

void IcePlugin::updateAction(btCollisionWorld* world, btScalar dt) {
  if (!failure_.empty()) throw sph::NumericalFailure("the ice stopped in an earlier step: " + failure_);
  try {
    step(world, dt);
  } catch (const std::exception& error) {
    failure_ = error.what();
    throw;
  }
}

/// A stretch of time in which only those bodies move that were attached when it was the host's.
double IcePlugin::advance(Stretch& stretch, const std::function<bool()>& spent) {
  std::vector<std::pair<std::size_t, Presence>> late;
  for (std::size_t k = stretch.loads.size(); k < guests_.size(); ++k) late.emplace_back(k, impact_.presence(k));
  for (const auto& [k, presence] : late) impact_.presence(k, Presence::away);
  const double left = impact_.advance(stretch.duration, stretch.loads, spent);
  for (const auto& [k, presence] : late) impact_.presence(k, presence);
  return left;
}

void IcePlugin::step(const btCollisionWorld* world, double dt) {
  if (!(dt >= 0)) throw std::invalid_argument("IcePlugin: a step of " + std::to_string(dt) + " s; allowed: 0 or more");
  const Clock::time_point start = Clock::now();
  const StepRecord before = impact_.last_step();
  accounts_.clear();
  for (const Body& body : impact_.bodies()) accounts_.push_back(body.account());
  Stretch stretch{dt, {}};
  for (std::size_t k = 0; k < guests_.size(); ++k) stretch.loads.push_back(take_over(k, world, dt));
  undone_.push_back(std::move(stretch));

  std::function<bool()> spent;
  if (options_.budget > 0) spent = [&] { return seconds_since(start) >= options_.budget; };
  while (!undone_.empty()) {
    Stretch& next = undone_.front();
    next.duration = advance(next, spent);
    if (next.duration > 0) break;
    undone_.pop_front();
    if (spent && spent()) break;
  }

  for (std::size_t k = 0; k < guests_.size(); ++k)
    if (impact_.presence(k) != Presence::away) guests_[k].host->hand_back(impact_.bodies()[k]);
  simulated_ = impact_.last_step().time - before.time;
  last_step_ = {impact_.last_step().number - before.number, seconds_since(start), 0, impact_.asleep()};
  for (const Stretch& s : undone_) last_step_.time_behind += s.duration;
}

BodyLoad IcePlugin::load(const btCollisionObject& body) const {
  for (std::size_t k = 0; k < guests_.size(); ++k)
    if (guests_[k].host && &guests_[k].host->object() == &body)
      return k < accounts_.size() ? load_since(accounts_[k], impact_.bodies()[k], simulated_) : BodyLoad{};
  throw std::invalid_argument("IcePlugin::load: this body is not attached");
}

void IcePlugin::debugDraw(btIDebugDraw* drawer) {
  // Bullet asks its actions in other modes, too.
  if (drawer->getDebugMode() & btIDebugDraw::DBG_DrawWireframe) debug_draw(impact_, *drawer);
}

}  // namespace NILAS_BULLET
}  // namespace nilas
