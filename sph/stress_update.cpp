#include "sph/stress_update.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sph/chunked_sum.hpp"
#include "sph/objective_update.hpp"
#include "sph/pair_passes_kernel.hpp"
#include "sph/stress_update_kernel.hpp"

namespace nilas::sph {

StressUpdateSums& StressUpdateSums::operator+=(const StressUpdateSums& o) {
  work += o.work;
  failed += o.failed;
  out_of_range = std::min(out_of_range, o.out_of_range);
  return *this;
}

namespace {

// A compression beyond this is a numerical failure, not ice: solid ice at 100 GPa is compressed 2 times. Debris may
// expand as far as it likes.
constexpr double kLargestCompression = 100;
constexpr double kNoLimit = 1e150;  // Pa: nothing yields, and its square is finite

void load(const Particles&, std::size_t, NoState&) {}
void store(Particles&, std::size_t, const NoState&) {}
bool has_failed(const NoState&) { return false; }

void load(const Particles& p, std::size_t i, PlasticState& state) {
  state = {p.plastic_strain[i], p.bulking.empty() ? 0 : p.bulking[i], p.failed[i] != 0};
}
void store(Particles& p, std::size_t i, const PlasticState& state) {
  p.plastic_strain[i] = state.plastic_strain;
  p.failed[i] = state.failed;
  if (!p.bulking.empty()) p.bulking[i] = state.bulking;
}
bool has_failed(const PlasticState& state) { return state.failed; }

void load(const Particles& p, std::size_t i, DamageState& state) {
  state = {p.strain_rate[i],    p.tensile_damage[i], p.shear_damage[i],
           p.plastic_strain[i], p.bulking[i],        p.failed[i] != 0};
}
void store(Particles& p, std::size_t i, const DamageState& state) {
  p.strain_rate[i] = state.strain_rate;
  p.tensile_damage[i] = state.tensile_damage;
  p.shear_damage[i] = state.shear_damage;
  p.plastic_strain[i] = state.plastic_strain;
  p.bulking[i] = state.bulking;
  p.failed[i] = state.failed;
}
bool has_failed(const DamageState& state) { return state.failed; }

/// One particle.
template <class Law>
void advance(Particles& particles, std::size_t i, const Law& law, double reference_volume, double dt,
             StressUpdateSums& sums) {
  const Mat3& L = particles.velocity_gradient[i];
  const Sym3 strain = dt * symmetric_part(L);
  double& volume = particles.motion[i].volume;
  const double old_volume = volume;
  volume *= std::exp(trace(strain));
  const bool sane = volume * kLargestCompression > reference_volume && std::isfinite(volume);
  if (!sane) sums.out_of_range = std::min(sums.out_of_range, i);

  const Sym3 turned = rotate_by_spin(particles.stress[i], L, dt);
  typename Law::State state{};
  load(particles, i, state);
  const Sym3 stress = law.update(turned, {strain, reference_volume / volume - 1, dt}, state);
  store(particles, i, state);
  sums.failed += has_failed(state);
  sums.work += 0.5 * (old_volume * contract(turned, strain) + volume * contract(stress, strain));
  particles.stress[i] = stress;
}

/// Laws that are elastic up to a cone are advanced four particles at a time where these stay elastic.
std::optional<ElasticPackConstants> elastic_range(const Elastic& law) {
  return ElasticPackConstants{law.constants.bulk_modulus, law.constants.shear_modulus, 0, kNoLimit, 0, 0};
}
std::optional<ElasticPackConstants> elastic_range(const DruckerPrager& law) {
  const ElasticConstants& elastic = law.elastic_constants();
  if (law.intact().alpha == 0 && law.intact().k == 0) return std::nullopt;  // no strength: never elastic
  return ElasticPackConstants{elastic.bulk_modulus, elastic.shear_modulus, law.intact().alpha, law.intact().k, 0, 0};
}
std::optional<ElasticPackConstants> elastic_range(const RateDependentIce&) { return std::nullopt; }
bool pressure_from_density(const Elastic& law) { return law.pressure_law == PressureLaw::density; }
bool pressure_from_density(const DruckerPrager& law) { return law.pressure_law() == PressureLaw::density; }
bool pressure_from_density(const RateDependentIce&) { return true; }

template <class Law>
StressUpdateSums update(Particles& particles, const Law& law, double reference_density, double dt) {
  const double reference_volume = particles.mass / reference_density;
  const std::size_t n = particles.size();
  std::optional<ElasticPackConstants> elastic = elastic_range(law);
  if (!elastic)
    return chunked_sum<StressUpdateSums>(n, [&](std::size_t i, StressUpdateSums& sums) {
      if (particles.awake(i)) advance(particles, i, law, reference_volume, dt, sums);
    });
  elastic->reference_volume = reference_volume;
  elastic->smallest_volume = reference_volume / kLargestCompression;
  const ElasticPackUpdate advance_four =
      (has_v3() ? v3::select_elastic_update : baseline::select_elastic_update)(pressure_from_density(law));
  const auto advance_pack = [&](std::size_t pack, StressUpdateSums& sums) {
    const std::size_t begin = 4 * pack, end = std::min(n, begin + 4);
    // Nothing changes in sleeping ice that shares a pack with ice that is awake: its velocity gradient is zero.
    if (!particles.awake(begin) && !particles.awake(end - 1)) return;
    if (begin + 4 <= n && advance_four(particles, begin, *elastic, dt, sums.work)) return;
    for (std::size_t i = begin; i < end; ++i) advance(particles, i, law, reference_volume, dt, sums);
  };
  return chunked_sum<StressUpdateSums>((n + 3) / 4, advance_pack, 64);
}

StressUpdateSums update(Particles& particles, const NeoHookean& law, double reference_density, double dt) {
  const double reference_volume = particles.mass / reference_density;
  return chunked_sum<StressUpdateSums>(particles.size(), [&](std::size_t i, StressUpdateSums& sums) {
    if (!particles.awake(i)) return;
    const Mat3& L = particles.velocity_gradient[i];
    Mat3& F = particles.deformation_gradient[i];
    F = NeoHookean::advance(F, L, dt);
    const double J = F.determinant();
    const bool sane = J * kLargestCompression > 1 && std::isfinite(J);
    if (!sane) {
      sums.out_of_range = std::min(sums.out_of_range, i);
      return;
    }
    double& volume = particles.motion[i].volume;
    const double old_volume = volume;
    volume = reference_volume * J;
    Sym3 kirchhoff = law.elastic_kirchhoff(F);
    if (law.damping > 0) kirchhoff = kirchhoff + law.damping_kirchhoff(F, L);

    const Sym3 strain = dt * symmetric_part(L);
    // Trapezium over the step's path of F, along which D stays where it is and the stress turns.
    sums.work +=
        0.5 * (old_volume * contract(particles.stress[i], strain) + reference_volume * contract(kirchhoff, strain));
    particles.stress[i] = (1 / J) * kirchhoff;
  });
}

/// Stored energy of one particle [J].
double stored_energy(const Particles& particles, std::size_t i, const NeoHookean& law) {
  const Mat3& F = particles.deformation_gradient[i];
  return particles.motion[i].volume / F.determinant() * law.energy(F);
}
template <class Law>
double stored_energy(const Particles& particles, std::size_t i, const Law& law) {
  const ElasticConstants& c = law.elastic_constants();
  const Sym3& s = particles.stress[i];
  const double p = -trace(s) / 3;
  return particles.motion[i].volume *
         (second_invariant(deviator(s)) / (2 * c.shear_modulus) + p * p / (2 * c.bulk_modulus));
}

struct Energy {
  double value = 0;
  Energy& operator+=(const Energy& o) {
    value += o.value;
    return *this;
  }
};

}  // namespace

StressUpdateSums update_stress(Particles& particles, const Material& material, double reference_density, double dt) {
  return std::visit([&](const auto& law) { return update(particles, law, reference_density, dt); }, material);
}

void turn_correction(Particles& particles, double dt) {
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < particles.correction.size(); ++i)
    if (particles.awake(i))
      particles.correction[i] = rotate_by_spin(particles.correction[i], particles.velocity_gradient[i], dt);
}

double elastic_energy(const Particles& particles, const Material& material) {
  return std::visit(
      [&](const auto& law) {
        const auto add = [&](std::size_t i, Energy& e) { e.value += stored_energy(particles, i, law); };
        return chunked_sum<Energy>(particles.size(), add).value;
      },
      material);
}

}  // namespace nilas::sph
