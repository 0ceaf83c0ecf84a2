// Thirty-two bytes of numbers at a time, four doubles or eight floats, for the pair loops: arithmetic by the compiler's
// vector extension, so the same source gives AVX2 or SSE2 code.
//
// Included only by the pair loops, inside whose namespace everything here is internal to one instruction set.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

// The loops fall apart if one of these functions is called rather than inlined.
#define NILAS_INLINE [[gnu::always_inline]] inline

namespace nilas::sph::NILAS_ISA {
namespace {

template <class Real>
struct PackOf {
  typedef Real type __attribute__((vector_size(32)));
};
template <class Real>
using Pack = typename PackOf<Real>::type;
template <class Real>
constexpr std::size_t kLanes = 32 / sizeof(Real);

NILAS_INLINE double sum(Pack<double> a) { return (a[0] + a[1]) + (a[2] + a[3]); }
/// Added up in double.
NILAS_INLINE double sum(Pack<float> a) {
  return sum(Pack<double>{a[0], a[1], a[2], a[3]} + Pack<double>{a[4], a[5], a[6], a[7]});
}

template <class P>
NILAS_INLINE P larger(P a, P b) {
  return a > b ? a : b;
}
template <class P>
NILAS_INLINE P smaller(P a, P b) {
  return a < b ? a : b;
}
NILAS_INLINE Pack<double> root(Pack<double> a) {
  return Pack<double>{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}
NILAS_INLINE Pack<float> root(Pack<float> a) {
  return Pack<float>{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3]),
                     std::sqrt(a[4]), std::sqrt(a[5]), std::sqrt(a[6]), std::sqrt(a[7])};
}
/// Nearest integer for |a| < 2^51, or 2^22 with floats: adding 1.5 times the power of two above rounds the fraction
/// away.
NILAS_INLINE Pack<double> nearest_integer(Pack<double> a) {
  constexpr double kShift = 6755399441055744.0;
  return (a + kShift) - kShift;
}
NILAS_INLINE Pack<float> nearest_integer(Pack<float> a) {
  constexpr float kShift = 12582912.0f;
  return (a + kShift) - kShift;
}

/// Calls body(indices of the neighbours in a pack) for the neighbours pack by pack. The last pack is filled up with
/// particle i itself, whose separation is zero and which therefore adds nothing to any sum.
template <class Real, class Body>
NILAS_INLINE void for_packs(std::span<const std::uint32_t> list, std::size_t i, const Body& body) {
  constexpr std::size_t lanes = kLanes<Real>;
  std::uint32_t last[lanes];
  for (std::size_t n = 0; n < list.size(); n += lanes) {
    const std::uint32_t* index = list.data() + n;
    if (n + lanes > list.size()) {
      for (std::size_t k = 0; k < lanes; ++k) last[k] = n + k < list.size() ? index[k] : static_cast<std::uint32_t>(i);
      index = last;
    }
    body(index);
  }
}

}  // namespace
}  // namespace nilas::sph::NILAS_ISA
