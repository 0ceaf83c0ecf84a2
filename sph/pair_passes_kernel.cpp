// The pair loops. Compiled once per instruction set; NILAS_ISA names the namespace of this copy.
#include "sph/pair_passes_kernel.hpp"

#include <algorithm>
#include <cmath>

#include "sph/chunked_sum.hpp"

namespace nilas::sph::NILAS_ISA {

namespace {

struct Count {
  std::size_t n = 0;
  Count& operator+=(const Count& o) {
    n += o.n;
    return *this;
  }
};

/// Wraps one component of a separation to its shortest image; nothing where the scene is not periodic.
template <bool Periodic>
inline double wrap(double d, double period, double inverse_period) {
  if constexpr (Periodic) return d - period * std::nearbyint(d * inverse_period);
  (void)period, (void)inverse_period;
  return d;
}

inline double inverse_or_zero(double x) { return x > 0 ? 1 / x : 0; }

/// Inverse of a symmetric moment matrix; false if it is too close to singular to be trusted (fewer than four
/// neighbours, or all in a plane).
bool invert(const Sym3& a, Sym3& inverse) {
  const double c00 = a.yy * a.zz - a.yz * a.yz, c01 = a.xz * a.yz - a.xy * a.zz, c02 = a.xy * a.yz - a.xz * a.yy;
  const double det = a.xx * c00 + a.xy * c01 + a.xz * c02;
  const double scale = trace(a) / 3;
  constexpr double kSmallestDeterminant = 1e-3;  // relative; 1 for an isotropic neighbourhood, 0.5 at a plane surface
  if (!(scale > 0.05) || !(det > kSmallestDeterminant * scale * scale * scale)) return false;
  const double s = 1 / det;
  inverse = {s * c00, s * (a.xx * a.zz - a.xz * a.xz), s * (a.xx * a.yy - a.xy * a.xy),
             s * c01, s * c02,                         s * (a.xy * a.xz - a.xx * a.yz)};
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
    const auto list = neighbours.of(i);
    const std::uint32_t* const index = list.data();
    const int n = static_cast<int>(list.size());
    double ux = 0, uy = 0, uz = 0, vx = 0, vy = 0, vz = 0, wx = 0, wy = 0, wz = 0;
    double axx = 0, ayy = 0, azz = 0, axy = 0, axz = 0, ayz = 0;
#pragma omp simd reduction(+ : ux, uy, uz, vx, vy, vz, wx, wy, wz, axx, ayy, azz, axy, axz, ayz)
    for (int m = 0; m < n; ++m) {
      const Motion& j = motion[index[m]];
      const double dx = wrap<Periodic>(xi - j.position[0], Px, iPx);
      const double dy = wrap<Periodic>(yi - j.position[1], Py, iPy);
      const double dz = wrap<Periodic>(zi - j.position[2], Pz, iPz);
      const double t = std::max(0.0, 1 - half_inverse_h * std::sqrt(dx * dx + dy * dy + dz * dz));
      const double Vf = j.volume * scale * t * t * t;  // V_j f, grad_i W = f (r_i - r_j)
      const double du = j.velocity[0] - ui, dv = j.velocity[1] - vi, dw = j.velocity[2] - wi;
      const double gx = Vf * dx, gy = Vf * dy, gz = Vf * dz;
      ux += du * gx, uy += du * gy, uz += du * gz;
      vx += dv * gx, vy += dv * gy, vz += dv * gz;
      wx += dw * gx, wy += dw * gy, wz += dw * gz;
      if constexpr (Corrected) {  // SUM V_j (r_j - r_i) (x) grad_i W_ij
        axx -= dx * gx, ayy -= dy * gy, azz -= dz * gz;
        axy -= dx * gy, axz -= dx * gz, ayz -= dy * gz;
      }
    }
    Mat3& L = particles.velocity_gradient[i];
    L << ux, uy, uz, vx, vy, vz, wx, wy, wz;
    if constexpr (Corrected) {
      Sym3& B = particles.correction[i];
      if (!invert({axx, ayy, azz, axy, axz, ayz}, B)) {
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
  const double half_inverse_h = 0.5 / k.smoothing_length, scale = k.kernel_scale;
  const double Px = k.period[0], Py = k.period[1], Pz = k.period[2];
  const double iPx = inverse_or_zero(Px), iPy = inverse_or_zero(Py), iPz = inverse_or_zero(Pz);
  const double inverse_mass = 1 / particles.mass;
  // Monaghan 1992: Pi = (-alpha c mu + beta mu^2)/rho, mu = h u.x/(r^2 + eta^2) for approaching pairs. With
  // m/rho_mean = 2 V_i V_j/(V_i + V_j) the pair contributes -m Pi grad W = (alpha c mu - beta mu^2) 2ViVj/(Vi+Vj) grad W.
  const double h = k.smoothing_length, eta2 = 0.01 * h * h;
  const double alpha_c = k.alpha * k.sound_speed, beta = k.beta;

  return chunked_sum<ForcePassSums>(particles.size(), [&](std::size_t i, ForcePassSums& sums) {
    const double xi = motion[i].position[0], yi = motion[i].position[1], zi = motion[i].position[2];
    const double ui = motion[i].velocity[0], vi = motion[i].velocity[1], wi = motion[i].velocity[2];
    const double Vi = motion[i].volume;
    const Sym3 si = stress[i];
    const auto list = neighbours.of(i);
    const std::uint32_t* const index = list.data();
    const int n = static_cast<int>(list.size());
    double ax = 0, ay = 0, az = 0, bx = 0, by = 0, bz = 0;

    // T_i = sigma_i B_i, only with correction.
    Mat3 Ti;
    if constexpr (Corrected) Ti = to_matrix(si) * to_matrix(particles.correction[i]);

#pragma omp simd reduction(+ : ax, ay, az, bx, by, bz)
    for (int m = 0; m < n; ++m) {
      const std::uint32_t jj = index[m];
      const Motion& j = motion[jj];
      const double dx = wrap<Periodic>(xi - j.position[0], Px, iPx);
      const double dy = wrap<Periodic>(yi - j.position[1], Py, iPy);
      const double dz = wrap<Periodic>(zi - j.position[2], Pz, iPz);
      const double r2 = dx * dx + dy * dy + dz * dz;
      const double t = std::max(0.0, 1 - half_inverse_h * std::sqrt(r2));
      const double f = scale * t * t * t;
      const double Vf = j.volume * f;
      const Sym3& sj = stress[jj];
      if constexpr (Corrected) {
        const Sym3& c = particles.correction[jj];
        const double T00 = Ti(0, 0) + (sj.xx * c.xx + sj.xy * c.xy + sj.xz * c.xz);
        const double T01 = Ti(0, 1) + (sj.xx * c.xy + sj.xy * c.yy + sj.xz * c.yz);
        const double T02 = Ti(0, 2) + (sj.xx * c.xz + sj.xy * c.yz + sj.xz * c.zz);
        const double T10 = Ti(1, 0) + (sj.xy * c.xx + sj.yy * c.xy + sj.yz * c.xz);
        const double T11 = Ti(1, 1) + (sj.xy * c.xy + sj.yy * c.yy + sj.yz * c.yz);
        const double T12 = Ti(1, 2) + (sj.xy * c.xz + sj.yy * c.yz + sj.yz * c.zz);
        const double T20 = Ti(2, 0) + (sj.xz * c.xx + sj.yz * c.xy + sj.zz * c.xz);
        const double T21 = Ti(2, 1) + (sj.xz * c.xy + sj.yz * c.yy + sj.zz * c.yz);
        const double T22 = Ti(2, 2) + (sj.xz * c.xz + sj.yz * c.yz + sj.zz * c.zz);
        ax += Vf * (T00 * dx + T01 * dy + T02 * dz);
        ay += Vf * (T10 * dx + T11 * dy + T12 * dz);
        az += Vf * (T20 * dx + T21 * dy + T22 * dz);
      } else {
        const double xx = si.xx + sj.xx, yy = si.yy + sj.yy, zz = si.zz + sj.zz;
        const double xy = si.xy + sj.xy, xz = si.xz + sj.xz, yz = si.yz + sj.yz;
        ax += Vf * (xx * dx + xy * dy + xz * dz);
        ay += Vf * (xy * dx + yy * dy + yz * dz);
        az += Vf * (xz * dx + yz * dy + zz * dz);
      }
      if constexpr (Viscous) {
        const double ur = (ui - j.velocity[0]) * dx + (vi - j.velocity[1]) * dy + (wi - j.velocity[2]) * dz;
        const double mu = h * std::min(0.0, ur) / (r2 + eta2);
        const double q = (alpha_c - beta * mu) * mu * (2 * Vi * j.volume / (Vi + j.volume)) * f;
        bx += q * dx, by += q * dy, bz += q * dz;
      }
    }
    const double s = Vi * inverse_mass;
    const Vec3 viscous(bx, by, bz);
    Vec3& a = particles.acceleration[i];
    a += Vec3(s * ax, s * ay, s * az);
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
