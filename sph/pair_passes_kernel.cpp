// The pair loops. Compiled once per instruction set; NILAS_ISA names the namespace of this copy.
#include "sph/pair_passes_kernel.hpp"

#include <cstring>
#include <type_traits>

#include "sph/chunked_sum.hpp"
#include "sph/pack.hpp"
#include "sph/pair_records.hpp"

namespace nilas::sph::NILAS_ISA {

namespace {

struct Count {
  std::size_t n = 0;
  Count& operator+=(const Count& o) {
    n += o.n;
    return *this;
  }
};

/// Length [m] in whose unit the records of a precision are written.
template <class Real>
double unit_of_length(const PairConstants& k) {
  return std::is_same_v<Real, float> ? k.smoothing_length : 1;
}

template <class Real>
const GroupOf<Real>* records_of(const Particles& particles) {
  if constexpr (std::is_same_v<Real, float>)
    return particles.single_pair_records.quantities.data();
  else
    return particles.pair_records.quantities.data();
}

template <class Real>
NILAS_INLINE Pack<Real> load(const GroupOf<Real>& numbers) {
  Pack<Real> pack;
  std::memcpy(&pack, &numbers, sizeof pack);
  return pack;
}

/// What mutual pairs add to the particles of a block: Quantities packs per group.
template <class Real, std::size_t Quantities>
struct BlockSums {
  Pack<Real> sum[Quantities * Neighbours::kLargestBlock];
  std::size_t begin;  // first group of the block

