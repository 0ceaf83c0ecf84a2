// The innermost loop of the neighbour search, chosen once per list for the processor at hand.
#pragma once

#include <cstdint>

#include "sph/vector.hpp"

namespace nilas::sph {

/// Coordinates by axis [m], each followed by room for three more numbers.
struct SearchPositions {
  const double *x, *y, *z;
};

/// Writes the indices in [begin, end) of positions closer to x than the root of reach2 [m2], in order, to `out`, which
/// must have room for end - begin + 3. Returns how many there are. period: 0 along axes that do not wrap.
using NeighbourSearch = std::size_t (*)(const SearchPositions& positions, const Vec3& x, const Vec3& period,
                                        std::uint32_t begin, std::uint32_t end, double reach2, std::uint32_t* out);

/// In the fastest instruction set that this processor has.
NeighbourSearch neighbour_search(bool periodic);

}  // namespace nilas::sph
