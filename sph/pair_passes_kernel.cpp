// The pair loops. Compiled once per instruction set; NILAS_ISA names the namespace of this copy.
#include "sph/pair_passes_kernel.hpp"

#include "sph/chunked_sum.hpp"
#include "sph/pack.hpp"

namespace nilas::sph::NILAS_ISA {

namespace {

struct Count {
  std::size_t n = 0;
  Count& operator+=(const Count& o) {
    n += o.n;
    return *this;
  }
};

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

template <bool Corrected, bool Periodic>
std::size_t velocity_gradient(Particles& particles, const Neighbours& neighbours, const PairConstants& k) {
  const Motion* const motion = particles.motion.data();
  const double half_inverse_h = 0.5 / k.smoothing_length, scale = k.kernel_scale;
  const double Px = k.period[0], Py = k.period[1], Pz = k.period[2];
  const double iPx = inverse_or_zero(Px), iPy = inverse_or_zero(Py), iPz = inverse_or_zero(Pz);

  const Count fallbacks = chunked_sum<Count>(particles.size(), [&](std::size_t i, Count& count) {
    const double xi = motion[i].position[0], yi = motion[i].position[1], zi = motion[i].position[2];
    const double ui = motion[i].velocity[0], vi = motion[i].velocity[1], wi = motion[i].velocity[2];
    Pack ux{}, uy{}, uz{}, vx{}, vy{}, vz{}, wx{}, wy{}, wz{};
    Pack axx{}, ayy{}, azz{}, axy{}, axz{}, ayz{};
    for_packs(neighbours.of(i), i, [&](const Lanes& lanes) {
      const MotionPack j = load_motion(motion, lanes);
      const Pack dx = wrap<Periodic>(xi - j.x, Px, iPx);
      const Pack dy = wrap<Periodic>(yi - j.y, Py, iPy);
      const Pack dz = wrap<Periodic>(zi - j.z, Pz, iPz);
      const Pack t = larger(1 - half_inverse_h * root(dx * dx + dy * dy + dz * dz), Pack{});
      const Pack Vf = j.volume * scale * t * t * t;  // V_j f, grad_i W = f (r_i - r_j)
      const Pack du = j.u - ui, dv = j.v - vi, dw = j.w - wi;
      const Pack gx = Vf * dx, gy = Vf * dy, gz = Vf * dz;
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
    if constexpr (Corrected) {
      Sym3& B = particles.correction[i];
      const double solid_share = k.solid_volume / motion[i].volume;
      if (!invert({sum(axx), sum(ayy), sum(azz), sum(axy), sum(axz), sum(ayz)}, solid_share, B)) {
        B = {1, 1, 1, 0, 0, 0};
        ++count.n;
      }
      L = L * to_matrix(B);
    }
  });
  return fallbacks.n;
}

template <bool Corrected, bool Viscous, bool Periodic>
ForcePassSums acceleration(Particles& particles, const Neighbours& neighbours, const PairConstants& k, double dt) {
  const Motion* const motion = particles.motion.data();
  const Sym3* const stress = particles.stress.data();
  const Sym3* const correction = particles.correction.data();
  const double half_inverse_h = 0.5 / k.smoothing_length, scale = k.kernel_scale;
  const double Px = k.period[0], Py = k.period[1], Pz = k.period[2];
  const double iPx = inverse_or_zero(Px), iPy = inverse_or_zero(Py), iPz = inverse_or_zero(Pz);
  const double inverse_mass = 1 / particles.mass;
  // Monaghan 1992: Pi = (-alpha c mu + beta mu^2)/rho, mu = h u.x/(r^2 + eta^2) for approaching pairs. With
  // m/rho_mean = 2 V_i V_j/(V_i + V_j) the pair contributes
  //   -m Pi grad W = (alpha c mu - beta mu^2) 2 V_i V_j/(V_i + V_j) grad W.
  const double h = k.smoothing_length, eta2 = 0.01 * h * h;
  const double alpha_c = k.alpha * k.sound_speed, beta = k.beta;

  return chunked_sum<ForcePassSums>(particles.size(), [&](std::size_t i, ForcePassSums& sums) {
    const double xi = motion[i].position[0], yi = motion[i].position[1], zi = motion[i].position[2];
    const double ui = motion[i].velocity[0], vi = motion[i].velocity[1], wi = motion[i].velocity[2];
    const double Vi = motion[i].volume;
    const Sym3 si = stress[i];
    Pack ax{}, ay{}, az{}, bx{}, by{}, bz{};

    // T_i = sigma_i B_i, only with correction.
    Mat3 Ti;
    if constexpr (Corrected) Ti = to_matrix(si) * to_matrix(particles.correction[i]);

    for_packs(neighbours.of(i), i, [&](const Lanes& lanes) {
      const MotionPack j = load_motion(motion, lanes);
      const Pack dx = wrap<Periodic>(xi - j.x, Px, iPx);
      const Pack dy = wrap<Periodic>(yi - j.y, Py, iPy);
      const Pack dz = wrap<Periodic>(zi - j.z, Pz, iPz);
      const Pack r2 = dx * dx + dy * dy + dz * dz;
      const Pack t = larger(1 - half_inverse_h * root(r2), Pack{});
      const Pack f = scale * t * t * t;
      const Pack Vf = j.volume * f;
      const SymPack sj = load_symmetric(stress, lanes);
      if constexpr (Corrected) {
        const SymPack c = load_symmetric(correction, lanes);
        const Pack T00 = Ti(0, 0) + (sj.xx * c.xx + sj.xy * c.xy + sj.xz * c.xz);
        const Pack T01 = Ti(0, 1) + (sj.xx * c.xy + sj.xy * c.yy + sj.xz * c.yz);
        const Pack T02 = Ti(0, 2) + (sj.xx * c.xz + sj.xy * c.yz + sj.xz * c.zz);
        const Pack T10 = Ti(1, 0) + (sj.xy * c.xx + sj.yy * c.xy + sj.yz * c.xz);
        const Pack T11 = Ti(1, 1) + (sj.xy * c.xy + sj.yy * c.yy + sj.yz * c.yz);
        const Pack T12 = Ti(1, 2) + (sj.xy * c.xz + sj.yy * c.yz + sj.yz * c.zz);
        const Pack T20 = Ti(2, 0) + (sj.xz * c.xx + sj.yz * c.xy + sj.zz * c.xz);
        const Pack T21 = Ti(2, 1) + (sj.xz * c.xy + sj.yz * c.yy + sj.zz * c.yz);
        const Pack T22 = Ti(2, 2) + (sj.xz * c.xz + sj.yz * c.yz + sj.zz * c.zz);
        ax += Vf * (T00 * dx + T01 * dy + T02 * dz);
        ay += Vf * (T10 * dx + T11 * dy + T12 * dz);
        az += Vf * (T20 * dx + T21 * dy + T22 * dz);
      } else {
        const Pack xx = si.xx + sj.xx, yy = si.yy + sj.yy, zz = si.zz + sj.zz;
        const Pack xy = si.xy + sj.xy, xz = si.xz + sj.xz, yz = si.yz + sj.yz;
        ax += Vf * (xx * dx + xy * dy + xz * dz);
        ay += Vf * (xy * dx + yy * dy + yz * dz);
        az += Vf * (xz * dx + yz * dy + zz * dz);
      }
      if constexpr (Viscous) {
        const Pack ur = (ui - j.u) * dx + (vi - j.v) * dy + (wi - j.w) * dz;
        const Pack mu = h * smaller(ur, Pack{}) / (r2 + eta2);
        const Pack q = (alpha_c - beta * mu) * mu * (2 * Vi * j.volume / (Vi + j.volume)) * f;
        bx += q * dx, by += q * dy, bz += q * dz;
      }
    });
    const double s = Vi * inverse_mass;
    const Vec3 viscous(sum(bx), sum(by), sum(bz));
    Vec3& a = particles.acceleration[i];
    a += s * Vec3(sum(ax), sum(ay), sum(az));
    if constexpr (Viscous) {
      a += viscous;
      // Work of the viscous force over the step, at the mean of the velocities before and after the kick.
      const Vec3 mean_velocity = particles.held[i] ? Vec3::Zero().eval() : (motion[i].velocity + 0.5 * dt * a).eval();
      sums.viscous_power -= particles.mass * viscous.dot(mean_velocity);
    }
  });
}

template <bool Corrected, bool Viscous, bool Periodic>
PairPasses passes() {
  return {&velocity_gradient<Corrected, Periodic>, &acceleration<Corrected, Viscous, Periodic>};
}

}  // namespace

PairPasses select(PairTerms t) {
  if (t.corrected) {
    if (t.viscous) return t.periodic ? passes<true, true, true>() : passes<true, true, false>();
    return t.periodic ? passes<true, false, true>() : passes<true, false, false>();
  }
  if (t.viscous) return t.periodic ? passes<false, true, true>() : passes<false, true, false>();
  return t.periodic ? passes<false, false, true>() : passes<false, false, false>();
}

}  // namespace nilas::sph::NILAS_ISA
