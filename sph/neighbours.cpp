#include "sph/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sph/chunked_sum.hpp"

namespace nilas::sph {

namespace {
// Particles per block: large enough that most pairs are within one, small enough to balance threads.
constexpr std::size_t kBlockParticles = 1024;
constexpr double kColumnsPerParticle = 8;  // at most: columns cost memory and a pass over them at every rebuild

struct Largest {
  double value = 0;
  Largest& operator+=(const Largest& o) {
    value = std::max(value, o.value);
    return *this;
  }
};

/// Bits of x at the even places, of y at the odd ones.
std::uint64_t interleave(std::uint32_t x, std::uint32_t y) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < 32; ++bit)
    code |= (static_cast<std::uint64_t>((x >> bit) & 1) << (2 * bit)) |
            (static_cast<std::uint64_t>((y >> bit) & 1) << (2 * bit + 1));
  return code;
}
}  // namespace

Neighbours::Neighbours(double reach, double spacing, const Period& period, const Vec3& bounds_lower,
                       const Vec3& bounds_upper, std::size_t particles, Precision precision)
    : reach_(reach),
      period_(period),
      origin_(bounds_lower),
      group_size_(precision == Precision::single ? 8 : 4),
      block_size_(kBlockParticles / group_size_),
      search_(neighbour_search(group_size_, (period.array() > 0).any())) {
  const double most_columns = kColumnsPerParticle * static_cast<double>(particles) + 4096;
  std::array<double, 2> length;
  for (int k = 0; k < 2; ++k) length[k] = period_[k] > 0 ? period_[k] : bounds_upper[k] - bounds_lower[k];
  double width = 2 * spacing;
  while (std::max(1.0, length[0] / width) * std::max(1.0, length[1] / width) > most_columns) width *= 1.25;
  for (int k = 0; k < 2; ++k) {
    if (period_[k] > 0) {
      columns_[k] = std::max(1, static_cast<int>(std::floor(length[k] / width * (1 + 1e-12))));
      inverse_width_[k] = columns_[k] / length[k];
    } else {
      // Columns hold whole layers of a lattice that begins at the lower bound.
      origin_[k] -= 0.5 * spacing;
      columns_[k] = 1 + static_cast<int>((bounds_upper[k] - origin_[k]) / width);
      inverse_width_[k] = 1 / width;
    }
  }
  rank_columns();
}

/// Along a Morton curve, so that columns that are near in space are near in memory.
void Neighbours::rank_columns() {
  const auto count = static_cast<std::uint32_t>(columns_[0] * columns_[1]);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> curve(count);
  for (std::uint32_t c = 0; c < count; ++c) curve[c] = {interleave(c / columns_[1], c % columns_[1]), c};
  std::sort(curve.begin(), curve.end());
  rank_.resize(count);
  for (std::uint32_t r = 0; r < count; ++r) rank_[curve[r].second] = r;
}

Vec3 Neighbours::wrapped(const Vec3& position) const {
  Vec3 x = position;
  for (int k = 0; k < 3; ++k)
    if (period_[k] > 0) x[k] -= period_[k] * std::floor((x[k] - origin_[k]) / period_[k]);
  return x;
}

std::array<int, 2> Neighbours::column_of(const Vec3& wrapped) const {
  std::array<int, 2> c;
  for (int k = 0; k < 2; ++k)
    c[k] = static_cast<int>(std::clamp((wrapped[k] - origin_[k]) * inverse_width_[k], 0.0, columns_[k] - 1.0));
  return c;
}

void Neighbours::rebuild(Particles& particles) {
  sort(particles);
  form_groups(particles);
  list_groups();
}

void Neighbours::sort(Particles& particles) {
  const std::size_t n = particles.size(), columns = rank_.size();
  column_of_particle_.resize(n);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) {
    const auto [x, y] = column_of(wrapped(particles.motion[i].position));
    column_of_particle_[i] = rank_[static_cast<std::size_t>(x) * columns_[1] + y];
  }
  column_begin_.assign(columns + 1, 0);
  for (std::size_t i = 0; i < n; ++i) ++column_begin_[column_of_particle_[i] + 1];
  std::partial_sum(column_begin_.begin(), column_begin_.end(), column_begin_.begin());
  order_.resize(n);
  next_.assign(column_begin_.begin(), column_begin_.end() - 1);
  for (std::size_t i = 0; i < n; ++i) order_[next_[column_of_particle_[i]]++] = static_cast<std::uint32_t>(i);
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t c = 0; c < columns; ++c) {
    const auto lower = [&](std::uint32_t a, std::uint32_t b) {
      const double za = wrapped(particles.motion[a].position)[2], zb = wrapped(particles.motion[b].position)[2];
      return za < zb || (za == zb && particles.id[a] < particles.id[b]);
    };
    std::sort(order_.begin() + column_begin_[c], order_.begin() + column_begin_[c + 1], lower);
  }
  particles.permute(order_);
}

void Neighbours::form_groups(const Particles& particles) {
  const std::size_t columns = rank_.size(), places = group_size_;
  first_group_.resize(columns + 1);
  first_group_[0] = 0;
  for (std::size_t c = 0; c < columns; ++c)
    first_group_[c + 1] =
        first_group_[c] + static_cast<std::uint32_t>((column_begin_[c + 1] - column_begin_[c] + places - 1) / places);
  const std::size_t groups = first_group_[columns];
  group_begin_.resize(groups + 1);
  group_begin_[groups] = static_cast<std::uint32_t>(particles.size());
  box_.resize(groups);
  positions_.resize(3 * places * groups);
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t g = first_group_[c]; g < first_group_[c + 1]; ++g) {
      const auto begin = static_cast<std::uint32_t>(column_begin_[c] + places * (g - first_group_[c]));
      const auto end = std::min<std::uint32_t>(begin + places, column_begin_[c + 1]);
      group_begin_[g] = begin;
      double* const x = positions_.data() + 3 * places * g;
      std::fill(x, x + 3 * places, std::numeric_limits<double>::quiet_NaN());
      Vec3 lower = wrapped(particles.motion[begin].position), upper = lower;
      for (std::uint32_t i = begin; i < end; ++i) {
        const Vec3& position = particles.motion[i].position;
        lower = lower.cwiseMin(wrapped(position)), upper = upper.cwiseMax(wrapped(position));
        for (std::size_t k = 0; k < 3; ++k) x[places * k + (i - begin)] = position[k];
      }
      box_[g] = {0.5 * (lower + upper), 0.5 * (upper - lower)};
    }
}

