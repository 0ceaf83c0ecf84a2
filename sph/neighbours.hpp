// Cell list and neighbour list. The list holds every pair closer than the kernel radius plus a skin, so it stays valid
// until some particle has moved half the skin; building it also yields the cell order in which particles are kept.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sph/neighbour_search.hpp"
#include "sph/particles.hpp"

namespace nilas::sph {

/// Period of the domain per axis [m], 0 along axes that do not wrap.
using Period = Vec3;

/// Shortest image of a separation.
inline Vec3 shortest_image(Vec3 d, const Period& period) {
  for (int k = 0; k < 3; ++k)
    if (period[k] > 0) d[k] -= period[k] * std::nearbyint(d[k] / period[k]);
  return d;
}

class Neighbours {
 public:
  /// reach [m]: kernel radius + skin. `bounds_lower/upper`: box outside which particles share the outermost cells
  /// (their neighbours are still all found; a runaway particle cannot make the grid grow). A box that would need many
  /// more cells than there are `particles` gets larger ones.
  Neighbours(double reach, const Period& period, const Vec3& bounds_lower, const Vec3& bounds_upper,
             std::size_t particles);

  /// Sorts the particles by cell and lists the neighbours of each. The order within a list depends on the positions
  /// only, not on the number of threads.
  void rebuild(Particles& particles);

  /// Indices of the listed neighbours of particle i, without i itself.
  std::span<const std::uint32_t> of(std::size_t i) const {
    return {pools_[first_[i].pool].data() + first_[i].begin, first_[i].count};
  }
  /// Position of particle i at the last rebuild [m].
  Vec3 position_at_rebuild(std::size_t i) const { return {positions_[0][i], positions_[1][i], positions_[2][i]}; }
  std::size_t bytes() const;

 private:
  struct Slice {
    std::uint64_t begin;
    std::uint32_t count;
    std::uint32_t pool;
  };
  std::array<int, 3> cell_of(const Vec3& position) const;
  std::size_t index_of(const std::array<int, 3>& c) const;
  void sort_by_cell(Particles& particles);
  void list_neighbours();
  /// Runs of particles that lie in the cells around c: cells that follow each other along the last axis are one run.
  struct Runs {
    std::array<std::pair<std::uint32_t, std::uint32_t>, 27> run;
    int count = 0;
    std::uint32_t particles = 0;
  };
  Runs runs_around(const std::array<int, 3>& c) const;

  double reach_;
  Period period_;
  Vec3 origin_;
  std::array<int, 3> cells_;
  Vec3 inverse_cell_size_;
  std::vector<std::uint32_t> cell_start_;  // first particle of each cell; one past the end last
  std::vector<std::uint32_t> cell_of_particle_, order_;
  std::vector<std::vector<std::uint32_t>> pools_;  // one per block of particles
  std::vector<Slice> first_;
  std::array<std::vector<double>, 3> positions_;  // by axis
  NeighbourSearch search_;
};

}  // namespace nilas::sph
