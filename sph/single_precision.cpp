#include "sph/single_precision.hpp"

#include "sph/chunked_sum.hpp"

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

float single(double x) { return static_cast<float>(x); }

void copy(const std::vector<Sym3>& tensors, std::vector<SingleRecord>& mirror) {
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < tensors.size(); ++i) {
    const Sym3& t = tensors[i];
    mirror[i] = {{single(t.xx), single(t.yy), single(t.zz), single(t.xy), single(t.xz), single(t.yz), 0, 0}};
  }
}

}  // namespace

void add_mirrors(Particles& particles) {
  particles.single_motion.resize(particles.size());
  particles.single_stress.resize(particles.size());
  particles.single_correction.resize(particles.correction.size());
}

void mirror_motion(Particles& particles, double length) {
  const std::vector<Motion>& motion = particles.motion;
  const MotionSums sums = chunked_sum<MotionSums>(motion.size(), [&](std::size_t i, MotionSums& s) {
    s.position += motion[i].position;
    s.velocity += motion[i].velocity;
  });
  const double count = static_cast<double>(motion.size());
  const Vec3 position = sums.position / count, velocity = sums.velocity / count;
  const double per_length = 1 / length, per_volume = per_length * per_length * per_length;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Vec3 x = per_length * (motion[i].position - position), v = motion[i].velocity - velocity;
    particles.single_motion[i] = {{single(x[0]), single(x[1]), single(x[2]), single(per_volume * motion[i].volume),
                                   single(v[0]), single(v[1]), single(v[2]), 0}};
  }
}

void mirror_stress(Particles& particles) {
  copy(particles.stress, particles.single_stress);
  copy(particles.correction, particles.single_correction);
}

}  // namespace nilas::sph