  BlockSums(std::size_t first, std::size_t end) : begin(first) {
    std::fill_n(sum, Quantities * (end - first), Pack<Real>{});
  }
  NILAS_INLINE Pack<Real>* of(std::size_t group) { return sum + Quantities * (group - begin); }
};

/// One group near a particle: separations from it [in the unit of the records], squared distances and weights
/// (1 - r/2h)^3, of which the factor f of grad_i W = f (r_i - r_j) is a multiple.
template <class Real>
struct NearGroup {
  Pack<Real> dx, dy, dz, r2, weight;
  const GroupOf<Real>* record;
  Pack<Real>* sums;  // of the block, where the group is visited for both sides
};

/// Calls body(groups near particle i, mutual), some at a time: first those that are visited for i only (mutual:
/// false_type), then those that are visited for both sides (true_type). The separations get a loop of their own, so
/// that the registers hold all that each loop needs.
template <bool Periodic, std::size_t Stride, class Real, std::size_t Quantities, class Body>
NILAS_INLINE void for_near(const Neighbours& neighbours, std::size_t i, const GroupOf<Real>* records, Real x, Real y,
                           Real z, Real half_inverse_h, const Wrapping<Real>& period,
                           BlockSums<Real, Quantities>& block, const Body& body) {
  using P = Pack<Real>;
  constexpr std::size_t kMost = 32;
  NearGroup<Real> near[kMost];
  const auto visit = [&](std::span<const std::uint32_t> groups, auto mutual) {
    while (!groups.empty()) {
      const std::size_t some = std::min(groups.size(), kMost);
      for (std::size_t n = 0; n < some; ++n) {
        const GroupOf<Real>* const j = records + Stride * groups[n];
        const P dx = wrap<Periodic>(x - load(j[0]), period.x, period.inverse_x);
        const P dy = wrap<Periodic>(y - load(j[1]), period.y, period.inverse_y);
        const P dz = wrap<Periodic>(z - load(j[2]), period.z, period.inverse_z);
        const P r2 = dx * dx + dy * dy + dz * dz;
        const P t = larger(1 - half_inverse_h * root(r2), P{});
        near[n].dx = dx, near[n].dy = dy, near[n].dz = dz, near[n].r2 = r2, near[n].weight = t * t * t;
        near[n].record = j;
        if constexpr (mutual) near[n].sums = block.of(groups[n]);
      }
      body(std::span<const NearGroup<Real>>(near, some), mutual);
      groups = groups.subspan(some);
    }
  };
  visit(neighbours.groups_one_sided(i), std::false_type{});
  visit(neighbours.groups_mutual(i), std::true_type{});
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
  const double unit = unit_of_length<Real>(k);
  record<Real>(particles, neighbours, unit, Corrected, false);
  const GroupOf<Real>* const records = records_of<Real>(particles);
  constexpr std::size_t kStride = PairRecords<Real>::stride(Corrected);
  const Wrapping<Real> period(k.period, unit);
  const Real half_inverse_h = static_cast<Real>(0.5 * unit / k.smoothing_length);
  // The loop sums without the constant factors of grad W.
  const double moment_scale = k.kernel_scale * std::pow(unit, 5), scale = moment_scale / unit;
  const bool has_failed = !particles.failed.empty();

  // L (by rows) and with correction the moment matrix, SUM V_j (r_j - r_i) (x) grad_i W_ij.
  constexpr std::size_t kSums = Corrected ? 15 : 9;
  using Sums = std::array<double, kSums>;
  /// The sums of particle i, whose own record is at `place` of `self`, over its groups.
  const auto differentiate = [&](std::size_t i, const GroupOf<Real>* self, std::size_t place,
                                 BlockSums<Real, kSums>& block) {
    const Real x = self[0].place[place], y = self[1].place[place], z = self[2].place[place];
    const Real volume = self[3].place[place];
    const Real u = self[4].place[place], v = self[5].place[place], w = self[6].place[place];
    P ux{}, uy{}, uz{}, vx{}, vy{}, vz{}, wx{}, wy{}, wz{};
    P axx{}, ayy{}, azz{}, axy{}, axz{}, ayz{};
    for_near<Periodic, kStride>(
        neighbours, i, records, x, y, z, half_inverse_h, period, block, [&](const auto& groups, auto mutual) {
          for (const NearGroup<Real>& near : groups) {
            const GroupOf<Real>* const j = near.record;
            const P dx = near.dx, dy = near.dy, dz = near.dz, f = near.weight;
            const P Vf = load(j[3]) * f;  // V_j f / scale
            const P du = load(j[4]) - u, dv = load(j[5]) - v, dw = load(j[6]) - w;
            const P gx = Vf * dx, gy = Vf * dy, gz = Vf * dz;
            ux += du * gx, uy += du * gy, uz += du * gz;
            vx += dv * gx, vy += dv * gy, vz += dv * gz;
            wx += dw * gx, wy += dw * gy, wz += dw * gz;
            if constexpr (Corrected) {
              axx -= dx * gx, ayy -= dy * gy, azz -= dz * gz;
              axy -= dx * gy, axz -= dx * gz, ayz -= dy * gz;
            }
            if constexpr (mutual) {  // both differences change sign, and V_i takes the place of V_j
              P* const s = near.sums;
              const P Wf = volume * f, hx = Wf * dx, hy = Wf * dy, hz = Wf * dz;
              s[0] += du * hx, s[1] += du * hy, s[2] += du * hz;
              s[3] += dv * hx, s[4] += dv * hy, s[5] += dv * hz;
              s[6] += dw * hx, s[7] += dw * hy, s[8] += dw * hz;
              if constexpr (Corrected) {
                s[9] -= dx * hx, s[10] -= dy * hy, s[11] -= dz * hz;
                s[12] -= dx * hy, s[13] -= dx * hz, s[14] -= dy * hz;
              }
            }
          }
        });
    if constexpr (Corrected)
      return Sums{sum(ux), sum(uy),  sum(uz),  sum(vx),  sum(vy),  sum(vz),  sum(wx), sum(wy),
                  sum(wz), sum(axx), sum(ayy), sum(azz), sum(axy), sum(axz), sum(ayz)};
    else
      return Sums{sum(ux), sum(uy), sum(uz), sum(vx), sum(vy), sum(vz), sum(wx), sum(wy), sum(wz)};
  };

  const auto finish = [&](std::size_t i, const Sums& s, Count& fallbacks) {
    Mat3& L = particles.velocity_gradient[i];
    L << s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8];
    L *= scale;
    if constexpr (Corrected) {
      Sym3& B = particles.correction[i];
      const double solid_share = k.solid_volume / particles.motion[i].volume;
      const bool yielded = has_failed && particles.failed[i];
      const Sym3 moment = moment_scale * Sym3{s[9], s[10], s[11], s[12], s[13], s[14]};
      if (yielded || !invert(moment, solid_share, B)) {
        B = {1, 1, 1, 0, 0, 0};
        fallbacks.n += !yielded;
      }
      L = L * to_matrix(B);
    }
  };

