// One copy of the pair loops per instruction set (see CMakeLists.txt, which compiles pair_passes_kernel.cpp twice).
#pragma once

#include "sph/pair_passes.hpp"

namespace nilas::sph {

namespace baseline {
PairPasses select(PairTerms terms);
}
namespace v3 {
PairPasses select(PairTerms terms);
}

}  // namespace nilas::sph
