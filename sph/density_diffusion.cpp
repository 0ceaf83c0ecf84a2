#include "sph/density_diffusion.hpp"

#include "sph/debris.hpp"

namespace nilas::sph {

DensityDiffusion::DensityDiffusion(double diffusivity, double solid_volume, const WendlandC2& kernel,
                                   const Period& period)
    : diffusivity_(diffusivity), solid_volume_(solid_volume), kernel_(kernel), period_(period) {}

void DensityDiffusion::apply(Particles& particles, const Neighbours& neighbours, double dt) {
  const std::size_t n = particles.size();
  const double h = kernel_.smoothing_length(), eta2 = 0.01 * h * h;
  rate_.resize(n);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) {
    const Motion& m_i = particles.motion[i];
    rate_[i] = 0;
    if (is_scattered(m_i.volume, solid_volume_)) continue;
    double sum = 0;
    neighbours.for_each_near(i, [&](std::uint32_t j) {
      const Motion& m_j = particles.motion[j];
      if (is_scattered(m_j.volume, solid_volume_)) return;
      const double r2 = shortest_image(m_i.position - m_j.position, period_).squaredNorm();
      const double w = -kernel_.gradient_factor(std::sqrt(r2)) * r2 / (r2 + eta2);
      sum += (m_j.volume - m_i.volume) * w;
    });
    rate_[i] = 2 * diffusivity_ * sum;
  }
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) particles.motion[i].volume *= std::exp(dt * rate_[i]);
}

}  // namespace nilas::sph
