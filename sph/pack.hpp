// Four doubles at a time, for the pair loops: arithmetic by the compiler's vector extension, so the same source gives
// AVX2 or SSE2 code. Records of four neighbours are loaded as rows and transposed; that beats gathering each number.
//
// Included only by pair_passes_kernel.cpp and hourglass_pass.cpp, where everything here is internal to one instruction
// set.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>

#include "sph/particles.hpp"

namespace nilas::sph::NILAS_ISA {
namespace {

typedef double Pack __attribute__((vector_size(32)));
typedef long long Mask __attribute__((vector_size(32)));

inline double sum(Pack a) { return (a[0] + a[1]) + (a[2] + a[3]); }
inline Pack larger(Pack a, Pack b) { return a > b ? a : b; }
inline Pack smaller(Pack a, Pack b) { return a < b ? a : b; }
inline Pack root(Pack a) { return Pack{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])}; }
/// Nearest integer for |a| < 2^51: adding 1.5 * 2^52 rounds away the fraction.
inline Pack nearest_integer(Pack a) {
  constexpr double kShift = 6755399441055744.0;
  return (a + kShift) - kShift;
}

/// Wraps one component of a separation to its shortest image; nothing where the scene is not periodic.
template <bool Periodic>
inline Pack wrap(Pack d, double period, double inverse_period) {
  if constexpr (Periodic) return d - period * nearest_integer(d * inverse_period);
  (void)period, (void)inverse_period;
  return d;
}

inline double inverse_or_zero(double x) { return x > 0 ? 1 / x : 0; }

/// Indices of four particles.
struct Lanes {
  std::uint32_t index[4];
};

/// Calls body for the neighbours four by four. The last pack is filled up with particle i itself, whose separation is
/// zero and which therefore adds nothing to any sum.
template <class Body>
inline void for_packs(std::span<const std::uint32_t> list, std::size_t i, const Body& body) {
  std::size_t n = 0;
  Lanes lanes;
  for (; n + 4 <= list.size(); n += 4) {
    std::memcpy(lanes.index, list.data() + n, sizeof lanes.index);
    body(lanes);
  }
  if (n == list.size()) return;
  for (std::size_t k = 0; k < 4; ++k)
    lanes.index[k] = n + k < list.size() ? list[n + k] : static_cast<std::uint32_t>(i);
  body(lanes);
}

inline Pack load(const double* p) {
  Pack a;
  std::memcpy(&a, p, sizeof a);
  return a;
}

/// Rows a, b, c, d become columns.
inline void transpose(Pack& a, Pack& b, Pack& c, Pack& d) {
  const Pack ab_even = __builtin_shuffle(a, b, Mask{0, 4, 2, 6}), ab_odd = __builtin_shuffle(a, b, Mask{1, 5, 3, 7});
  const Pack cd_even = __builtin_shuffle(c, d, Mask{0, 4, 2, 6}), cd_odd = __builtin_shuffle(c, d, Mask{1, 5, 3, 7});
  a = __builtin_shuffle(ab_even, cd_even, Mask{0, 1, 4, 5});
  b = __builtin_shuffle(ab_odd, cd_odd, Mask{0, 1, 4, 5});
  c = __builtin_shuffle(ab_even, cd_even, Mask{2, 3, 6, 7});
  d = __builtin_shuffle(ab_odd, cd_odd, Mask{2, 3, 6, 7});
}

struct MotionPack {
  Pack x, y, z, volume, u, v, w;
};
inline MotionPack load_motion(const Motion* motion, const Lanes& lanes) {
  static_assert(offsetof(Motion, volume) == 24 && offsetof(Motion, velocity) == 32 && sizeof(Motion) == 64);
  const auto row = [&](int k) { return reinterpret_cast<const double*>(motion + lanes.index[k]); };
  MotionPack p{load(row(0)),     load(row(1)),     load(row(2)),    load(row(3)),
               load(row(0) + 4), load(row(1) + 4), load(row(2) + 4)};
  Pack unused = load(row(3) + 4);
  transpose(p.x, p.y, p.z, p.volume);
  transpose(p.u, p.v, p.w, unused);
  return p;
}

struct SymPack {
  Pack xx, yy, zz, xy, xz, yz;
};
inline SymPack load_symmetric(const Sym3* tensors, const Lanes& lanes) {
  static_assert(sizeof(Sym3) == 48);
  const auto row = [&](int k) { return reinterpret_cast<const double*>(tensors + lanes.index[k]); };
  SymPack p;
  p.xx = load(row(0)), p.yy = load(row(1)), p.zz = load(row(2)), p.xy = load(row(3));
  transpose(p.xx, p.yy, p.zz, p.xy);
  // The last two components with the two before them: four doubles that end with the record.
  Pack a = load(row(0) + 2), b = load(row(1) + 2), c = load(row(2) + 2), d = load(row(3) + 2);
  transpose(a, b, c, d);
  p.xz = c, p.yz = d;
  return p;
}

}  // namespace
}  // namespace nilas::sph::NILAS_ISA
