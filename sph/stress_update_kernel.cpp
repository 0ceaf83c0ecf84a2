// The stress update of four elastic particles. Compiled once per instruction set; NILAS_ISA names the namespace.
#include "sph/stress_update_kernel.hpp"

#include <cstring>

#include "sph/packed_rows.hpp"

namespace nilas::sph::NILAS_ISA {

namespace {

using P = Pack<double>;

struct SymPack {
  P xx, yy, zz, xy, xz, yz;
};

NILAS_INLINE P contract(const SymPack& a, const SymPack& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.xz * b.xz + a.yz * b.yz);
}

/// Columns `first` and `first` + 1 of four rows that follow each other.
NILAS_INLINE void load_pair(const double* rows, std::size_t length, std::size_t first, P& a, P& b) {
  load_columns([=](int k) { return rows + length * static_cast<std::size_t>(k) + first; }, a, b);
}
NILAS_INLINE void store_pair(double* rows, std::size_t length, std::size_t first, P a, P b) {
  const P rows_02 = __builtin_shufflevector(a, b, 0, 4, 2, 6), rows_13 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const auto put = [&](std::size_t row, const P& from, std::size_t half) {
    std::memcpy(rows + length * row + first, reinterpret_cast<const char*>(&from) + 16 * half, 16);
  };
  put(0, rows_02, 0), put(1, rows_13, 0), put(2, rows_02, 1), put(3, rows_13, 1);
}

NILAS_INLINE SymPack load_stress(const Sym3* stress) {
  const auto* rows = reinterpret_cast<const double*>(stress);
  SymPack s;
  load_pair(rows, 6, 0, s.xx, s.yy), load_pair(rows, 6, 2, s.zz, s.xy), load_pair(rows, 6, 4, s.xz, s.yz);
  return s;
}

/// The stress turned by the spin over dt (objective_update.hpp); t: dt/2 times the axial vector of the spin.
NILAS_INLINE SymPack turn(const SymPack& a, P t0, P t1, P t2) {
  const P square = t0 * t0 + t1 * t1 + t2 * t2;
  const P s = 1.0 / (1.0 + square), d = s * (1.0 - square), s2 = 2.0 * s;
  const P q00 = d + s2 * t0 * t0, q11 = d + s2 * t1 * t1, q22 = d + s2 * t2 * t2;
  const P q01 = s2 * (t0 * t1 - t2), q10 = s2 * (t0 * t1 + t2);
  const P q02 = s2 * (t0 * t2 + t1), q20 = s2 * (t0 * t2 - t1);
  const P q12 = s2 * (t1 * t2 - t0), q21 = s2 * (t1 * t2 + t0);
  const P a00 = q00 * a.xx + q01 * a.xy + q02 * a.xz, a01 = q00 * a.xy + q01 * a.yy + q02 * a.yz,
          a02 = q00 * a.xz + q01 * a.yz + q02 * a.zz;
  const P a10 = q10 * a.xx + q11 * a.xy + q12 * a.xz, a11 = q10 * a.xy + q11 * a.yy + q12 * a.yz,
          a12 = q10 * a.xz + q11 * a.yz + q12 * a.zz;
  const P a20 = q20 * a.xx + q21 * a.xy + q22 * a.xz, a21 = q20 * a.xy + q21 * a.yy + q22 * a.yz,
          a22 = q20 * a.xz + q21 * a.yz + q22 * a.zz;
  return {a00 * q00 + a01 * q01 + a02 * q02, a10 * q10 + a11 * q11 + a12 * q12, a20 * q20 + a21 * q21 + a22 * q22,
          a00 * q10 + a01 * q11 + a02 * q12, a00 * q20 + a01 * q21 + a02 * q22, a10 * q20 + a11 * q21 + a12 * q22};
}

constexpr double kLargestStrain = 0.01;  // volumetric: there the series below is exact to round-off

/// exp(x) for |x| <= kLargestStrain.
NILAS_INLINE P exponential(P x) {
  return 1.0 + x * (1.0 + x * (1.0 / 2 + x * (1.0 / 6 + x * (1.0 / 24 + x * (1.0 / 120 + x * (1.0 / 720))))));
}

NILAS_INLINE bool all(Pack<std::int64_t> lanes) { return (lanes[0] & lanes[1] & lanes[2] & lanes[3]) != 0; }

template <bool PressureFromDensity>
bool update(Particles& particles, std::size_t i, const ElasticPackConstants& c, double dt, double& work) {
  if (!particles.failed.empty()) {
    std::uint32_t failed;
    std::memcpy(&failed, particles.failed.data() + i, sizeof failed);
    if (failed != 0) return false;
  }
  // Eigen keeps L by columns.
  static_assert(sizeof(Mat3) == 72 && !Mat3::IsRowMajor);
  const auto* gradient = reinterpret_cast<const double*>(particles.velocity_gradient.data() + i);
  P Lxx, Lyx, Lzx, Lxy, Lyy, Lzy, Lxz, Lyz;
  load_pair(gradient, 9, 0, Lxx, Lyx), load_pair(gradient, 9, 2, Lzx, Lxy);
  load_pair(gradient, 9, 4, Lyy, Lzy), load_pair(gradient, 9, 6, Lxz, Lyz);
  const P Lzz{gradient[8], gradient[17], gradient[26], gradient[35]};

  const double half = 0.5 * dt;
  const SymPack strain{dt * Lxx, dt * Lyy, dt * Lzz, half * (Lxy + Lyx), half * (Lxz + Lzx), half * (Lyz + Lzy)};
  const P volumetric = strain.xx + strain.yy + strain.zz;
  Motion* const motion = particles.motion.data() + i;
  const P old_volume{motion[0].volume, motion[1].volume, motion[2].volume, motion[3].volume};
  const P volume = old_volume * exponential(volumetric);

  const double quarter = 0.25 * dt;
  const SymPack turned = turn(load_stress(particles.stress.data() + i), quarter * (Lzy - Lyz), quarter * (Lxz - Lzx),
                              quarter * (Lyx - Lxy));
  const double K = c.bulk_modulus, twice_G = 2 * c.shear_modulus;
  const P mean = (turned.xx + turned.yy + turned.zz) / 3.0, third = volumetric / 3.0;
  const SymPack S{turned.xx - mean + twice_G * (strain.xx - third),
                  turned.yy - mean + twice_G * (strain.yy - third),
                  turned.zz - mean + twice_G * (strain.zz - third),
                  turned.xy + twice_G * strain.xy,
                  turned.xz + twice_G * strain.xz,
                  turned.yz + twice_G * strain.yz};
  P pressure;
  if constexpr (PressureFromDensity) {
    pressure = K * (c.reference_volume / volume - 1.0);
    if (!particles.bulking.empty()) {
      const double* b = particles.bulking.data() + i;
      pressure += K * P{b[0], b[1], b[2], b[3]};
    }
  } else {
    pressure = -mean - K * volumetric;
  }
  // J2 <= (k + 3 alpha p)^2 and k + 3 alpha p >= 0, without the root.
  const P radius = c.k + 3 * c.alpha * pressure, J2 = 0.5 * contract(S, S);
  if (!all((J2 <= radius * radius) & (radius >= P{}) & (volumetric <= P{} + kLargestStrain) &
           (volumetric >= P{} - kLargestStrain) & (volume > P{} + c.smallest_volume)))
    return false;

  const SymPack stress{S.xx - pressure, S.yy - pressure, S.zz - pressure, S.xy, S.xz, S.yz};
  work += sum(0.5 * (old_volume * contract(turned, strain) + volume * contract(stress, strain)));
  auto* rows = reinterpret_cast<double*>(particles.stress.data() + i);
  store_pair(rows, 6, 0, stress.xx, stress.yy);
  store_pair(rows, 6, 2, stress.zz, stress.xy);
  store_pair(rows, 6, 4, stress.xz, stress.yz);
  for (int lane = 0; lane < 4; ++lane) motion[lane].volume = volume[lane];
  return true;
}

}  // namespace

ElasticPackUpdate select_elastic_update(bool pressure_from_density) {
  return pressure_from_density ? &update<true> : &update<false>;
}

}  // namespace nilas::sph::NILAS_ISA
