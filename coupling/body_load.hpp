// The load of the ice on one body as a host asks for it, for rendering or control.
#pragma once

#include <optional>

#include "coupling/body.hpp"

#pragma GCC visibility push(default)

namespace nilas {

/// World frame.
struct BodyLoad {
  Vec3 force = Vec3::Zero();            // N, mean over the last host step
  Vec3 moment = Vec3::Zero();           // N m, the same, about the body's centre of mass
  Vec3 impulse = Vec3::Zero();          // N s, since the start
  Vec3 angular_impulse = Vec3::Zero();  // N m s, since the start, about the centre of mass at each instant
  /// m. Where ice pressed on the surface during the last host step: mean position of the boundary particles, weighted
  /// with the magnitude of their force and with time, carried along with the body to the end of the step. Nothing if
  /// nothing touched. It shows a place; the moment is `moment`: a body pressed from two sides has its centre between
  /// them, inside, and friction or a lever between them gives a moment about it.
  std::optional<Vec3> centre;
};

/// The load since `before`, the body's account `duration` [s] ago, during which nothing but the coupling moved it.
BodyLoad load_since(const BodyAccount& before, const Body& body, double duration);

}  // namespace nilas

#pragma GCC visibility pop
