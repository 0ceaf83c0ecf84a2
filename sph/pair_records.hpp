// What the pair loops read of a particle, in double or in single precision, and how a pack of neighbours is loaded:
// their records as rows, which are then transposed; that beats gathering each number.
//
// Included only by the pair loops, inside whose namespace everything here is internal to one instruction set.
#pragma once

#include <cstddef>
#include <cstring>

#if defined(__AVX__)
#include <immintrin.h>
#endif

#include "sph/neighbours.hpp"
#include "sph/pack.hpp"
#include "sph/particles.hpp"

namespace nilas::sph::NILAS_ISA {
namespace {

/// Wraps one component of a separation to its shortest image; nothing where the scene is not periodic.
template <bool Periodic, class Real>
NILAS_INLINE Pack<Real> wrap(Pack<Real> d, Real period, Real inverse_period) {
  if constexpr (Periodic) return d - period * nearest_integer(d * inverse_period);
  (void)period, (void)inverse_period;
  return d;
}

/// Periods in the unit of length of the records, and their inverses, 0 along axes that do not wrap.
template <class Real>
struct Wrapping {
  Real x, y, z, inverse_x, inverse_y, inverse_z;
  Wrapping(const Period& p, double length)
      : x(static_cast<Real>(p[0] / length)),
        y(static_cast<Real>(p[1] / length)),
        z(static_cast<Real>(p[2] / length)),
        inverse_x(x > 0 ? 1 / x : 0),
        inverse_y(y > 0 ? 1 / y : 0),
        inverse_z(z > 0 ? 1 / z : 0) {}
};

/// Rows of numbers: motion is position, volume, velocity, unused; tensors are xx, yy, zz, xy, xz, yz.
template <class Real>
struct Records {
  static constexpr std::size_t kMotionRow = 8, kTensorRow = sizeof(Real) == 8 ? 6 : 8;
  const Real* motion;
  const Real* stress;
  const Real* correction;
  double length;  // m, unit of the positions and, cubed, of the volumes
};

NILAS_INLINE Records<double> records_of(const Particles& p) {
  static_assert(offsetof(Motion, volume) == 24 && offsetof(Motion, velocity) == 32 && sizeof(Motion) == 64);
  static_assert(sizeof(Sym3) == 48);
  const auto numbers = [](const auto& v) { return reinterpret_cast<const double*>(v.data()); };
  return {numbers(p.motion), numbers(p.stress), numbers(p.correction), 1};
}

NILAS_INLINE Records<float> single_records_of(const Particles& p, double length) {
  const auto numbers = [](const auto& v) { return reinterpret_cast<const float*>(v.data()); };
  return {numbers(p.single_motion), numbers(p.single_stress), numbers(p.single_correction), length};
}

/// Sixteen bytes at p and sixteen at q. With AVX two loads and no shuffle; the compiler does not find that by itself.
#if defined(__AVX__)
NILAS_INLINE Pack<double> load(const double* p, const double* q) {
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p)), _mm_loadu_pd(q), 1);
}
NILAS_INLINE Pack<float> load(const float* p, const float* q) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(p)), _mm_loadu_ps(q), 1);
}
#else
template <class Real>
NILAS_INLINE Pack<Real> load(const Real* p, const Real* q) {
  Pack<Real> a;
  std::memcpy(&a, p, 16);
  std::memcpy(reinterpret_cast<char*>(&a) + 16, q, 16);
  return a;
}
#endif

