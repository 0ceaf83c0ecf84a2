#include "sph/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nilas::sph {

namespace {
// Particles per pool: large enough that a pool's growth is rare, small enough to balance threads. The division into
// pools is the same for any number of threads.
constexpr std::size_t kBlock = 1024;
constexpr std::size_t kSpare = 3;        // numbers that the search may read and write past the end
constexpr double kCellsPerParticle = 8;  // at most: cells cost memory and a pass over them at every rebuild
}  // namespace

Neighbours::Neighbours(double reach, const Period& period, const Vec3& bounds_lower, const Vec3& bounds_upper,
                       std::size_t particles)
    : reach_(reach), period_(period), origin_(bounds_lower), search_(neighbour_search((period.array() > 0).any())) {
  Vec3 length = bounds_upper - bounds_lower;
  for (int k = 0; k < 3; ++k)
    if (period_[k] > 0) length[k] = period_[k];
  const double most_cells = kCellsPerParticle * static_cast<double>(particles) + 4096;
  double size = reach_;
  while ((length / size).array().max(1).prod() > most_cells) size *= 1.25;
  for (int k = 0; k < 3; ++k) {
    cells_[k] = std::max(1, static_cast<int>(std::floor(length[k] / size)));
    inverse_cell_size_[k] = cells_[k] / std::max(length[k], size);
  }
}

std::array<int, 3> Neighbours::cell_of(const Vec3& position) const {
  std::array<int, 3> c;
  for (int k = 0; k < 3; ++k) {
    const double s = (position[k] - origin_[k]) * inverse_cell_size_[k];
    if (period_[k] > 0) {
      const double wrapped = s - cells_[k] * std::floor(s / cells_[k]);
      c[k] = std::min(static_cast<int>(wrapped), cells_[k] - 1);
    } else {
      c[k] = static_cast<int>(std::clamp(s, 0.0, cells_[k] - 1.0));
    }
  }
  return c;
}

std::size_t Neighbours::index_of(const std::array<int, 3>& c) const {
  return (static_cast<std::size_t>(c[0]) * cells_[1] + c[1]) * cells_[2] + c[2];
}

void Neighbours::rebuild(Particles& particles) {
  sort_by_cell(particles);
  list_neighbours();
}

void Neighbours::sort_by_cell(Particles& particles) {
  const std::size_t n = particles.size();
  const std::size_t cell_count = static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2];
  cell_of_particle_.resize(n);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i)
    cell_of_particle_[i] = static_cast<std::uint32_t>(index_of(cell_of(particles.motion[i].position)));

  cell_start_.assign(cell_count + 1, 0);
  for (std::size_t i = 0; i < n; ++i) ++cell_start_[cell_of_particle_[i] + 1];
  for (std::size_t c = 0; c < cell_count; ++c) cell_start_[c + 1] += cell_start_[c];
  order_.resize(n);
  std::vector<std::uint32_t> next(cell_start_.begin(), cell_start_.end() - 1);
  for (std::size_t i = 0; i < n; ++i) order_[next[cell_of_particle_[i]]++] = static_cast<std::uint32_t>(i);
  particles.permute(order_);

  first_.resize(n);
  for (auto& coordinate : positions_) coordinate.resize(n + kSpare);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) positions_[k][i] = particles.motion[i].position[k];
}

Neighbours::Runs Neighbours::runs_around(const std::array<int, 3>& c) const {
  // The cells within one cell of c along one axis, each once, also where the domain wraps within three cells.
  const auto around = [&](int axis) {
    std::array<int, 3> list{};
    int count = 0;
    for (int o = -1; o <= 1; ++o) {
      int k = c[axis] + o;
      if (period_[axis] > 0) {
        if (cells_[axis] < 3 && o == 1 && cells_[axis] != 1) continue;  // two cells: c-1 and c+1 are the same
        if (cells_[axis] == 1 && o != 0) continue;
        k = (k + cells_[axis]) % cells_[axis];
      } else if (k < 0 || k >= cells_[axis]) {
        continue;
      }
      list[count++] = k;
    }
    return std::pair{list, count};
  };
  const auto [xs, nx] = around(0);
  const auto [ys, ny] = around(1);
  const auto [zs, nz] = around(2);
  Runs runs;
  for (int a = 0; a < nx; ++a)
    for (int b = 0; b < ny; ++b)
      for (int d = 0; d < nz; ++d) {
        const std::size_t cell = index_of({xs[a], ys[b], zs[d]});
        const std::uint32_t begin = cell_start_[cell], end = cell_start_[cell + 1];
        if (begin == end) continue;
        runs.particles += end - begin;
        if (runs.count > 0 && runs.run[runs.count - 1].second == begin)
          runs.run[runs.count - 1].second = end;
        else
          runs.run[runs.count++] = {begin, end};
      }
  return runs;
}

void Neighbours::list_neighbours() {
  const std::size_t n = first_.size();
  const std::size_t blocks = (n + kBlock - 1) / kBlock;
  pools_.resize(std::max(pools_.size(), blocks));
  const double reach2 = reach_ * reach_;
  const SearchPositions positions{positions_[0].data(), positions_[1].data(), positions_[2].data()};

#pragma omp parallel for schedule(dynamic)
  for (std::size_t block = 0; block < blocks; ++block) {
    std::vector<std::uint32_t>& pool = pools_[block];
    std::size_t used = 0;
    std::size_t cell = std::numeric_limits<std::size_t>::max();
    Runs runs;
    const std::size_t end = std::min(n, (block + 1) * kBlock);
    for (std::size_t i = block * kBlock; i < end; ++i) {
      const Vec3 x = position_at_rebuild(i);
      const std::array<int, 3> c = cell_of(x);
      if (index_of(c) != cell) cell = index_of(c), runs = runs_around(c);
      if (pool.size() < used + runs.particles + kSpare) pool.resize(used + used / 8 + runs.particles + kSpare);
      const std::size_t begin = used;
      const auto search = [&](std::uint32_t from, std::uint32_t to) {
        used += search_(positions, x, period_, from, to, reach2, pool.data() + used);
      };
      const auto self = static_cast<std::uint32_t>(i);
      for (int r = 0; r < runs.count; ++r) {
        const auto [from, to] = runs.run[r];
        if (from <= self && self < to)
          search(from, self), search(self + 1, to);
        else
          search(from, to);
      }
      first_[i] = {begin, static_cast<std::uint32_t>(used - begin), static_cast<std::uint32_t>(block)};
    }
  }
}

std::size_t Neighbours::bytes() const {
  std::size_t total =
      (cell_start_.capacity() + cell_of_particle_.capacity() + order_.capacity()) * sizeof(std::uint32_t) +
      first_.capacity() * sizeof(Slice) + 3 * positions_[0].capacity() * sizeof(double);
  for (const auto& pool : pools_) total += pool.capacity() * sizeof(std::uint32_t);
  return total;
}

}  // namespace nilas::sph
