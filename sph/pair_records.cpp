#include "sph/pair_records.hpp"

#include <tuple>
#include <type_traits>

#include "sph/chunked_sum.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"

namespace nilas::sph {

namespace {

struct MotionSums {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();
  MotionSums& operator+=(const MotionSums& o) {
    position += o.position;
    velocity += o.velocity;
    return *this;
  }
};

/// What is subtracted from positions and velocities, and the factor of positions.
struct Frame {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();
  double per_length = 1;
};

Frame mean_frame(const Particles& particles, double length) {
  const MotionSums sums = chunked_sum<MotionSums>(particles.size(), [&](std::size_t i, MotionSums& s) {
    s.position += particles.motion[i].position;
    s.velocity += particles.motion[i].velocity;
  });
  const double count = static_cast<double>(particles.size());
  return {sums.position / count, sums.velocity / count, 1 / length};
}

/// Stress of particle i, or T = sigma B, into `place` of the quantities.
template <class Real>
void record_stress(const Particles& particles, std::size_t i, bool corrected, GroupOf<Real>* quantity,
                   std::size_t place) {
  const Sym3& s = particles.stress[i];
  const auto put = [&](std::size_t q, double value) { quantity[q].place[place] = static_cast<Real>(value); };
  if (!corrected) {
    put(0, s.xx), put(1, s.yy), put(2, s.zz), put(3, s.xy), put(4, s.xz), put(5, s.yz);
    return;
  }
  const Sym3& b = particles.correction[i];
  put(0, s.xx * b.xx + s.xy * b.xy + s.xz * b.xz);
  put(1, s.xx * b.xy + s.xy * b.yy + s.xz * b.yz);
  put(2, s.xx * b.xz + s.xy * b.yz + s.xz * b.zz);
  put(3, s.xy * b.xx + s.yy * b.xy + s.yz * b.xz);
  put(4, s.xy * b.xy + s.yy * b.yy + s.yz * b.yz);
  put(5, s.xy * b.xz + s.yy * b.yz + s.yz * b.zz);
  put(6, s.xz * b.xx + s.yz * b.xy + s.zz * b.xz);
  put(7, s.xz * b.xy + s.yz * b.yy + s.zz * b.yz);
  put(8, s.xz * b.xz + s.yz * b.yz + s.zz * b.zz);
}

}  // namespace

template <class Real>
void record(Particles& particles, const Neighbours& neighbours, double length, bool corrected, bool with_stress) {
  using Records = PairRecords<Real>;
  constexpr bool single = std::is_same_v<Real, float>;
  const Frame frame = single ? mean_frame(particles, length) : Frame{};
  const double per_volume = frame.per_length * frame.per_length * frame.per_length;
  const std::size_t groups = neighbours.group_count(), stride = Records::stride(corrected);
  auto& quantities = std::get<Records&>(std::tie(particles.pair_records, particles.single_pair_records)).quantities;
  quantities.resize(stride * groups);
#pragma omp parallel for schedule(static)
  for (std::size_t g = 0; g < groups; ++g) {
    GroupOf<Real>* const quantity = quantities.data() + stride * g;
    const std::uint32_t begin = neighbours.group_begin(g), end = neighbours.group_begin(g + 1);
    if (particles.sleep_depth(begin) == Particles::kFastAsleep) continue;
    for (std::uint32_t place = 0; place < GroupOf<Real>::kPlaces; ++place) {
      const bool empty = begin + place >= end;
      const std::uint32_t i = empty ? begin : begin + place;
      const Motion& m = particles.motion[i];
      const Vec3 x = frame.per_length * (m.position - frame.position), v = m.velocity - frame.velocity;
      for (int k = 0; k < 3; ++k) quantity[k].place[place] = static_cast<Real>(x[k]);
      quantity[3].place[place] = empty ? 0 : static_cast<Real>(per_volume * m.volume);
      for (int k = 0; k < 3; ++k) quantity[4 + k].place[place] = static_cast<Real>(v[k]);
      if (with_stress) record_stress(particles, i, corrected, quantity + Records::kMotion, place);
    }
  }
}

template void record<double>(Particles&, const Neighbours&, double, bool, bool);
template void record<float>(Particles&, const Neighbours&, double, bool, bool);

}  // namespace nilas::sph
