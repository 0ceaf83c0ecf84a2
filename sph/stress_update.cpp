#include "sph/stress_update.hpp"

#include <algorithm>
#include <cmath>

#include "sph/chunked_sum.hpp"
#include "sph/objective_update.hpp"

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

template <class Law>
StressUpdateSums update(Particles& particles, const Law& law, double reference_density, double dt) {
  const double reference_volume = particles.mass / reference_density;
  const bool has_bulking = !particles.bulking.empty();
  return chunked_sum<StressUpdateSums>(particles.size(), [&](std::size_t i, StressUpdateSums& sums) {
    const Mat3& L = particles.velocity_gradient[i];
    const Sym3 strain = dt * symmetric_part(L);
    double& volume = particles.motion[i].volume;
    const double old_volume = volume;
    volume *= std::exp(trace(strain));
    const bool sane = volume * kLargestCompression > reference_volume && std::isfinite(volume);
    if (!sane) sums.out_of_range = std::min(sums.out_of_range, i);

    const Sym3 turned = rotate_by_spin(particles.stress[i], L, dt);
    PlasticState state{};
    if constexpr (Law::plastic) {
      state = {particles.plastic_strain[i], has_bulking ? particles.bulking[i] : 0, particles.failed[i] != 0};
    }
    const Sym3 stress = law.update(turned, strain, reference_volume / volume - 1, state);
    if constexpr (Law::plastic) {
      particles.plastic_strain[i] = state.plastic_strain;
      particles.failed[i] = state.failed;
      if (has_bulking) particles.bulking[i] = state.bulking;
      sums.failed += state.failed;
    }
    sums.work += 0.5 * (old_volume * contract(turned, strain) + volume * contract(stress, strain));
    particles.stress[i] = stress;
  });
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

double elastic_energy(const Particles& particles, const ElasticConstants& c) {
  return chunked_sum<Energy>(particles.size(),
                             [&](std::size_t i, Energy& e) {
                               const Sym3& s = particles.stress[i];
                               const double p = -trace(s) / 3;
                               e.value +=
                                   particles.motion[i].volume * (second_invariant(deviator(s)) / (2 * c.shear_modulus) +
                                                                 p * p / (2 * c.bulk_modulus));
                             })
      .value;
}

}  // namespace nilas::sph
