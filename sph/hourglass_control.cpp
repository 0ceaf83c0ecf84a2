#include "sph/hourglass_control.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sph/pair_passes_kernel.hpp"

namespace nilas::sph {

HourglassControl::HourglassControl(double xi, const ElasticConstants& elastic, const WendlandC2& kernel,
                                   const Period& period, std::size_t particles)
    : step_{2 * xi * elastic.shear_modulus * kernel.gradient_scale(),
            0.5 / kernel.smoothing_length(),
            period,
            2 * kDampingRatio * kernel.smoothing_length() / std::sqrt(7 * xi * elastic.shear_modulus / elastic.density),
            0,
            0},
      pass_((has_v3() ? v3::select_hourglass : baseline::select_hourglass)(period != Period::Zero())),
      first_(particles + 1, 0),
      index_of_id_(particles, 0) {}

void HourglassControl::follow(const Neighbours& neighbours, const Particles& particles) {
  const std::size_t n = particles.size();
  const double reach2 = neighbours.reach() * neighbours.reach();
  std::vector<std::size_t> piece(n);
  for (std::size_t i = 0; i < n; ++i) piece[i] = particles.piece(i);
  const auto whole = [&](std::size_t i) { return particles.failed.empty() || !particles.failed[i]; };
  const auto for_pairs_of = [&](std::size_t i, const auto& body) {
    if (!whole(i)) return;
    const Vec3& x = particles.motion[i].position;
    neighbours.for_each_near(i, [&](std::uint32_t j) {
      const Vec3 apart = shortest_image(particles.motion[j].position - x, step_.period);
      if (piece[j] == piece[i] && whole(j) && apart.squaredNorm() < reach2) body(j);
    });
  };

  std::vector<std::uint64_t> first(n + 1, 0);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) {
    std::uint64_t count = 0;
    for_pairs_of(i, [&](std::uint32_t) { ++count; });
    first[i + 1] = (count + 3) / 4;
  }
  std::partial_sum(first.begin(), first.end(), first.begin());

  std::vector<HourglassPairs> pairs(first[n]);
  constexpr std::uint64_t kNone = -1;
#pragma omp parallel
  {
    std::vector<std::uint64_t> place(n, kNone);  // of the pair with each particle, both as they were at the last call
#pragma omp for schedule(static)
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t i_before = index_of_id_[particles.id[i]];
      const std::uint64_t begin = 4 * first_[i_before], end = 4 * first_[i_before + 1];
      for (std::uint64_t k = begin; k < end; ++k) place[pairs_[k / 4].neighbour[k % 4]] = k;
      std::uint64_t k = 4 * first[i];
      for_pairs_of(i, [&](std::uint32_t j) {
        HourglassPairs& next = pairs[k / 4];
        next.neighbour[k % 4] = j;
        if (const std::uint64_t p = place[index_of_id_[particles.id[j]]]; p != kNone) {
          const HourglassPairs& known = pairs_[p / 4];
          next.x[k % 4] = known.x[p % 4], next.y[k % 4] = known.y[p % 4], next.z[k % 4] = known.z[p % 4];
        }
        ++k;
      });
      for (; k < 4 * first[i + 1]; ++k) pairs[k / 4].neighbour[k % 4] = static_cast<std::uint32_t>(i);
      for (std::uint64_t p = begin; p < end; ++p) place[pairs_[p / 4].neighbour[p % 4]] = kNone;
    }
  }
  first_.swap(first);
  pairs_.swap(pairs);
  for (std::size_t i = 0; i < n; ++i) index_of_id_[particles.id[i]] = static_cast<std::uint32_t>(i);
}

void HourglassControl::apply(Particles& particles, double dt) {
  // The half step that ended the last step, and the one that begins this.
  step_.elapsed = step_.half_step + 0.5 * dt;
  step_.half_step = 0.5 * dt;
  pass_(particles, first_, pairs_, step_);
}

std::size_t HourglassControl::bytes() const {
  return first_.capacity() * sizeof(first_[0]) + pairs_.capacity() * sizeof(HourglassPairs) +
         index_of_id_.capacity() * sizeof(std::uint32_t);
}

}  // namespace nilas::sph
