// The pair loops. Compiled once per instruction set; NILAS_ISA names the namespace of this copy.
#include "sph/pair_passes_kernel.hpp"

#include <type_traits>

#include "sph/chunked_sum.hpp"
#include "sph/pair_records.hpp"
#include "sph/single_precision.hpp"

namespace nilas::sph::NILAS_ISA {

namespace {

struct Count {
  std::size_t n = 0;
  Count& operator+=(const Count& o) {
    n += o.n;
    return *this;
  }
};

/// What a pass over the motion reads; with_stress: and over the stress and the correction.
template <class Real>
Records<Real> records(Particles& particles, const PairConstants& k, bool with_stress) {
  if constexpr (std::is_same_v<Real, float>) {
    mirror_motion(particles, k.smoothing_length);
    if (with_stress) mirror_stress(particles);
    return single_records_of(particles, k.smoothing_length);
  } else {
    (void)k, (void)with_stress;
    return records_of(particles);
  }
}

// Where the moment matrix is trusted. Disorder up to 0.3 spacings (h = 1.3) leaves a mean eigenvalue of 0.16 and a
// determinant of 0.28 (relative to the mean) at the worst corners and two-layer sheets; one bent layer has a
// determinant of 0.007.
constexpr double kSmallestMean = 0.15;
constexpr double kSmallestDeterminant = 0.2;

/// Inverse of a symmetric moment matrix; false if it is too close to singular to be trusted: few neighbours, or nearly
/// all in a plane. solid_share: volume as solid ice over volume now. Volumes of scattered debris have grown, so that
/// the sum alone does not show how few neighbours are left.
bool invert(const Sym3& a, double solid_share, Sym3& inverse) {
  const double c00 = a.yy * a.zz - a.yz * a.yz, c01 = a.xz * a.yz - a.xy * a.zz, c02 = a.xy * a.yz - a.xz * a.yy;
  const double det = a.xx * c00 + a.xy * c01 + a.xz * c02;
  const double scale = trace(a) / 3;
  if (!(scale * solid_share > kSmallestMean)) return false;
  if (!(det > kSmallestDeterminant * scale * scale * scale)) return false;
  const double s = 1 / det;
  inverse = {s * c00, s * (a.xx * a.zz - a.xz * a.xz), s * (a.xx * a.yy - a.xy * a.xy), s * c01,
             s * c02, s * (a.xy * a.xz - a.xx * a.yz)};
  return true;
}

template <class Real, bool Corrected, bool Periodic>
std::size_t velocity_gradient(Particles& particles, const Neighbours& neighbours, const PairConstants& k) {
  using P = Pack<Real>;
  const Records<Real> record = records<Real>(particles, k, false);
  const Wrapping<Real> period(k.period, record.length);
  const Real half_inverse_h = static_cast<Real>(0.5 * record.length / k.smoothing_length);
  // The loop sums without the constant factors of grad W.
  const double moment_scale = k.kernel_scale * std::pow(record.length, 5), scale = moment_scale / record.length;

  const bool has_failed = !particles.failed.empty();
  const Count fallbacks = chunked_sum<Count>(particles.size(), [&](std::size_t i, Count& count) {
    const MotionOf<Real> self = motion_of(record, i);
    P ux{}, uy{}, uz{}, vx{}, vy{}, vz{}, wx{}, wy{}, wz{};
    P axx{}, ayy{}, azz{}, axy{}, axz{}, ayz{};
    for_packs<Real>(neighbours.of(i), i, [&](const std::uint32_t* index) {
      const MotionOf<P> j = load_motion(record, index);
      const P dx = wrap<Periodic>(self.x - j.x, period.x, period.inverse_x);
      const P dy = wrap<Periodic>(self.y - j.y, period.y, period.inverse_y);
      const P dz = wrap<Periodic>(self.z - j.z, period.z, period.inverse_z);
      const P t = larger(1 - half_inverse_h * root(dx * dx + dy * dy + dz * dz), P{});
      const P Vf = (j.volume * t) * (t * t);  // V_j f / scale, grad_i W = f (r_i - r_j)
      const P du = j.u - self.u, dv = j.v - self.v, dw = j.w - self.w;
      const P gx = Vf * dx, gy = Vf * dy, gz = Vf * dz;
      ux += du * gx, uy += du * gy, uz += du * gz;
      vx += dv * gx, vy += dv * gy, vz += dv * gz;
      wx += dw * gx, wy += dw * gy, wz += dw * gz;
      if constexpr (Corrected) {  // SUM V_j (r_j - r_i) (x) grad_i W_ij
        axx -= dx * gx, ayy -= dy * gy, azz -= dz * gz;
        axy -= dx * gy, axz -= dx * gz, ayz -= dy * gz;
      }
    });
    Mat3& L = particles.velocity_gradient[i];
    L << sum(ux), sum(uy), sum(uz), sum(vx), sum(vy), sum(vz), sum(wx), sum(wy), sum(wz);
    L *= scale;
    if constexpr (Corrected) {
      Sym3& B = particles.correction[i];
      const double solid_share = k.solid_volume / particles.motion[i].volume;
      const bool yielded = has_failed && particles.failed[i];
      const Sym3 moment = moment_scale * Sym3{sum(axx), sum(ayy), sum(azz), sum(axy), sum(axz), sum(ayz)};
      if (yielded || !invert(moment, solid_share, B)) {
        B = {1, 1, 1, 0, 0, 0};
        count.n += !yielded;
      }
      L = L * to_matrix(B);
    }
  });
  return fallbacks.n;
}

/// sigma B. The same operations for one particle and for a pack, so that T_i + T_j is the same from either side.
template <class T>
struct MatrixOf {
  T xx, xy, xz, yx, yy, yz, zx, zy, zz;
};
template <class T>
NILAS_INLINE MatrixOf<T> product(const SymOf<T>& s, const SymOf<T>& b) {
  return {s.xx * b.xx + s.xy * b.xy + s.xz * b.xz, s.xx * b.xy + s.xy * b.yy + s.xz * b.yz,
          s.xx * b.xz + s.xy * b.yz + s.xz * b.zz, s.xy * b.xx + s.yy * b.xy + s.yz * b.xz,
          s.xy * b.xy + s.yy * b.yy + s.yz * b.yz, s.xy * b.xz + s.yy * b.yz + s.yz * b.zz,
          s.xz * b.xx + s.yz * b.xy + s.zz * b.xz, s.xz * b.xy + s.yz * b.yy + s.zz * b.yz,
          s.xz * b.xz + s.yz * b.yz + s.zz * b.zz};
}

template <class Real, bool Corrected, bool Viscous, bool Periodic>
ForcePassSums acceleration(Particles& particles, const Neighbours& neighbours, const PairConstants& k, double dt) {
  using P = Pack<Real>;
  const Records<Real> record = records<Real>(particles, k, true);
  const Wrapping<Real> period(k.period, record.length);
  const double smoothing_length = k.smoothing_length / record.length;
  const Real half_inverse_h = static_cast<Real>(0.5 / smoothing_length);
  // The loop sums without the constant factors of grad W and 1/m.
  const double scale = k.kernel_scale * std::pow(record.length, 7) / particles.mass;
  // Monaghan 1992: Pi = (-alpha c mu + beta mu^2)/rho, mu = h u.x/(r^2 + eta^2) for approaching pairs. With
  // m/rho_mean = 2 V_i V_j/(V_i + V_j) the pair contributes
  //   -m Pi grad W = (alpha c mu - beta mu^2) 2 V_i V_j/(V_i + V_j) grad W.
  const Real h = static_cast<Real>(smoothing_length), eta2 = static_cast<Real>(0.01) * h * h;
  // times m, and divided by the cube of the unit of length, which is in the volumes but not in their quotient
  const double mass = particles.mass / std::pow(record.length, 3);
  const Real twice_alpha_c = static_cast<Real>(2 * mass * k.alpha * k.sound_speed);
  const Real twice_beta = static_cast<Real>(2 * mass * k.beta);

  return chunked_sum<ForcePassSums>(particles.size(), [&](std::size_t i, ForcePassSums& sums) {
    const MotionOf<Real> self = motion_of(record, i);
    const SymOf<Real> si = symmetric_of(record.stress, i);
    // The forces of a pair are equal and opposite to the last bit; only the rounding of these sums leaves a net force,
    // in single precision 2e-10 of the sum of their magnitudes. (Sums in double would leave none, but then half of
    // what single precision gains is lost again.)
    P ax{}, ay{}, az{}, bx{}, by{}, bz{};

    // T_i = sigma_i B_i, only with correction.
    MatrixOf<Real> Ti;
    if constexpr (Corrected) Ti = product(si, symmetric_of(record.correction, i));

    for_packs<Real>(neighbours.of(i), i, [&](const std::uint32_t* index) {
      const MotionOf<P> j = load_motion(record, index);
      const P dx = wrap<Periodic>(self.x - j.x, period.x, period.inverse_x);
      const P dy = wrap<Periodic>(self.y - j.y, period.y, period.inverse_y);
      const P dz = wrap<Periodic>(self.z - j.z, period.z, period.inverse_z);
      const P r2 = dx * dx + dy * dy + dz * dz;
      const P t = larger(1 - half_inverse_h * root(r2), P{});
      const P VVf = ((self.volume * j.volume) * t) * (t * t);  // V_i V_j f / scale
      const SymOf<P> sj = load_symmetric(record.stress, index);
      if constexpr (Corrected) {
        const MatrixOf<P> Tj = product(sj, load_symmetric(record.correction, index));
        ax += VVf * ((Ti.xx + Tj.xx) * dx + (Ti.xy + Tj.xy) * dy + (Ti.xz + Tj.xz) * dz);
        ay += VVf * ((Ti.yx + Tj.yx) * dx + (Ti.yy + Tj.yy) * dy + (Ti.yz + Tj.yz) * dz);
        az += VVf * ((Ti.zx + Tj.zx) * dx + (Ti.zy + Tj.zy) * dy + (Ti.zz + Tj.zz) * dz);
      } else {
        const P xx = si.xx + sj.xx, yy = si.yy + sj.yy, zz = si.zz + sj.zz;
        const P xy = si.xy + sj.xy, xz = si.xz + sj.xz, yz = si.yz + sj.yz;
        ax += VVf * (xx * dx + xy * dy + xz * dz);
        ay += VVf * (xy * dx + yy * dy + yz * dz);
        az += VVf * (xz * dx + yz * dy + zz * dz);
      }
      if constexpr (Viscous) {
        const P ur = (self.u - j.u) * dx + (self.v - j.v) * dy + (self.w - j.w) * dz;
        const P volumes = self.volume + j.volume;
        const P q = h * smaller(ur, P{}) / ((r2 + eta2) * volumes);  // mu / (V_i + V_j)
        const P Q = (twice_alpha_c - twice_beta * (q * volumes)) * q * VVf;
        bx += Q * dx, by += Q * dy, bz += Q * dz;
      }
    });
    const Vec3 viscous = scale * Vec3(sum(bx), sum(by), sum(bz));
    Vec3& a = particles.acceleration[i];
    a += scale * Vec3(sum(ax), sum(ay), sum(az));
    if constexpr (Viscous) {
      a += viscous;
      // Work of the viscous force over the step, at the mean of the velocities before and after the kick.
      const Vec3 velocity = particles.motion[i].velocity;
      const Vec3 mean_velocity = particles.held[i] ? Vec3::Zero().eval() : (velocity + 0.5 * dt * a).eval();
      sums.viscous_power -= particles.mass * viscous.dot(mean_velocity);
    }
  });
}

template <class Real, bool Corrected, bool Viscous, bool Periodic>
PairPasses passes() {
  return {&velocity_gradient<Real, Corrected, Periodic>, &acceleration<Real, Corrected, Viscous, Periodic>};
}

template <class Real>
PairPasses select_terms(PairTerms t) {
  if (t.corrected) {
    if (t.viscous) return t.periodic ? passes<Real, true, true, true>() : passes<Real, true, true, false>();
    return t.periodic ? passes<Real, true, false, true>() : passes<Real, true, false, false>();
  }
  if (t.viscous) return t.periodic ? passes<Real, false, true, true>() : passes<Real, false, true, false>();
  return t.periodic ? passes<Real, false, false, true>() : passes<Real, false, false, false>();
}

}  // namespace

PairPasses select(PairTerms t) { return t.single_precision ? select_terms<float>(t) : select_terms<double>(t); }

}  // namespace nilas::sph::NILAS_ISA
