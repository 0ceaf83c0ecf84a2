// Symmetric second-order tensors stored as six components; the shear components are the tensor's own (not doubled).
#pragma once

#include "sph/vector.hpp"

namespace nilas::sph {

struct Sym3 {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};

inline Sym3 operator+(const Sym3& a, const Sym3& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}
inline Sym3 operator*(double s, const Sym3& a) { return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.xz, s * a.yz}; }

inline double trace(const Sym3& a) { return a.xx + a.yy + a.zz; }
/// Double contraction a : b.
inline double contract(const Sym3& a, const Sym3& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2 * (a.xy * b.xy + a.xz * b.xz + a.yz * b.yz);
}
/// a + s I.
inline Sym3 add_isotropic(const Sym3& a, double s) { return {a.xx + s, a.yy + s, a.zz + s, a.xy, a.xz, a.yz}; }
inline Sym3 deviator(const Sym3& a) { return add_isotropic(a, -trace(a) / 3); }
/// Second invariant of a deviator, J2 = S:S / 2.
inline double second_invariant(const Sym3& deviator) { return 0.5 * contract(deviator, deviator); }
/// von Mises stress sqrt(3 J2) of a full stress tensor.
inline double von_mises(const Sym3& stress) { return std::sqrt(3 * second_invariant(deviator(stress))); }

inline Mat3 to_matrix(const Sym3& a) {
  Mat3 m;
  m << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz;
  return m;
}
/// Symmetric part of a matrix.
inline Sym3 symmetric_part(const Mat3& m) {
  return {m(0, 0), m(1, 1), m(2, 2), 0.5 * (m(0, 1) + m(1, 0)), 0.5 * (m(0, 2) + m(2, 0)), 0.5 * (m(1, 2) + m(2, 1))};
}

}  // namespace nilas::sph
