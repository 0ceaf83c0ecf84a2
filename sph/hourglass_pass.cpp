// The pair loop of the hourglass control. Compiled once per instruction set; NILAS_ISA names the namespace of this
// copy.
#include "sph/pack.hpp"
#include "sph/pair_passes_kernel.hpp"

namespace nilas::sph::NILAS_ISA {

namespace {

struct MatrixPack {
  Pack xx, yx, zx, xy, yy, zy, xz, yz, zz;  // as stored, by columns
};
inline MatrixPack load_matrix(const Mat3* matrices, const Lanes& lanes) {
  static_assert(sizeof(Mat3) == 72 && !Mat3::IsRowMajor);
  const auto row = [&](int k) { return reinterpret_cast<const double*>(matrices + lanes.index[k]); };
  MatrixPack m;
  m.xx = load(row(0)), m.yx = load(row(1)), m.zx = load(row(2)), m.xy = load(row(3));
  transpose(m.xx, m.yx, m.zx, m.xy);
  m.yy = load(row(0) + 4), m.zy = load(row(1) + 4), m.xz = load(row(2) + 4), m.yz = load(row(3) + 4);
  transpose(m.yy, m.zy, m.xz, m.yz);
  m.zz = Pack{row(0)[8], row(1)[8], row(2)[8], row(3)[8]};
  return m;
}

inline void store(Pack a, double* p) { std::memcpy(p, &a, sizeof a); }

template <bool Periodic>
void hourglass(Particles& particles, const std::vector<std::uint64_t>& first, std::vector<HourglassPairs>& pairs,
               const HourglassStep& k) {
  const Motion* const motion = particles.motion.data();
  const Mat3* const gradient = particles.velocity_gradient.data();
  const double half_inverse_h = k.half_inverse_h, half_step = k.half_step, elapsed = k.elapsed;
  const double Px = k.period[0], Py = k.period[1], Pz = k.period[2];
  const double iPx = inverse_or_zero(Px), iPy = inverse_or_zero(Py), iPz = inverse_or_zero(Pz);
  const std::vector<std::uint8_t>& failed = particles.failed;

#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (!failed.empty() && failed[i]) continue;
    const Motion& m = motion[i];
    const Mat3& L = gradient[i];
    Pack ax{}, ay{}, az{};
    for (std::uint64_t n = first[i]; n < first[i + 1]; ++n) {
      HourglassPairs& pair = pairs[n];
      Lanes lanes;
      std::memcpy(lanes.index, pair.neighbour, sizeof lanes.index);
      const MotionPack j = load_motion(motion, lanes);
      const MatrixPack l = load_matrix(gradient, lanes);
      const Pack dx = wrap<Periodic>(m.position[0] - j.x, Px, iPx);
      const Pack dy = wrap<Periodic>(m.position[1] - j.y, Py, iPy);
      const Pack dz = wrap<Periodic>(m.position[2] - j.z, Pz, iPz);
      const Pack t = larger(1 - half_inverse_h * root(dx * dx + dy * dy + dz * dz), Pack{});
      const Pack du = m.velocity[0] - j.u, dv = m.velocity[1] - j.v, dw = m.velocity[2] - j.w;
      // The gradients belong to the positions at n, half a step ago. Twice the mean gradient, half the separation.
      const Pack rx = 0.5 * (dx - half_step * du), ry = 0.5 * (dy - half_step * dv), rz = 0.5 * (dz - half_step * dw);
      const Pack xy = L(0, 1) + l.xy, yx = L(1, 0) + l.yx, xz = L(0, 2) + l.xz, zx = L(2, 0) + l.zx;
      const Pack yz = L(1, 2) + l.yz, zy = L(2, 1) + l.zy;
      const Pack ex = du - ((L(0, 0) + l.xx) * rx + xy * ry + xz * rz);
      const Pack ey = dv - (yx * rx + (L(1, 1) + l.yy) * ry + yz * rz);
      const Pack ez = dw - (zx * rx + zy * ry + (L(2, 2) + l.zz) * rz);
      // Turned by the mean spin to second order in the angle q: u + q x (u + q x u / 2).
      const double quarter = 0.25 * elapsed;
      const Pack qx = quarter * (zy - yz), qy = quarter * (xz - zx), qz = quarter * (yx - xy);
      const Pack ux = load(pair.x), uy = load(pair.y), uz = load(pair.z);
      const Pack hx = ux + 0.5 * (qy * uz - qz * uy), hy = uy + 0.5 * (qz * ux - qx * uz),
                 hz = uz + 0.5 * (qx * uy - qy * ux);
      const Pack sx = t > 0 ? ux + (qy * hz - qz * hy) + elapsed * ex : Pack{};
      const Pack sy = t > 0 ? uy + (qz * hx - qx * hz) + elapsed * ey : Pack{};
      const Pack sz = t > 0 ? uz + (qx * hy - qy * hx) + elapsed * ez : Pack{};
      store(sx, pair.x), store(sy, pair.y), store(sz, pair.z);
      Pack Vf = j.volume * t * t * t;
      if (!failed.empty())  // what is stored for a failed neighbour goes with the next list
        for (int lane = 0; lane < 4; ++lane)
          if (failed[lanes.index[lane]]) Vf[lane] = 0;
      ax += Vf * sx, ay += Vf * sy, az += Vf * sz;
    }
    particles.stabilisation[i] += k.strength * m.volume / particles.mass * Vec3(sum(ax), sum(ay), sum(az));
  }
}

}  // namespace

HourglassPass select_hourglass(bool periodic) { return periodic ? &hourglass<true> : &hourglass<false>; }

}  // namespace nilas::sph::NILAS_ISA
