#include "sph/density_reinitialisation.hpp"

#include "sph/debris.hpp"

namespace nilas::sph {

void reinitialise_density(Particles& particles, const Neighbours& neighbours, double solid_volume,
                          const WendlandC2& kernel, const Period& period) {
  const std::size_t n = particles.size();
  std::vector<double> volume(n);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) {
    const Motion& m_i = particles.motion[i];
    volume[i] = m_i.volume;
    if (is_scattered(m_i.volume, solid_volume)) continue;
    double weights = kernel.value(0), sum = 0;  // of the departures from V_i, so that a constant stays to the last bit
    neighbours.for_each_near(i, [&](std::uint32_t j) {
      const Motion& m_j = particles.motion[j];
      if (is_scattered(m_j.volume, solid_volume)) return;
      const double w = kernel.value(shortest_image(m_i.position - m_j.position, period).norm());
      weights += w;
      sum += w * (m_j.volume - m_i.volume);
    });
    volume[i] += sum / weights;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) particles.motion[i].volume = volume[i];
}

}  // namespace nilas::sph
