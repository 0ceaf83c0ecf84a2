// A small result whose every value is known: seven particles and one body of two boundary particles, at t = 0, 0.5 ms,
// 1 ms, ... The Python readers of this folder state the same formulas in their own words.
#pragma once

#include <vector>

#include "cases/results.hpp"

namespace nilas::test {

constexpr int known_particles = 7;

inline double known_time(int frame) { return 5e-4 * frame; }

/// Particle i moves along y at 100 m/s from (i, 2 i, -i) m; its pressure is 1000 i + t/s Pa.
inline cases::IceFrame known_ice(int frame) {
  const double t = known_time(frame);
  cases::IceFrame ice{t, {}, {{"pressure_Pa", 1, {}}, {"velocity_m_s", 3, {}}}};
  for (int i = 0; i < known_particles; ++i) {
    ice.position.push_back(Vec3(i, 2 * i + 100 * t, -i));
    ice.fields[0].values.push_back(static_cast<float>(1000 * i + t));
    ice.fields[1].values.insert(ice.fields[1].values.end(), {0, 100, static_cast<float>(i)});
  }
  return ice;
}

inline cases::BodyDescription known_body() {
  return {.name = "hcc",
          .shape = "hcc",
          .boundary_position_body = {Vec3(0, 0, 1), Vec3(0, 0.25, 0)},
          .boundary_normal_body = {Vec3(0, 0, 1), Vec3(0, 1, 0)},
          .boundary_area = {0.5, 0.125},
          .outline_body = {Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}};
}

/// The body rises at 80 m/s without turning; boundary particle b feels (b, 0, -1e6 t/s) Pa.
inline cases::BodyFrame known_body_frame(int frame) {
  const double t = known_time(frame);
  cases::BodyFrame body;
  body.state.position = Vec3(0, 0, -1 + 80 * t);
  body.state.orientation = rigid::Quat(0, 1, 0, 0);  // w, x, y, z: half a turn about x
  body.velocity = Vec3(0, 0, 80);
  body.angular_velocity = Vec3(0, 0, 20);
  body.traction = {Vec3(0, 0, -1e6 * t), Vec3(1, 0, -1e6 * t)};
  body.impulse = {Vec3(0, 0, -0.5 * t), Vec3(0.125 * t, 0, 0)};
  return body;
}

}  // namespace nilas::test
