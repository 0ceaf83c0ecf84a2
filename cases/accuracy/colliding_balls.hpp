// Two equal balls of the paper's ice, 60 mm, that meet head-on at 100 m/s: what the invariance cases displace, mirror
// and turn.
#pragma once

#include <vector>

#include "cases/accuracy/advance.hpp"
#include "cases/material_presets.hpp"
#include "cases/scheme.hpp"

namespace nilas::cases {

struct CollidingBalls {
  static constexpr double diameter = 0.06;  // m
  static constexpr double speed = 50;       // m/s, of each

  Vec3 axis = Vec3::UnitZ();     // from the first ball to the second
  Vec3 centre = Vec3::Zero();    // m, where they meet
  Vec3 velocity = Vec3::Zero();  // m/s, of that point

  sph::Ice make(const Scheme& scheme, double dx) const {
    sph::IceSpec spec;
    for (const int side : {-1, 1}) {
      sph::PieceSpec ball;
      ball.shape = sph::IceShape::sphere;
      ball.diameter = diameter;
      ball.centre = centre + side * 0.5 * (diameter + 2 * scheme.numerics.smoothing_ratio * dx) * axis;
      ball.velocity = velocity - side * speed * axis;
      spec.pieces.push_back(ball);
    }
    spec.spacing = dx;
    spec.material = cai_2025_ice();
    spec.numerics = scheme.numerics;
    return sph::Ice(spec);
  }
  /// Until the balls have come half a radius closer than they touch [s].
  static double duration(const Scheme& scheme, double dx) {
    return (diameter / 4 + 2 * scheme.numerics.smoothing_ratio * dx) / (2 * speed);
  }
};

/// Momentum of the first piece of two equal ones [N s].
inline Vec3 momentum_of_first(const sph::Ice& ice) {
  const sph::Particles& p = ice.particles();
  Vec3 momentum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.id[i] < p.size() / 2) momentum += p.mass * p.motion[i].velocity;
  return momentum;
}

}  // namespace nilas::cases
