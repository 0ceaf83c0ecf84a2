// Steps ice that meets no moving body, for the verification cases.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sph/ice.hpp"

namespace nilas::cases {

/// Steps `ice` to exactly `end` [s] at its stable step; record(time, dt) is called after every step. Returns the number
/// of steps. `surfaces`: bodies that do not move.
template <class Record>
std::size_t advance(sph::Ice& ice, std::vector<sph::Surface>& surfaces, double end, const Record& record) {
  std::size_t steps = 0;
  for (double time = 0; time < end * (1 - 1e-12); ++steps) {
    const double left = end - time;
    const double dt = left / std::ceil(left / ice.stable_step().dt * (1 - 1e-12));
    ice.step(surfaces, dt);
    time += dt;
    record(time, dt);
  }
  return steps;
}
template <class Record>
std::size_t advance(sph::Ice& ice, double end, const Record& record) {
  std::vector<sph::Surface> none;
  return advance(ice, none, end, record);
}

}  // namespace nilas::cases
