// The innermost loop of the neighbour search, chosen once per list for the processor at hand.
#pragma once

#include <cstdint>
#include <span>

#include "sph/vector.hpp"

namespace nilas::sph {

/// Writes those of `groups` that hold a position closer to x than the root of reach2 [m2], in order, to `out`, which
/// must have room for all of them. Returns how many there are. positions [m]: per group x of all its places, then y,
/// then z, NaN in empty places. period: 0 along axes that do not wrap.
using NeighbourSearch = std::size_t (*)(const double* positions, const Vec3& x, const Vec3& period,
                                        std::span<const std::uint32_t> groups, double reach2, std::uint32_t* out);

/// In the fastest instruction set that this processor has. group_size: places per group, 4 or 8.
NeighbourSearch neighbour_search(std::size_t group_size, bool periodic);

}  // namespace nilas::sph
