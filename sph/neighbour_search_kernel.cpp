// The innermost loop of the neighbour search. Compiled once per instruction set; NILAS_ISA names the namespace.
#include <array>
#include <cstring>

#include "sph/pack.hpp"
#include "sph/pair_passes_kernel.hpp"

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace nilas::sph::NILAS_ISA {

namespace {

using P = Pack<double>;

P load(const double* p) {
  P a;
  std::memcpy(&a, p, sizeof(P));
  return a;
}

/// Writes those of j, j+1, j+2, j+3 for which near is true to `out`, all four places of which may be written to.
/// Returns how many.
#if defined(__AVX__)
std::size_t store_near(__m256d near, std::uint32_t j, std::uint32_t* out) {
  // For each set of lanes the bytes of their numbers, moved to the front.
  alignas(16) static constexpr auto front = [] {
    std::array<std::array<std::uint8_t, 16>, 16> table{};
    for (unsigned set = 0; set < 16; ++set) {
      unsigned place = 0;
      for (unsigned lane = 0; lane < 4; ++lane)
        if (set & (1u << lane))
          for (unsigned byte = 0; byte < 4; ++byte) table[set][place++] = static_cast<std::uint8_t>(4 * lane + byte);
    }
    return table;
  }();
  const auto set = static_cast<unsigned>(_mm256_movemask_pd(near));
  const __m128i numbers = _mm_add_epi32(_mm_set1_epi32(static_cast<int>(j)), _mm_set_epi32(3, 2, 1, 0));
  const __m128i order = _mm_load_si128(reinterpret_cast<const __m128i*>(front[set].data()));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(numbers, order));
  return static_cast<std::size_t>(__builtin_popcount(set));
}
std::size_t store_near(P r2, double reach2, std::uint32_t j, std::uint32_t* out) {
  return store_near(_mm256_cmp_pd(r2, _mm256_set1_pd(reach2), _CMP_LT_OQ), j, out);
}
#else
std::size_t store_near(P r2, double reach2, std::uint32_t j, std::uint32_t* out) {
  std::size_t count = 0;
  for (std::uint32_t lane = 0; lane < 4; ++lane) {
    out[count] = j + lane;
    count += r2[lane] < reach2;
  }
  return count;
}
#endif

template <bool Periodic>
std::size_t near_in_range(const SearchPositions& positions, const Vec3& x, const Vec3& period, std::uint32_t begin,
                          std::uint32_t end, double reach2, std::uint32_t* out) {
  const Vec3 inverse = (period.array() > 0).select(period.cwiseInverse(), 0);
  const auto r2_from = [&](std::uint32_t j) {
    P dx = load(positions.x + j) - x[0], dy = load(positions.y + j) - x[1], dz = load(positions.z + j) - x[2];
    if constexpr (Periodic) {
      dx -= period[0] * nearest_integer(dx * inverse[0]);
      dy -= period[1] * nearest_integer(dy * inverse[1]);
      dz -= period[2] * nearest_integer(dz * inverse[2]);
    }
    return dx * dx + dy * dy + dz * dz;
  };
  std::uint32_t* const start = out;
  for (std::uint32_t j = begin; j < end; j += 4) {
    P r2 = r2_from(j);
    for (std::uint32_t lane = end - j; lane < 4; ++lane) r2[lane] = reach2;  // beyond the range
    out += store_near(r2, reach2, j, out);
  }
  return static_cast<std::size_t>(out - start);
}

}  // namespace

NeighbourSearch select_search(bool periodic) { return periodic ? &near_in_range<true> : &near_in_range<false>; }

}  // namespace nilas::sph::NILAS_ISA
