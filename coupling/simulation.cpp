#include "coupling/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"

namespace nilas {

/// Members are destroyed in reverse order: bodies leave the world before it goes.
struct Simulation::BulletHost {
  BulletHost(const sph::IceSpec& ice, const std::vector<rigid::BodySpec>& specs, Impact::Observer observer)
      : plugin(ice, HostOptions{.sleep_speed = 0}, std::move(observer)) {
    const Vec3& g = ice.gravity;
    world.world().setGravity(btVector3(g.x(), g.y(), g.z()));
    for (const rigid::BodySpec& spec : specs) {
      bodies.push_back(std::make_unique<rigid::BulletBody>(spec));
      world.world().addRigidBody(&bodies.back()->body());
      plugin.attach(bodies.back()->body(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, spec.name);
    }
    world.world().addAction(&plugin);
  }
  ~BulletHost() {
    world.world().removeAction(&plugin);
    for (const auto& body : bodies) world.world().removeRigidBody(&body->body());
  }

  std::vector<std::unique_ptr<rigid::BulletBody>> bodies;
  IcePlugin plugin;
  rigid::BulletWorld world;
};

Simulation::Simulation(const sph::IceSpec& ice, const std::vector<rigid::BodySpec>& specs, double bullet_step,
                       Impact::Observer observer)
    : bullet_step_(bullet_step) {
  const auto moves = [](const rigid::BodySpec& spec) {
    return spec.motion == rigid::Motion::free || spec.motion == rigid::Motion::translation_only;
  };
  if (std::any_of(specs.begin(), specs.end(), moves))
    host_ = std::make_unique<BulletHost>(ice, specs, std::move(observer));
  else
    stand_alone_ = std::make_unique<Impact>(ice, std::vector<Body>(specs.begin(), specs.end()), std::move(observer));
}
Simulation::~Simulation() = default;

Impact& Simulation::impact() { return host_ ? host_->plugin.impact() : *stand_alone_; }

void Simulation::advance_to(double time) {
  const double duration = time - time_;
  if (duration <= 0) return;
  if (host_) {
    const double steps = std::ceil(duration / bullet_step_ * (1 - 1e-12));
    const double dt = duration / steps;
    // maxSubSteps 0: Bullet takes exactly the step it is given.
    for (int n = 0; n < steps; ++n) host_->world.world().stepSimulation(dt, 0);
  } else {
    stand_alone_->advance(duration);
  }
  time_ = time;
}

}  // namespace nilas
