// Whether a solid is still in one piece: how far neighbours of the initial lattice have come apart.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "sph/ice.hpp"

namespace nilas::cases {

class LatticeBonds {
 public:
  /// All pairs of particles that are one spacing apart now (not across a periodic side).
  explicit LatticeBonds(const sph::Ice& ice) : spacing_(ice.spacing()) {
    const sph::Particles& p = ice.particles();
    std::vector<std::uint32_t> along_x(p.size());
    for (std::uint32_t i = 0; i < along_x.size(); ++i) along_x[i] = i;
    const auto x = [&](std::uint32_t i) { return p.motion[i].position[0]; };
    std::sort(along_x.begin(), along_x.end(), [&](std::uint32_t i, std::uint32_t j) { return x(i) < x(j); });
    const double reach = 1.1 * spacing_;
    for (auto i = along_x.begin(); i != along_x.end(); ++i)
      for (auto j = i + 1; j != along_x.end() && x(*j) < x(*i) + reach; ++j)
        if ((p.motion[*i].position - p.motion[*j].position).norm() < reach) pairs_.emplace_back(p.id[*i], p.id[*j]);
  }

  /// Largest distance of such a pair now, in spacings, less one.
  double largest_stretch(const sph::Ice& ice) const {
    const auto order = ice.creation_order();
    const std::vector<sph::Motion>& motion = ice.particles().motion;
    double largest = 0;
    for (const auto& [i, j] : pairs_)
      largest = std::max(largest, (motion[order[i]].position - motion[order[j]].position).norm());
    return largest / spacing_ - 1;
  }

 private:
  double spacing_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;  // in order of creation
};

}  // namespace nilas::cases
