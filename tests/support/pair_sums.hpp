// Oracles for the neighbour list and the pair loops: every particle against every other, formulas as in the textbooks
// (unit vector times dW/dr, Eigen's inverse, all near images). Slow and plain; shares no code with sph/.
#pragma once

#include <Eigen/LU>
#include <Eigen/SVD>
#include <numbers>

#include "sph/particles.hpp"

namespace nilas::sph::test {

/// Wendland C2 in three dimensions: W [1/m3].
inline double kernel_value(double r, double h) {
  const double q = r / h;
  if (q >= 2) return 0;
  return 21 / (16 * std::numbers::pi * h * h * h) * std::pow(1 - q / 2, 4) * (2 * q + 1);
}

/// Wendland C2 in three dimensions: dW/dr [1/m4].
inline double kernel_slope(double r, double h) {
  const double q = r / h;
  if (q >= 2) return 0;
  const double a = 21 / (16 * std::numbers::pi * h * h * h);
  return -5 * a / h * q * std::pow(1 - q / 2, 3);
}

/// SUM V x^2 |dW/dr|/r over an unbounded cubic lattice: the factor by which the plain gradient of a linear field is off
/// there, and by which waves are slow.
inline double lattice_factor(double smoothing_ratio) {
  double sum = 0;
  const int n = static_cast<int>(std::ceil(2 * smoothing_ratio));
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n; k <= n; ++k) {
        const double r = std::sqrt(i * i + j * j + k * k);
        if (r > 0) sum -= i * i * kernel_slope(r, smoothing_ratio) / r;
      }
  return sum;
}

/// The shortest of the images of d up to four periods away, axis by axis; period 0 along axes that do not wrap.
inline Vec3 shortest_of_all_images(const Vec3& d, const Vec3& period) {
  Vec3 best = d;
  for (int axis = 0; axis < 3; ++axis)
    for (int n = -4; n <= 4; ++n) {
      const double image = d[axis] + n * period[axis];
      if (std::abs(image) < std::abs(best[axis])) best[axis] = image;
    }
  return best;
}

/// Pair sums of all particles against all.
class PairSums {
 public:
  struct Viscosity {
    double alpha = 0, beta = 0, sound_speed = 0;
  };
  PairSums(const Particles& particles, double smoothing_length, const Vec3& period = Vec3::Zero())
      : p_(particles), h_(smoothing_length), period_(period) {}

