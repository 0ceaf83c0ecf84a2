#include "sph/pair_passes.hpp"

#include "sph/pair_passes_kernel.hpp"

namespace nilas::sph {

bool has_v3() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("lzcnt");
#else
  return false;
#endif
}

PairPasses pair_passes(PairTerms terms) { return has_v3() ? v3::select(terms) : baseline::select(terms); }

NeighbourSearch neighbour_search(std::size_t group_size, bool periodic) {
  return has_v3() ? v3::select_search(group_size, periodic) : baseline::select_search(group_size, periodic);
}

const char* pair_pass_instruction_set() { return has_v3() ? "x86-64-v3" : "baseline"; }

}  // namespace nilas::sph
