// Thirty-two bytes of numbers at a time, four doubles or eight floats, for the pair loops: arithmetic by the compiler's
// vector extension, so the same source gives AVX2 or SSE2 code.
//
// Included only by the pair loops, inside whose namespace everything here is internal to one instruction set.
#pragma once

#include <cmath>
#include <cstdint>

#if defined(__AVX__)
#include <immintrin.h>
#endif

#include "sph/vector.hpp"

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

#if defined(__AVX__)
NILAS_INLINE Pack<double> larger(Pack<double> a, Pack<double> b) { return _mm256_max_pd(a, b); }
NILAS_INLINE Pack<float> larger(Pack<float> a, Pack<float> b) { return _mm256_max_ps(a, b); }
NILAS_INLINE Pack<double> smaller(Pack<double> a, Pack<double> b) { return _mm256_min_pd(a, b); }
NILAS_INLINE Pack<float> smaller(Pack<float> a, Pack<float> b) { return _mm256_min_ps(a, b); }
NILAS_INLINE Pack<double> root(Pack<double> a) { return _mm256_sqrt_pd(a); }
NILAS_INLINE Pack<float> root(Pack<float> a) { return _mm256_sqrt_ps(a); }
#else
template <class P>
NILAS_INLINE P larger(P a, P b) {
  return a > b ? a : b;
}
template <class P>
NILAS_INLINE P smaller(P a, P b) {
  return a < b ? a : b;
}
template <class P>
NILAS_INLINE P root(P a) {
  for (std::size_t lane = 0; lane < sizeof(P) / sizeof(a[0]); ++lane) a[lane] = std::sqrt(a[lane]);
  return a;
}
#endif
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

/// Wraps one component of a separation to its shortest image; nothing where the scene is not periodic.
template <bool Periodic, class Real>
NILAS_INLINE Pack<Real> wrap(Pack<Real> d, Real period, Real inverse_period) {
  if constexpr (Periodic) return d - period * nearest_integer(d * inverse_period);
  (void)period, (void)inverse_period;
  return d;
}

/// Periods in some unit of length [m], and their inverses, 0 along axes that do not wrap.
template <class Real>
struct Wrapping {
  Real x, y, z, inverse_x, inverse_y, inverse_z;
  Wrapping(const Vec3& period, double unit)
      : x(static_cast<Real>(period[0] / unit)),
        y(static_cast<Real>(period[1] / unit)),
        z(static_cast<Real>(period[2] / unit)),
        inverse_x(x > 0 ? 1 / x : 0),
        inverse_y(y > 0 ? 1 / y : 0),
        inverse_z(z > 0 ? 1 / z : 0) {}
};

}  // namespace
}  // namespace nilas::sph::NILAS_ISA
