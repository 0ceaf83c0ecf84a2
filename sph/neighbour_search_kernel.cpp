// The innermost loop of the neighbour search. Compiled once per instruction set; NILAS_ISA names the namespace.
#include <cstring>

#include "sph/pack.hpp"
#include "sph/pair_passes_kernel.hpp"

namespace nilas::sph::NILAS_ISA {

namespace {

using P = Pack<double>;

NILAS_INLINE P load(const double* p) {
  P pack;
  std::memcpy(&pack, p, sizeof pack);
  return pack;
}

/// Whether any lane of a is below b; NaN is not.
#if defined(__AVX__)
NILAS_INLINE bool any_below(P a, double b) {
  return _mm256_movemask_pd(_mm256_cmp_pd(a, _mm256_set1_pd(b), _CMP_LT_OQ)) != 0;
}
#else
NILAS_INLINE bool any_below(P a, double b) { return (a[0] < b) | (a[1] < b) | (a[2] < b) | (a[3] < b); }
#endif

template <std::size_t GroupSize, bool Periodic>
std::size_t near_groups(const double* positions, const Vec3& x, const Vec3& period,
                        std::span<const std::uint32_t> groups, double reach2, std::uint32_t* out) {
  const Wrapping<double> wrapping(period, 1);
  std::size_t count = 0;
  for (const std::uint32_t group : groups) {
    const double* const place = positions + 3 * GroupSize * group;
    const auto squared = [&](std::size_t first) {
      const P dx = wrap<Periodic>(load(place + first) - x[0], wrapping.x, wrapping.inverse_x);
      const P dy = wrap<Periodic>(load(place + first + GroupSize) - x[1], wrapping.y, wrapping.inverse_y);
      const P dz = wrap<Periodic>(load(place + first + 2 * GroupSize) - x[2], wrapping.z, wrapping.inverse_z);
      return dx * dx + dy * dy + dz * dz;
    };
    bool near = any_below(squared(0), reach2);
    if constexpr (GroupSize == 8) near |= any_below(squared(4), reach2);
    out[count] = group;
    count += near;
  }
  return count;
}

}  // namespace

NeighbourSearch select_search(std::size_t group_size, bool periodic) {
  if (group_size == 8) return periodic ? &near_groups<8, true> : &near_groups<8, false>;
  return periodic ? &near_groups<4, true> : &near_groups<4, false>;
}

}  // namespace nilas::sph::NILAS_ISA
