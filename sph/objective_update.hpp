// Objective stress update of Hughes and Winget (1980), the finite-rotation form of the Jaumann rate
//   dS/dt = 2G dev(D) + W S - S W,   L = dv/dx, D = sym L, W = skew L      (Cai et al. 2025, Eq. 16)
// Over dt the stress is turned by the Cayley transform Q = (I - dt W/2)^-1 (I + dt W/2), which is orthogonal to
// round-off: a rigid rotation changes neither pressure nor J2 at any step size.
#pragma once

#include "sph/symmetric_tensor.hpp"

namespace nilas::sph {

/// Stress turned by the spin of `velocity_gradient` [1/s] over dt [s].
inline Sym3 rotate_by_spin(const Sym3& stress, const Mat3& velocity_gradient, double dt) {
  const Mat3& L = velocity_gradient;
  // t = dt/2 times the axial vector of W: W x = w cross x.
  const Vec3 t = 0.25 * dt * Vec3(L(2, 1) - L(1, 2), L(0, 2) - L(2, 0), L(1, 0) - L(0, 1));
  const double t2 = t.squaredNorm();
  if (t2 == 0) return stress;
  // Q = ((1 - |t|^2) I + 2 t t^T + 2 [t]x) / (1 + |t|^2), written out: Eigen's expressions cost more here.
  const double s = 1 / (1 + t2), d = s * (1 - t2), s2 = 2 * s;
  const double q00 = d + s2 * t[0] * t[0], q11 = d + s2 * t[1] * t[1], q22 = d + s2 * t[2] * t[2];
  const double q01 = s2 * (t[0] * t[1] - t[2]), q10 = s2 * (t[0] * t[1] + t[2]);
  const double q02 = s2 * (t[0] * t[2] + t[1]), q20 = s2 * (t[0] * t[2] - t[1]);
  const double q12 = s2 * (t[1] * t[2] - t[0]), q21 = s2 * (t[1] * t[2] + t[0]);
  // A = Q sigma
  const Sym3& a = stress;
  const double a00 = q00 * a.xx + q01 * a.xy + q02 * a.xz, a01 = q00 * a.xy + q01 * a.yy + q02 * a.yz,
               a02 = q00 * a.xz + q01 * a.yz + q02 * a.zz;
  const double a10 = q10 * a.xx + q11 * a.xy + q12 * a.xz, a11 = q10 * a.xy + q11 * a.yy + q12 * a.yz,
               a12 = q10 * a.xz + q11 * a.yz + q12 * a.zz;
  const double a20 = q20 * a.xx + q21 * a.xy + q22 * a.xz, a21 = q20 * a.xy + q21 * a.yy + q22 * a.yz,
               a22 = q20 * a.xz + q21 * a.yz + q22 * a.zz;
  // A Q^T
  return {a00 * q00 + a01 * q01 + a02 * q02, a10 * q10 + a11 * q11 + a12 * q12, a20 * q20 + a21 * q21 + a22 * q22,
          a00 * q10 + a01 * q11 + a02 * q12, a00 * q20 + a01 * q21 + a02 * q22, a10 * q20 + a11 * q21 + a12 * q22};
}

}  // namespace nilas::sph
