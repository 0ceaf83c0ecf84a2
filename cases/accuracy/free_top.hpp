// Free rotation of a rigid body in closed form, and as it is flown: V36-V39.
#pragma once

#include <array>

#include "rigid/state.hpp"

namespace nilas::cases {

/// Second order as two resolutions show it: it comes up to 2 from either side.
constexpr double second_order = 1.95;

/// Angular velocity in the body's frame [rad/s] at a time [s].
struct TopSample {
  double time;
  Vec3 angular_velocity;
};

/// Principal moments of both tops [kg m2].
inline const Vec3 top_inertia(1, 2, 3);
/// V37, from (1, 1, 1): sqrt2 cn, sqrt2 sn, 1.1547 dn of 1.1547 t + 0.8260178762, m = 1/2 (Jacobi).
inline const std::array<TopSample, 4> euler_top_samples = {{{1, {-0.1266429229, 1.408531707, 0.8197638745}},
                                                            {2, {-1.199580742, 0.7490033661, 1.070668632}},
                                                            {5, {1.007980331, -0.9919554689, 1.002667168}},
                                                            {10, {-0.6034704231, -1.278993139, 0.8877267882}}}};
/// V38, from (0.01, 5, 0.01), about the axis of the middle moment, and its time from one flip to the next [s].
inline const std::array<TopSample, 4> dzhanibekov_samples = {{{2, {-1.16125006, 4.863290892, 0.6704977507}},
                                                              {3, {-3.868141808, -3.168213842, 2.23328764}},
                                                              {5, {-0.0113256939, -4.999997173, 0.01046058}},
                                                              {10, {0.01271487063, 4.999993833, 0.01097979865}}}};
constexpr double dzhanibekov_flip = 5.025929138;

/// A body at the origin with this angular velocity [rad/s] in its own frame.
inline rigid::State spinning(const Vec3& inertia, const Vec3& angular_velocity_body) {
  rigid::State state;
  state.angular_momentum = inertia.cwiseProduct(angular_velocity_body);
  return state;
}

inline Vec3 angular_velocity_body(const rigid::State& state, const Vec3& inertia) {
  return state.orientation.conjugate() * rigid::angular_velocity_world(state, inertia);
}

/// How far L = R I R^T omega has come from `start`, relative.
inline double angular_momentum_error(const rigid::State& state, const Vec3& inertia, const Vec3& start) {
  const Vec3 now = rigid::angular_momentum_world(state.orientation, inertia, angular_velocity_world(state, inertia));
  return (now - start).norm() / start.norm();
}

}  // namespace nilas::cases