/// Two columns of four rows. row(k): where in row k the first of them is.
template <class Row>
NILAS_INLINE void load_columns(const Row& row, Pack<double>& a, Pack<double>& b) {
  const Pack<double> rows_02 = load(row(0), row(2)), rows_13 = load(row(1), row(3));
  a = __builtin_shufflevector(rows_02, rows_13, 0, 4, 2, 6);
  b = __builtin_shufflevector(rows_02, rows_13, 1, 5, 3, 7);
}
/// Four columns of eight rows.
template <class Row>
NILAS_INLINE void load_columns(const Row& row, Pack<float>& a, Pack<float>& b, Pack<float>& c, Pack<float>& d) {
  const Pack<float> r0 = load(row(0), row(4)), r1 = load(row(1), row(5)), r2 = load(row(2), row(6)),
                    r3 = load(row(3), row(7));
  const Pack<float> ab_01 = __builtin_shufflevector(r0, r1, 0, 8, 1, 9, 4, 12, 5, 13),
                    cd_01 = __builtin_shufflevector(r0, r1, 2, 10, 3, 11, 6, 14, 7, 15),
                    ab_23 = __builtin_shufflevector(r2, r3, 0, 8, 1, 9, 4, 12, 5, 13),
                    cd_23 = __builtin_shufflevector(r2, r3, 2, 10, 3, 11, 6, 14, 7, 15);
  a = __builtin_shufflevector(ab_01, ab_23, 0, 1, 8, 9, 4, 5, 12, 13);
  b = __builtin_shufflevector(ab_01, ab_23, 2, 3, 10, 11, 6, 7, 14, 15);
  c = __builtin_shufflevector(cd_01, cd_23, 0, 1, 8, 9, 4, 5, 12, 13);
  d = __builtin_shufflevector(cd_01, cd_23, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// Numbers (Real) of one particle, or packs of those of several.
template <class T>
struct MotionOf {
  T x, y, z, volume, u, v, w;
};
template <class T>
struct SymOf {
  T xx, yy, zz, xy, xz, yz;
};

template <class Real>
NILAS_INLINE MotionOf<Real> motion_of(const Records<Real>& r, std::size_t i) {
  const Real* m = r.motion + Records<Real>::kMotionRow * i;
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6]};
}
template <class Real>
NILAS_INLINE SymOf<Real> symmetric_of(const Real* tensors, std::size_t i) {
  const Real* t = tensors + Records<Real>::kTensorRow * i;
  return {t[0], t[1], t[2], t[3], t[4], t[5]};
}

/// Where column `first` of the rows of a pack of particles is.
template <class Real>
NILAS_INLINE auto rows_from(const Real* rows, std::size_t row_length, const std::uint32_t* index, std::size_t first) {
  return [start = rows + first, row_length, index](int k) { return start + row_length * index[k]; };
}

NILAS_INLINE MotionOf<Pack<double>> load_motion(const Records<double>& r, const std::uint32_t* index) {
  MotionOf<Pack<double>> p;
  Pack<double> unused;
  load_columns(rows_from(r.motion, r.kMotionRow, index, 0), p.x, p.y);
  load_columns(rows_from(r.motion, r.kMotionRow, index, 2), p.z, p.volume);
  load_columns(rows_from(r.motion, r.kMotionRow, index, 4), p.u, p.v);
  load_columns(rows_from(r.motion, r.kMotionRow, index, 6), p.w, unused);
  return p;
}
NILAS_INLINE MotionOf<Pack<float>> load_motion(const Records<float>& r, const std::uint32_t* index) {
  MotionOf<Pack<float>> p;
  Pack<float> unused;
  load_columns(rows_from(r.motion, r.kMotionRow, index, 0), p.x, p.y, p.z, p.volume);
  load_columns(rows_from(r.motion, r.kMotionRow, index, 4), p.u, p.v, p.w, unused);
  return p;
}

NILAS_INLINE SymOf<Pack<double>> load_symmetric(const double* tensors, const std::uint32_t* index) {
  SymOf<Pack<double>> p;
  load_columns(rows_from(tensors, Records<double>::kTensorRow, index, 0), p.xx, p.yy);
  load_columns(rows_from(tensors, Records<double>::kTensorRow, index, 2), p.zz, p.xy);
  load_columns(rows_from(tensors, Records<double>::kTensorRow, index, 4), p.xz, p.yz);
  return p;
}
NILAS_INLINE SymOf<Pack<float>> load_symmetric(const float* tensors, const std::uint32_t* index) {
  SymOf<Pack<float>> p;
  Pack<float> unused, also_unused;
  load_columns(rows_from(tensors, Records<float>::kTensorRow, index, 0), p.xx, p.yy, p.zz, p.xy);
  load_columns(rows_from(tensors, Records<float>::kTensorRow, index, 4), p.xz, p.yz, unused, also_unused);
  return p;
}

}  // namespace
}  // namespace nilas::sph::NILAS_ISA
