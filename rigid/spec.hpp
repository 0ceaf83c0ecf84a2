// What a caller states about a rigid body. SI units, world frame.
#pragma once

#include <string>

#include "rigid/mass_properties.hpp"
#include "rigid/state.hpp"

namespace nilas::rigid {

/// free: six degrees of freedom. translation_only: attitude held. fixed_path: initial velocity and spin held.
/// fixed: at rest for ever.
enum class Motion { free, translation_only, fixed_path, fixed };

struct BodySpec {
  std::string name;
  Shape shape;
  double boundary_spacing = 0;  // m, of the boundary particles
  MassProperties mass;
  Motion motion = Motion::free;
  Vec3 position = Vec3::Zero();  // m, centre of mass
  Quat orientation = Quat::Identity();
  Vec3 velocity = Vec3::Zero();          // m/s, of the centre of mass
  Vec3 angular_velocity = Vec3::Zero();  // rad/s
};

}  // namespace nilas::rigid
