// A run of its own: ice, bodies and, if any body moves freely, the Bullet world that hosts them through IcePlugin.
#pragma once

#include <memory>
#include <vector>

#include "coupling/impact.hpp"

#pragma GCC visibility push(default)

namespace nilas {

class Simulation {
 public:
  /// bullet_step [s]: step of the Bullet world; the ice's gravity is its gravity. Scenes in which no body moves freely
  /// create no Bullet world.
  Simulation(const sph::IceSpec& ice, const std::vector<rigid::BodySpec>& bodies, double bullet_step,
             Impact::Observer observer = {});
  ~Simulation();

  /// Advances to `time` [s] since the start, by whole Bullet steps and a shorter last one.
  /// Throws sph::NumericalFailure.
  void advance_to(double time);
  Impact& impact();
  bool has_bullet_world() const { return host_ != nullptr; }

 private:
  struct BulletHost;
  std::unique_ptr<BulletHost> host_;     // with free bodies
  std::unique_ptr<Impact> stand_alone_;  // without
  double bullet_step_;
  double time_ = 0;
};

}  // namespace nilas

#pragma GCC visibility pop
