// The pair loop of the hourglass control. Compiled once per instruction set; NILAS_ISA names the namespace of this
// copy.
#include "sph/packed_rows.hpp"
#include "sph/pair_passes_kernel.hpp"

namespace nilas::sph::NILAS_ISA {

namespace {

using P = Pack<double>;

struct MatrixPack {
  P xx, yx, zx, xy, yy, zy, xz, yz, zz;  // as stored, by columns
};
NILAS_INLINE MatrixPack load_matrix(const Mat3* matrices, const std::uint32_t* index) {
  static_assert(sizeof(Mat3) == 72 && !Mat3::IsRowMajor);
  const auto* numbers = reinterpret_cast<const double*>(matrices);
  MatrixPack m;
  load_columns(rows_from(numbers, 9, index, 0), m.xx, m.yx);
  load_columns(rows_from(numbers, 9, index, 2), m.zx, m.xy);
  load_columns(rows_from(numbers, 9, index, 4), m.yy, m.zy);
  load_columns(rows_from(numbers, 9, index, 6), m.xz, m.yz);
  const auto row = rows_from(numbers, 9, index, 8);
  m.zz = P{*row(0), *row(1), *row(2), *row(3)};
  return m;
}

NILAS_INLINE P load(const double* p) { return load(p, p + 2); }
NILAS_INLINE void store(P a, double* p) { std::memcpy(p, &a, sizeof a); }

template <bool Periodic>
void hourglass(Particles& particles, const std::vector<std::uint64_t>& first, std::vector<HourglassPairs>& pairs,
               const HourglassStep& k) {
  const Mat3* const gradient = particles.velocity_gradient.data();
  const double half_inverse_h = k.half_inverse_h, half_step = k.half_step, elapsed = k.elapsed, T = k.damping_time;
  const Wrapping<double> period(k.period, 1);
  const std::vector<std::uint8_t>& failed = particles.failed;

#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!failed.empty() && failed[i]) continue;
    const Motion& m = particles.motion[i];
    const Mat3& L = gradient[i];
    P ax{}, ay{}, az{};
    for (std::uint64_t n = first[i]; n < first[i + 1]; ++n) {
      HourglassPairs& pair = pairs[n];
      const auto j = load_motion(particles.motion, pair.neighbour);
      const MatrixPack l = load_matrix(gradient, pair.neighbour);
      const P dx = wrap<Periodic>(m.position[0] - j.x, period.x, period.inverse_x);
      const P dy = wrap<Periodic>(m.position[1] - j.y, period.y, period.inverse_y);
      const P dz = wrap<Periodic>(m.position[2] - j.z, period.z, period.inverse_z);
      const P t = larger(1 - half_inverse_h * root(dx * dx + dy * dy + dz * dz), P{});
      const P du = m.velocity[0] - j.u, dv = m.velocity[1] - j.v, dw = m.velocity[2] - j.w;
      // The gradients belong to the positions at n, half a step ago. Twice the mean gradient, half the separation.
      const P rx = 0.5 * (dx - half_step * du), ry = 0.5 * (dy - half_step * dv), rz = 0.5 * (dz - half_step * dw);
      const P xy = L(0, 1) + l.xy, yx = L(1, 0) + l.yx, xz = L(0, 2) + l.xz, zx = L(2, 0) + l.zx;
      const P yz = L(1, 2) + l.yz, zy = L(2, 1) + l.zy;
      const P ex = du - ((L(0, 0) + l.xx) * rx + xy * ry + xz * rz);
      const P ey = dv - (yx * rx + (L(1, 1) + l.yy) * ry + yz * rz);
      const P ez = dw - (zx * rx + zy * ry + (L(2, 2) + l.zz) * rz);
      // Turned by the mean spin to second order in the angle q: u + q x (u + q x u / 2).
      const double quarter = 0.25 * elapsed;
      const P qx = quarter * (zy - yz), qy = quarter * (xz - zx), qz = quarter * (yx - xy);
      const P ux = load(pair.x), uy = load(pair.y), uz = load(pair.z);
      const P hx = ux + 0.5 * (qy * uz - qz * uy), hy = uy + 0.5 * (qz * ux - qx * uz),
              hz = uz + 0.5 * (qx * uy - qy * ux);
      const P sx = t > 0 ? ux + (qy * hz - qz * hy) + elapsed * ex : P{};
      const P sy = t > 0 ? uy + (qz * hx - qx * hz) + elapsed * ey : P{};
      const P sz = t > 0 ? uz + (qx * hy - qy * hx) + elapsed * ez : P{};
      store(sx, pair.x), store(sy, pair.y), store(sz, pair.z);
      P Vf = j.volume * t * t * t;
      if (!failed.empty())  // what is stored for a failed neighbour goes with the next list
        for (int lane = 0; lane < 4; ++lane)
          if (failed[pair.neighbour[lane]]) Vf[lane] = 0;
      ax += Vf * (sx + T * ex), ay += Vf * (sy + T * ey), az += Vf * (sz + T * ez);
    }
    particles.stabilisation[i] += k.strength * m.volume / particles.mass * Vec3(sum(ax), sum(ay), sum(az));
  }
}

}  // namespace

HourglassPass select_hourglass(bool periodic) { return periodic ? &hourglass<true> : &hourglass<false>; }

}  // namespace nilas::sph::NILAS_ISA
