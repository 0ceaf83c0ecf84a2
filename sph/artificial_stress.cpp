#include "sph/artificial_stress.hpp"

#include <Eigen/Eigenvalues>

namespace nilas::sph {

namespace {

constexpr double kClosest = 0.5;  // spacings, below which f does not grow

/// Sylvester: all principal stresses negative. A stress on the edge (zero, say) may be reported as not so.
bool compressive(const Sym3& s) {
  const double minor = s.xx * s.yy - s.xy * s.xy;
  const double det = s.zz * minor - s.xx * s.yz * s.yz - s.yy * s.xz * s.xz + 2 * s.xy * s.xz * s.yz;
  return s.xx < 0 && minor > 0 && det < 0;
}

/// SUM_k max(sigma_k, 0) q_k (x) q_k. It depends continuously on the stress: where principal stresses coincide, any
/// choice of directions gives the same.
Sym3 tensile_part(const Sym3& stress) {
  if (compressive(stress)) return {};
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(to_matrix(stress));
  const Mat3& q = principal.eigenvectors();
  return symmetric_part(q * principal.eigenvalues().cwiseMax(0).asDiagonal() * q.transpose());
}

}  // namespace

ArtificialStress::ArtificialStress(const NumericsSpec& numerics, double spacing, const Period& period)
    : epsilon_(numerics.artificial_stress),
      exponent_(numerics.artificial_stress_exponent),
      kernel_(numerics.smoothing_ratio * spacing),
      spacing_(spacing),
      period_(period) {}

void ArtificialStress::apply(Particles& particles, const Neighbours& neighbours) {
  const std::size_t n = particles.size();
  r_.resize(n);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) {
    const double rho = particles.density(i);
    r_[i] = (-epsilon_ / (rho * rho)) * tensile_part(particles.stress[i]);
  }

  const double inverse_w = 1 / kernel_.value(spacing_), closest = kClosest * spacing_;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 x_i = particles.motion[i].position;
    Vec3 a = Vec3::Zero();
    neighbours.for_each_near(i, [&](std::uint32_t j) {
      if (trace(r_[i]) + trace(r_[j]) == 0) return;  // neither is in tension
      const Vec3 d = shortest_image(x_i - particles.motion[j].position, period_);
      const double r = d.norm();
      if (r >= kernel_.support_radius()) return;
      const double f = inverse_w * kernel_.value(std::max(r, closest));
      a += std::pow(f, exponent_) * kernel_.gradient_factor(r) * (to_matrix(r_[i] + r_[j]) * d);
    });
    particles.stabilisation[i] += particles.mass * a;
  }
}

}  // namespace nilas::sph