  /// grad_i W_ij [1/m4], zero at coincidence.
  Vec3 kernel_gradient(std::size_t i, std::size_t j) const {
    const Vec3 d = separation(i, j);
    const double r = d.norm();
    return r > 0 ? Vec3(kernel_slope(r, h_) / r * d) : Vec3::Zero();
  }
  /// SUM V_j (r_j - r_i) (x) grad_i W_ij, the identity for a perfect kernel sum.
  Mat3 moment(std::size_t i) const {
    Mat3 m = Mat3::Zero();
    for (std::size_t j = 0; j < p_.size(); ++j)
      m -= p_.motion[j].volume * separation(i, j) * kernel_gradient(i, j).transpose();
    return m;
  }
  Mat3 velocity_gradient(std::size_t i, bool corrected) const {
    Mat3 L = Mat3::Zero();
    for (std::size_t j = 0; j < p_.size(); ++j)
      L += p_.motion[j].volume * (p_.motion[j].velocity - p_.motion[i].velocity) * kernel_gradient(i, j).transpose();
    return corrected ? Mat3(L * moment(i).inverse()) : L;
  }
  /// Force of j on i from stress [N]; B_i, B_j multiply the stresses (identity without correction).
  Vec3 stress_force(std::size_t i, std::size_t j, const Mat3& B_i, const Mat3& B_j) const {
    const Mat3 T = to_matrix(p_.stress[i]) * B_i + to_matrix(p_.stress[j]) * B_j;
    return p_.motion[i].volume * p_.motion[j].volume * T * kernel_gradient(i, j);
  }
  /// Force of j on i from Monaghan's viscosity [N].
  Vec3 viscous_force(std::size_t i, std::size_t j, const Viscosity& viscosity) const {
    const Vec3 x = separation(i, j), u = p_.motion[i].velocity - p_.motion[j].velocity;
    if (u.dot(x) >= 0) return Vec3::Zero();
    const double mu = h_ * u.dot(x) / (x.squaredNorm() + 0.01 * h_ * h_);
    const double rho = (p_.density(i) + p_.density(j)) / 2;
    const double Pi = (-viscosity.alpha * viscosity.sound_speed * mu + viscosity.beta * mu * mu) / rho;
    return -p_.mass * p_.mass * Pi * kernel_gradient(i, j);
  }
  /// Inverse moment matrices of all particles.
  std::vector<Mat3> corrections() const {
    std::vector<Mat3> B;
    for (std::size_t i = 0; i < p_.size(); ++i) B.emplace_back(moment(i).inverse());
    return B;
  }
  /// B: corrections(), or empty for none.
  Vec3 acceleration(std::size_t i, const std::vector<Mat3>& B, const Viscosity& viscosity) const {
    const auto correction = [&](std::size_t j) { return B.empty() ? Mat3(Mat3::Identity()) : B[j]; };
    Vec3 force = Vec3::Zero();
    for (std::size_t j = 0; j < p_.size(); ++j) {
      if (j == i || separation(i, j).norm() >= 2 * h_) continue;
      force += stress_force(i, j, correction(i), correction(j)) + viscous_force(i, j, viscosity);
    }
    return force / p_.mass;
  }
  /// Gray, Monaghan and Swift 2001. The tensile part of a stress is (s + |s|)/2, |s| from its singular values.
  Vec3 artificial_stress(std::size_t i, double epsilon, double exponent, double spacing) const {
    const auto R = [&](std::size_t k) {
      const Mat3 s = to_matrix(p_.stress[k]);
      const Eigen::JacobiSVD<Mat3> svd(s, Eigen::ComputeFullV);
      const Mat3 magnitude = svd.matrixV() * svd.singularValues().asDiagonal() * svd.matrixV().transpose();
      return Mat3(-epsilon / std::pow(p_.density(k), 2) * (s + magnitude) / 2);
    };
    Vec3 a = Vec3::Zero();
    for (std::size_t j = 0; j < p_.size(); ++j) {
      if (j == i) continue;
      const double f = kernel_value(separation(i, j).norm(), h_) / kernel_value(spacing, h_);
      a += p_.mass * std::pow(f, exponent) * (R(i) + R(j)) * kernel_gradient(i, j);
    }
    return a;
  }
  /// d rho/dt of delta-SPH as printed by Molteni and Colagrossi 2009 [kg/(m3 s)]; diffusivity delta h c.
  double density_rate(std::size_t i, double diffusivity) const {
    double sum = 0;
    for (std::size_t j = 0; j < p_.size(); ++j) {
      const Vec3 x_ji = -separation(i, j);
      const double psi = 2 * (p_.density(j) - p_.density(i)) / (x_ji.squaredNorm() + 0.01 * h_ * h_);
      sum += psi * x_ji.dot(kernel_gradient(i, j)) * p_.motion[j].volume;
    }
    return diffusivity * sum;
  }
  /// SUM m W / SUM V W, itself included [kg/m3].
  double shepard_density(std::size_t i) const {
    double weights = 0;
    for (std::size_t j = 0; j < p_.size(); ++j) weights += kernel_value(separation(i, j).norm(), h_);
    return p_.mass * weights / concentration(i);
  }
  /// C_i = SUM V W, itself included.
  double concentration(std::size_t i) const {
    double sum = 0;
    for (std::size_t j = 0; j < p_.size(); ++j) sum += p_.motion[j].volume * kernel_value(separation(i, j).norm(), h_);
    return sum;
  }
  Vec3 concentration_gradient(std::size_t i) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t j = 0; j < p_.size(); ++j) sum += p_.motion[j].volume * kernel_gradient(i, j);
    return sum;
  }

 private:
  Vec3 separation(std::size_t i, std::size_t j) const {
    return shortest_of_all_images(p_.motion[i].position - p_.motion[j].position, period_);
  }
  const Particles& p_;
  double h_;
  Vec3 period_;
};

}  // namespace nilas::sph::test