void Neighbours::find_candidates(std::size_t group, Candidates& candidates) const {
  for (auto& part : candidates) part.clear();
  const std::size_t block = group / block_size_;
  const Box& box = box_[group];
  // A little more than reach, for the rounding of the boxes.
  const double reach = reach_ * (1 + 1e-12), reach2 = reach * reach;
  // Columns that a sphere around any particle of the group meets.
  std::array<int, 2> begin, end;
  const auto low = column_of(box.centre - box.half - Vec3::Constant(reach)),
             high = column_of(box.centre + box.half + Vec3::Constant(reach));
  for (int k = 0; k < 2; ++k) {
    begin[k] = low[k], end[k] = high[k] + 1;
    if (period_[k] > 0) {
      begin[k] = static_cast<int>(std::floor((box.centre[k] - box.half[k] - reach - origin_[k]) * inverse_width_[k]));
      end[k] = 1 + static_cast<int>(std::floor((box.centre[k] + box.half[k] + reach - origin_[k]) * inverse_width_[k]));
      if (end[k] - begin[k] >= columns_[k]) begin[k] = 0, end[k] = columns_[k];
    }
  }
  const auto around = [](int c, int count) { return c < 0 ? c + count : c >= count ? c - count : c; };
  const double lowest = box.centre[2] - box.half[2] - reach, highest = box.centre[2] + box.half[2] + reach;
  for (int x = begin[0]; x < end[0]; ++x)
    for (int y = begin[1]; y < end[1]; ++y) {
      const std::uint32_t column =
          rank_[static_cast<std::size_t>(around(x, columns_[0])) * columns_[1] + around(y, columns_[1])];
      std::uint32_t g = first_group_[column];
      const std::uint32_t last = first_group_[column + 1];
      if (period_[2] == 0)  // groups of a column lie one above the other
        g = static_cast<std::uint32_t>(
            std::partition_point(box_.begin() + g, box_.begin() + last,
                                 [&](const Box& b) { return b.centre[2] + b.half[2] < lowest; }) -
            box_.begin());
      for (; g < last; ++g) {
        const Box& other = box_[g];
        if (period_[2] == 0 && other.centre[2] - other.half[2] > highest) break;
        const Vec3 apart = shortest_image(other.centre - box.centre, period_).cwiseAbs() - other.half - box.half;
        if (apart.cwiseMax(0).squaredNorm() < reach2)
          candidates[g == group || g / block_size_ != block ? 1 : g < group ? 0 : 2].push_back(g);
      }
    }
}

void Neighbours::list_groups() {
  const std::size_t blocks = block_count();
  list_.resize(group_begin_.back());
  pools_.resize(std::max(pools_.size(), blocks));
#pragma omp parallel
  {
    Candidates candidates;
    std::vector<std::uint32_t> found;
#pragma omp for schedule(dynamic)
    for (std::size_t block = 0; block < blocks; ++block) {
      std::size_t used = 0;
      for (std::size_t g = block_begin(block); g < block_begin(block + 1); ++g) {
        find_candidates(g, candidates);
        const std::size_t members = group_begin_[g + 1] - group_begin_[g];
        const std::size_t most = members * (candidates[0].size() + candidates[1].size() + candidates[2].size());
        if (found.size() < used + most) found.resize(2 * used + most);
        for (std::size_t place = 0; place < members; ++place) {
          const double* const own = positions_.data() + 3 * group_size_ * g + place;
          const Vec3 x(own[0], own[group_size_], own[2 * group_size_]);
          List& list = list_[group_begin_[g] + place];
          list.pool = static_cast<std::uint32_t>(block);
          for (std::size_t part = 0; part < 3; ++part) {
            list.begin[part] = static_cast<std::uint32_t>(used);
            used += search_(positions_.data(), x, period_, candidates[part], reach_ * reach_, found.data() + used);
          }
          list.begin[3] = static_cast<std::uint32_t>(used);
        }
      }
      pools_[block].assign(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(used));
    }
  }
}

double Neighbours::largest_displacement(const Particles& particles) const {
  const auto moved2 = chunked_sum<Largest>(group_count(), [&](std::size_t g, Largest& largest) {
    if (!particles.awake(group_begin_[g])) return;
    for (std::uint32_t i = group_begin_[g]; i < group_begin_[g + 1]; ++i) {
      const double* const x = positions_.data() + 3 * group_size_ * g + (i - group_begin_[g]);
      const Vec3 moved = particles.motion[i].position - Vec3(x[0], x[group_size_], x[2 * group_size_]);
      largest.value = std::max(largest.value, moved.squaredNorm());
    }
  });
  return std::sqrt(moved2.value);
}

std::size_t Neighbours::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = of(rank_) + of(column_begin_) + of(first_group_) + of(group_begin_) + of(box_) + of(positions_) +
                      of(list_) + of(column_of_particle_) + of(order_) + of(next_) + of(pools_);
  for (const auto& pool : pools_) total += of(pool);
  return total;
}

}  // namespace nilas::sph
