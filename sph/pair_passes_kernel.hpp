// One copy of the pair loops per instruction set (see CMakeLists.txt, which compiles them twice).
#pragma once

#include "sph/hourglass_control.hpp"
#include "sph/neighbour_search.hpp"
#include "sph/pair_passes.hpp"

namespace nilas::sph {

/// Whether this processor runs x86-64-v3.
bool has_v3();

namespace baseline {
PairPasses select(PairTerms terms);
HourglassPass select_hourglass(bool periodic);
NeighbourSearch select_search(std::size_t group_size, bool periodic);
}  // namespace baseline
namespace v3 {
PairPasses select(PairTerms terms);
HourglassPass select_hourglass(bool periodic);
NeighbourSearch select_search(std::size_t group_size, bool periodic);
}  // namespace v3

}  // namespace nilas::sph
