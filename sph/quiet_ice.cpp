#include "sph/quiet_ice.hpp"

#include <algorithm>

#include "sph/terms.hpp"

namespace nilas::sph {

namespace {
constexpr std::uint8_t kAwakeRings = 2;

std::uint32_t first_particle(const Neighbours& neighbours, std::size_t block) {
  return neighbours.group_begin(neighbours.block_begin(block));
}

bool untouched(const Particles& p, std::size_t i) {
  const Sym3& s = p.stress[i];
  const bool free_of_stress = s.xx == 0 && s.yy == 0 && s.zz == 0 && s.xy == 0 && s.xz == 0 && s.yz == 0;
  return free_of_stress && p.motion[i].velocity.isZero(0) && p.velocity_gradient[i].isZero(0) &&
         p.condition(i) == Condition::intact;
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
  sleep_.assign(blocks, 0);
  particles.sleep.resize(particles.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t b = 0; b < blocks; ++b) {
    std::uint32_t i = first_particle(neighbours, b);
    const std::uint32_t end = first_particle(neighbours, b + 1);
    while (i < end && untouched(particles, i)) ++i;
    in_use_[b] = i < end;
  }
  all_awake_ = std::all_of(in_use_.begin(), in_use_.end(), [](std::uint8_t used) { return used != 0; });
  if (all_awake_) {
    std::fill(particles.sleep.begin(), particles.sleep.end(), 0);
    return;
  }
  rings_.assign(neighbours.group_count(), kAwakeRings + 1);
  spread_.assign(neighbours.group_count(), kAwakeRings);
  find_near(neighbours);
  find_stirred(neighbours, particles);
  wake(neighbours, particles);
}

void QuietIce::wake_touched(const Neighbours& neighbours, const std::vector<Contact>& contacts, Particles& particles) {
  if (all_awake_) return;
  bool any = false;
  for (const Contact& contact : contacts)
    for (const ContactForce& force : contact.forces()) {
      std::uint8_t& rings = rings_[neighbours.group_of(force.particle)];
      any = any || rings > 0;
      rings = 0;
    }
  if (any) wake(neighbours, particles);
}

void QuietIce::wake_stirred(const Neighbours& neighbours, Particles& particles) {
  if (!all_awake_ && find_stirred(neighbours, particles)) wake(neighbours, particles);
}

bool QuietIce::find_stirred(const Neighbours& neighbours, const Particles& particles) {
  const auto stirs = [&](std::uint32_t i) {
    return particles.motion[i].velocity.squaredNorm() > quiet_speed_ * quiet_speed_ ||
           contract(particles.stress[i], particles.stress[i]) > quiet_stress_ * quiet_stress_;
  };
  bool any = false;
#pragma omp parallel for schedule(dynamic) reduction(|| : any)
  for (std::size_t b = 0; b < sleep_.size(); ++b) {
    if (sleep_[b] > 0) continue;
    for (std::size_t g = neighbours.block_begin(b); g < neighbours.block_begin(b + 1); ++g)
      for (std::uint32_t i = neighbours.group_begin(g); rings_[g] > 0 && i < neighbours.group_begin(g + 1); ++i)
        if (stirs(i)) rings_[g] = 0, any = true;
  }
  return any;
}

/// Counts the rings around groups that are nearer to a stirred one than when this was last done.
void QuietIce::spread(const Neighbours& neighbours) {
  for (std::uint8_t ring = 0; ring < kAwakeRings; ++ring)
    for (std::size_t g = 0; g < rings_.size(); ++g) {
      if (rings_[g] != ring || spread_[g] <= ring) continue;
      spread_[g] = ring;
      for (std::uint32_t i = neighbours.group_begin(g); i < neighbours.group_begin(g + 1); ++i)
        for (const std::uint32_t near : neighbours.groups_near(i))
          rings_[near] = std::min<std::uint8_t>(rings_[near], ring + 1);
    }
}

/// Wakes the blocks that stirred groups may reach, and counts how far from awake ones the others are.
void QuietIce::wake(const Neighbours& neighbours, Particles& particles) {
  const std::size_t blocks = near_.size();
  spread(neighbours);
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto reached = [](std::uint8_t rings) { return rings <= kAwakeRings; };
    const bool awake = in_use_[b] || std::any_of(rings_.begin() + neighbours.block_begin(b),
                                                 rings_.begin() + neighbours.block_begin(b + 1), reached);
    sleep_[b] = awake ? 0 : Particles::kFastAsleep;
  }
  for (std::uint8_t depth = 1; depth < Particles::kFastAsleep; ++depth)
    for (std::size_t b = 0; b < blocks; ++b)
      if (sleep_[b] == depth - 1)
        for (const std::uint32_t near : near_[b]) sleep_[near] = std::min(sleep_[near], depth);
#pragma omp parallel for schedule(static)
  for (std::size_t b = 0; b < blocks; ++b)
    std::fill(particles.sleep.begin() + first_particle(neighbours, b),
              particles.sleep.begin() + first_particle(neighbours, b + 1), sleep_[b]);
}

void QuietIce::find_near(const Neighbours& neighbours) {
  near_.resize(neighbours.block_count());
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

std::size_t QuietIce::bytes() const {
  std::size_t total = rings_.capacity() + spread_.capacity() + in_use_.capacity() + sleep_.capacity() +
                      near_.capacity() * sizeof(near_[0]);
  for (const auto& blocks : near_) total += blocks.capacity() * sizeof(blocks[0]);
  return total;
}

}  // namespace nilas::sph
