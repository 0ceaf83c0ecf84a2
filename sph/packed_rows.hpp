// How a pack of particles picked by index is loaded: their rows of numbers, which are then transposed; that beats
// gathering each number. For loops over pairs that are stored one by one (hourglass control); the others read whole
// groups (pair_records.hpp).
//
// Included only by loops inside whose namespace everything here is internal to one instruction set.
#pragma once

#include <cstddef>
#include <cstring>

#if defined(__AVX__)
#include <immintrin.h>
#endif

#include "sph/pack.hpp"
#include "sph/particles.hpp"

namespace nilas::sph::NILAS_ISA {
namespace {

/// Sixteen bytes at p and sixteen at q. With AVX two loads and no shuffle; the compiler does not find that by itself.
#if defined(__AVX__)
NILAS_INLINE Pack<double> load(const double* p, const double* q) {
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(p)), _mm_loadu_pd(q), 1);
}
#else
NILAS_INLINE Pack<double> load(const double* p, const double* q) {
  Pack<double> a;
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
/// Where column `first` of the rows of a pack of particles is.
NILAS_INLINE auto rows_from(const double* rows, std::size_t row_length, const std::uint32_t* index, std::size_t first) {
  return [start = rows + first, row_length, index](int k) { return start + row_length * index[k]; };
}

/// Motion of a pack of particles.
struct MotionPack {
  Pack<double> x, y, z, volume, u, v, w;
};
NILAS_INLINE MotionPack load_motion(const std::vector<Motion>& motion, const std::uint32_t* index) {
  static_assert(offsetof(Motion, volume) == 24 && offsetof(Motion, velocity) == 32 && sizeof(Motion) == 64);
  const auto* rows = reinterpret_cast<const double*>(motion.data());
  MotionPack p;
  Pack<double> unused;
  load_columns(rows_from(rows, 8, index, 0), p.x, p.y);
  load_columns(rows_from(rows, 8, index, 2), p.z, p.volume);
  load_columns(rows_from(rows, 8, index, 4), p.u, p.v);
  load_columns(rows_from(rows, 8, index, 6), p.w, unused);
  return p;
}

}  // namespace
}  // namespace nilas::sph::NILAS_ISA
