#include "sph/shifting.hpp"

namespace nilas::sph {

namespace {
constexpr double kSurface = 0.75;  // share of the kernel sum inside solid ice
}  // namespace

Shifting::Shifting(double share, double spacing, double solid_volume, const WendlandC2& kernel, const Period& period)
    : diffusivity_(0.5 * share * kernel.smoothing_length() * kernel.smoothing_length()),
      largest_(kLargest * spacing),
      solid_volume_(solid_volume),
      kernel_(kernel),
      period_(period) {}

bool Shifting::near_surface(const Particles& particles, const Neighbours& neighbours, std::size_t i) const {
  if (surface_[i]) return true;
  const double reach2 = kernel_.support_radius() * kernel_.support_radius();
  bool near = false;
  neighbours.for_each_near(i, [&](std::uint32_t j) {
    const Vec3 d = shortest_image(particles.motion[i].position - particles.motion[j].position, period_);
    near = near || (surface_[j] && d.squaredNorm() < reach2);
  });
  return near;
}

void Shifting::apply(Particles& particles, const Neighbours& neighbours) {
  const std::size_t n = particles.size();
  shift_.resize(n);
  surface_.resize(n);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 gradient = Vec3::Zero();
    double moment = 0;
    neighbours.for_each_near(i, [&](std::uint32_t j) {
      const Vec3 d = shortest_image(particles.motion[i].position - particles.motion[j].position, period_);
      const double f = kernel_.gradient_factor(d.norm());
      gradient += particles.motion[j].volume * f * d;
      moment -= solid_volume_ * f * d.squaredNorm();
    });
    surface_[i] = moment < 3 * kSurface;
    shift_[i] = -diffusivity_ * gradient;
    const double length = shift_[i].norm();
    if (length > largest_) shift_[i] *= largest_ / length;
  }
  // Loops of their own: a shift depends on the surfaces around it, and all of them on the positions before.
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i)
    if (particles.held[i] || near_surface(particles, neighbours, i)) shift_[i].setZero();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) particles.motion[i].position += shift_[i];
}

}  // namespace nilas::sph
