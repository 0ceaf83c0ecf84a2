#include "sph/absorbing_rim.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sph/chunked_sum.hpp"

namespace nilas::sph {

RimAccount& RimAccount::operator+=(const RimAccount& o) {
  energy += o.energy;
  impulse += o.impulse;
  angular_impulse += o.angular_impulse;
  return *this;
}

bool has_absorbing_rim(const IceSpec& spec) {
  return std::any_of(spec.pieces.begin(), spec.pieces.end(), [](const PieceSpec& p) { return p.absorbing_rim; });
}

AbsorbingRim::AbsorbingRim(const IceSpec& spec, const ElasticConstants& elastic, const Particles& particles,
                           double depth)
    : centre_(spec.pieces.front().centre),
      normal_rate_(elastic.plate_wave_speed() / depth),
      tangential_rate_(std::sqrt(elastic.shear_modulus / elastic.density) / depth),
      in_layer_(particles.size()) {
  const PieceSpec& disc = spec.pieces.front();
  if (spec.pieces.size() > 1 || disc.shape != IceShape::disc)
    throw std::invalid_argument("only a single disc of ice can have an absorbing rim");
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3 r = particles.motion[i].position - centre_;
    in_layer_[particles.id[i]] = r.head<2>().norm() > 0.5 * disc.diameter - depth;
  }
  follow(particles);
}

void AbsorbingRim::follow(const Particles& particles) {
  layer_.clear();
  for (std::uint32_t i = 0; i < particles.size(); ++i)
    if (in_layer_[particles.id[i]]) layer_.push_back(i);
}

void AbsorbingRim::apply(Particles& particles, double dt) {
  const double normal = std::exp(-normal_rate_ * dt), tangential = std::exp(-tangential_rate_ * dt);
  account_ += chunked_sum<RimAccount>(layer_.size(), [&](std::size_t k, RimAccount& taken) {
    Motion& m = particles.motion[layer_[k]];
    Vec3 n = m.position - centre_;
    n.z() = 0;
    n.normalize();
    const Vec3 before = m.velocity, v_n = before.dot(n) * n;
    m.velocity = normal * v_n + tangential * (before - v_n);
    const Vec3 impulse = particles.mass * (m.velocity - before);
    taken.energy -= 0.5 * impulse.dot(m.velocity + before);
    taken.impulse += impulse;
    taken.angular_impulse += m.position.cross(impulse);
  });
}

std::size_t AbsorbingRim::bytes() const {
  return in_layer_.capacity() * sizeof(in_layer_[0]) + layer_.capacity() * sizeof(layer_[0]);
}

}  // namespace nilas::sph
