#include "sph/quiet_ice.hpp"

#include <algorithm>

namespace nilas::sph {

namespace {
constexpr std::uint8_t kAwakeRings = 2;  // around a stirred block

std::uint32_t first_particle(const Neighbours& neighbours, std::size_t block) {
  return neighbours.group_begin(neighbours.block_begin(block));
}

bool untouched(const Particles& p, std::size_t i) {
  const Sym3& s = p.stress[i];
  const bool free_of_stress = s.xx == 0 && s.yy == 0 && s.zz == 0 && s.xy == 0 && s.xz == 0 && s.yz == 0;
  return free_of_stress && p.motion[i].velocity.isZero(0) && p.velocity_gradient[i].isZero(0) &&
         p.condition(i) == Condition::intact;
}

/// From zeros at some blocks to the number of blocks to the nearest of them, for those up to `most` away.
void count_rings(const std::vector<std::vector<std::uint32_t>>& near, std::uint8_t most,
                 std::vector<std::uint8_t>& rings) {
  for (std::uint8_t ring = 1; ring <= most; ++ring)
    for (std::size_t b = 0; b < near.size(); ++b)
      if (rings[b] == ring - 1)
        for (const std::uint32_t c : near[b]) rings[c] = std::min(rings[c], ring);
}
}  // namespace

bool has_quiet_ice(const IceSpec& spec) {
  const NumericsSpec& n = spec.numerics;
  return n.quiet_speed > 0 && spec.gravity == Vec3::Zero() && n.density_diffusion == 0 &&
         n.density_reinitialisation == 0 && n.shifting == 0;
}

void QuietIce::follow(const Neighbours& neighbours, Particles& particles) {
  const std::size_t blocks = neighbours.block_count();
  in_use_.resize(blocks);
  stirred_.assign(blocks, 1);
  near_.resize(blocks);
  particles.sleep.resize(particles.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t b = 0; b < blocks; ++b) {
    std::uint32_t i = first_particle(neighbours, b);
    const std::uint32_t end = first_particle(neighbours, b + 1);
    while (i < end && untouched(particles, i)) ++i;
    in_use_[b] = i < end;
  }
  if (std::all_of(in_use_.begin(), in_use_.end(), [](std::uint8_t used) { return used != 0; })) {
    std::fill(particles.sleep.begin(), particles.sleep.end(), 0);
    return;  // stirred as they all count, nothing is looked at until the next list
  }
#pragma omp parallel for schedule(dynamic)
  for (std::size_t b = 0; b < blocks; ++b) stirred_[b] = in_use_[b] && stirs(neighbours, particles, b);
  find_near(neighbours);
  spread(neighbours, particles);
}

void QuietIce::wake_touched(const Neighbours& neighbours, const std::vector<Contact>& contacts, Particles& particles) {
  bool any = false;
  for (const Contact& contact : contacts)
    for (const ContactForce& force : contact.forces()) {
      std::uint8_t& stirred = stirred_[neighbours.block_of(force.particle)];
      any = any || !stirred;
      stirred = 1;
    }
  if (any) spread(neighbours, particles);
}

void QuietIce::wake_stirred(const Neighbours& neighbours, Particles& particles) {
  bool any = false;
#pragma omp parallel for schedule(dynamic) reduction(|| : any)
  for (std::size_t b = 0; b < stirred_.size(); ++b) {
    if (stirred_[b] || !particles.awake(first_particle(neighbours, b)) || !stirs(neighbours, particles, b)) continue;
    stirred_[b] = 1;
    any = true;
  }
  if (any) spread(neighbours, particles);
}

bool QuietIce::stirs(const Neighbours& neighbours, const Particles& particles, std::size_t block) const {
  const std::uint32_t end = first_particle(neighbours, block + 1);
  for (std::uint32_t i = first_particle(neighbours, block); i < end; ++i)
    if (particles.motion[i].velocity.squaredNorm() > quiet_speed_ * quiet_speed_ ||
        contract(particles.stress[i], particles.stress[i]) > quiet_stress_ * quiet_stress_)
      return true;
  return false;
}

void QuietIce::find_near(const Neighbours& neighbours) {
#pragma omp parallel
  {
    std::vector<std::uint8_t> found(near_.size(), 0);
#pragma omp for schedule(dynamic)
    for (std::size_t b = 0; b < near_.size(); ++b) {
      near_[b].clear();
      for (std::uint32_t i = first_particle(neighbours, b); i < first_particle(neighbours, b + 1); ++i)
        for (const std::uint32_t group : neighbours.groups_one_sided(i)) {
          const auto other = static_cast<std::uint32_t>(neighbours.block_of(neighbours.group_begin(group)));
          if (found[other]) continue;
          found[other] = 1;
          near_[b].push_back(other);
        }
      for (const std::uint32_t other : near_[b]) found[other] = 0;
    }
  }
}

/// From the stirred blocks to what is awake, and how deep the others sleep.
void QuietIce::spread(const Neighbours& neighbours, Particles& particles) {
  const std::size_t blocks = near_.size();
  from_stirred_.resize(blocks);
  sleep_.resize(blocks);
  for (std::size_t b = 0; b < blocks; ++b) from_stirred_[b] = stirred_[b] ? 0 : kAwakeRings + 1;
  count_rings(near_, kAwakeRings, from_stirred_);
  for (std::size_t b = 0; b < blocks; ++b)
    sleep_[b] = in_use_[b] || from_stirred_[b] <= kAwakeRings ? 0 : Particles::kFastAsleep;
  count_rings(near_, Particles::kFastAsleep - 1, sleep_);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < blocks; ++b)
    std::fill(particles.sleep.begin() + first_particle(neighbours, b),
              particles.sleep.begin() + first_particle(neighbours, b + 1), sleep_[b]);
}

std::size_t QuietIce::bytes() const {
  std::size_t total = stirred_.capacity() + in_use_.capacity() + from_stirred_.capacity() + sleep_.capacity() +
                      near_.capacity() * sizeof(near_[0]);
  for (const auto& blocks : near_) total += blocks.capacity() * sizeof(blocks[0]);
  return total;
}

}  // namespace nilas::sph