  const auto differentiate_block = [&](std::size_t b, Count& fallbacks) {
    const std::size_t begin = neighbours.block_begin(b), end = neighbours.block_begin(b + 1);
    if (!particles.awake(neighbours.group_begin(begin))) return;
    BlockSums<Real, kSums> block(begin, end);
    for (std::size_t group = begin; group < end; ++group) {
      const std::size_t first = neighbours.group_begin(group), last = neighbours.group_begin(group + 1);
      for (std::size_t i = first; i < last; ++i) {
        Sums sums = differentiate(i, records + kStride * group, i - first, block);
        // Complete: the groups before this one have been evaluated, and later ones do not add to it.
        for (std::size_t q = 0; q < kSums; ++q) sums[q] += static_cast<double>(block.of(group)[q][i - first]);
        finish(i, sums, fallbacks);
      }
    }
  };
  return chunked_sum<Count>(neighbours.block_count(), differentiate_block, 1).n;
}

template <class Real, bool Corrected, bool Viscous, bool Periodic>
ForcePassSums acceleration(Particles& particles, const Neighbours& neighbours, const PairConstants& k, double dt) {
  using P = Pack<Real>;
  using Records = PairRecords<Real>;
  const double unit = unit_of_length<Real>(k);
  record<Real>(particles, neighbours, unit, Corrected, true);
  const GroupOf<Real>* const records = records_of<Real>(particles);
  constexpr std::size_t kStride = Records::stride(Corrected), kMotion = Records::kMotion;
  constexpr std::size_t kStress = Corrected ? Records::kCorrectedStress : Records::kStress;
  const Wrapping<Real> period(k.period, unit);
  const double smoothing_length = k.smoothing_length / unit;
  const Real half_inverse_h = static_cast<Real>(0.5 / smoothing_length);
  // The loop sums without the constant factors of grad W and 1/m.
  const double scale = k.kernel_scale * std::pow(unit, 7) / particles.mass;
  // Monaghan 1992: Pi = (-alpha c mu + beta mu^2)/rho, mu = h u.x/(r^2 + eta^2) for approaching pairs. With
  // m/rho_mean = 2 V_i V_j/(V_i + V_j) the pair contributes
  //   -m Pi grad W = (alpha c mu - beta mu^2) 2 V_i V_j/(V_i + V_j) grad W.
  const Real h = static_cast<Real>(smoothing_length), eta2 = static_cast<Real>(0.01) * h * h;
  // times m, and divided by the cube of the unit of length, which is in the volumes but not in their quotient
  const double mass = particles.mass / std::pow(unit, 3);
  const Real twice_alpha_c = static_cast<Real>(2 * mass * k.alpha * k.sound_speed);
  const Real twice_beta = static_cast<Real>(2 * mass * k.beta);

  // Force of stress, and of viscosity.
  constexpr std::size_t kSums = Viscous ? 6 : 3;
  using Sums = std::array<double, kSums>;
  /// The sums of particle i, whose own record is at `place` of `self`, over its groups. The forces of a
  /// pair are equal and opposite to the last bit; only the rounding of these sums leaves a net force, in single
  /// precision 2e-10 of the sum of their magnitudes. (Sums in double would leave none, but then half of what single
  /// precision gains is lost again.)
  const auto accelerate = [&](std::size_t i, const GroupOf<Real>* self, std::size_t place,
                              BlockSums<Real, kSums>& block) {
    const Real x = self[0].place[place], y = self[1].place[place], z = self[2].place[place];
    const Real volume = self[3].place[place];
    const Real u = self[4].place[place], v = self[5].place[place], w = self[6].place[place];
    Real s[kStress];
    for (std::size_t c = 0; c < kStress; ++c) s[c] = self[kMotion + c].place[place];
    P ax{}, ay{}, az{}, bx{}, by{}, bz{};
    for_near<Periodic, kStride>(
        neighbours, i, records, x, y, z, half_inverse_h, period, block, [&](const auto& groups, auto mutual) {
          for (const NearGroup<Real>& near : groups) {
            const GroupOf<Real>*const j = near.record, *const sj = j + kMotion;
            const P dx = near.dx, dy = near.dy, dz = near.dz;
            const P VVf = (volume * load(j[3])) * near.weight;  // V_i V_j f / scale
            const auto both = [&](std::size_t c) { return s[c] + load(sj[c]); };
            P fx, fy, fz;
            if constexpr (Corrected) {
              fx = VVf * (both(0) * dx + both(1) * dy + both(2) * dz);
              fy = VVf * (both(3) * dx + both(4) * dy + both(5) * dz);
              fz = VVf * (both(6) * dx + both(7) * dy + both(8) * dz);
            } else {
              const P xx = both(0), yy = both(1), zz = both(2), xy = both(3), xz = both(4), yz = both(5);
              fx = VVf * (xx * dx + xy * dy + xz * dz);
              fy = VVf * (xy * dx + yy * dy + yz * dz);
              fz = VVf * (xz * dx + yz * dy + zz * dz);
            }
            ax += fx, ay += fy, az += fz;
            if constexpr (mutual) {
              P* const sums = near.sums;
              sums[0] -= fx, sums[1] -= fy, sums[2] -= fz;
            }
          }
          if constexpr (!Viscous) return;
          for (const NearGroup<Real>& near : groups) {
            const GroupOf<Real>* const j = near.record;
            const P dx = near.dx, dy = near.dy, dz = near.dz;
            const P ur = (u - load(j[4])) * dx + (v - load(j[5])) * dy + (w - load(j[6])) * dz;
            const P V = load(j[3]), volumes = volume + V;
            const P q = h * smaller(ur, P{}) / ((near.r2 + eta2) * volumes);  // mu / (V_i + V_j)
            const P Q = (twice_alpha_c - twice_beta * (q * volumes)) * q * ((volume * V) * near.weight);
            const P fx = Q * dx, fy = Q * dy, fz = Q * dz;
            bx += fx, by += fy, bz += fz;
            if constexpr (mutual && Viscous) {
              P* const sums = near.sums;
              sums[3] -= fx, sums[4] -= fy, sums[5] -= fz;
            }
          }
        });
    if constexpr (Viscous)
      return Sums{sum(ax), sum(ay), sum(az), sum(bx), sum(by), sum(bz)};
    else
      return Sums{sum(ax), sum(ay), sum(az)};
  };

  const auto finish = [&](std::size_t i, const Sums& s, ForcePassSums& totals) {
    Vec3& a = particles.acceleration[i];
    a += scale * Vec3(s[0], s[1], s[2]);
    if constexpr (Viscous) {
      const Vec3 viscous = scale * Vec3(s[3], s[4], s[5]);
      a += viscous;
      // Work of the viscous force over the step, at the mean of the velocities before and after the kick.
      const Vec3 velocity = particles.motion[i].velocity;
      const bool still = particles.held[i] || !particles.awake(i);
      const Vec3 mean_velocity = still ? Vec3::Zero().eval() : (velocity + 0.5 * dt * a).eval();
      totals.viscous_power -= particles.mass * viscous.dot(mean_velocity);
    }
  };

  const auto accelerate_block = [&](std::size_t b, ForcePassSums& totals) {
    const std::size_t begin = neighbours.block_begin(b), end = neighbours.block_begin(b + 1);
    if (particles.sleep_depth(neighbours.group_begin(begin)) > 1) return;
    BlockSums<Real, kSums> block(begin, end);
    for (std::size_t group = begin; group < end; ++group) {
      const std::size_t first = neighbours.group_begin(group), last = neighbours.group_begin(group + 1);
      for (std::size_t i = first; i < last; ++i) {
        Sums sums = accelerate(i, records + kStride * group, i - first, block);
        for (std::size_t q = 0; q < kSums; ++q) sums[q] += static_cast<double>(block.of(group)[q][i - first]);
        finish(i, sums, totals);
      }
    }
  };
  return chunked_sum<ForcePassSums>(neighbours.block_count(), accelerate_block, 1);
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
