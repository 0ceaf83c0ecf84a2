// Wendland C2 kernel in three dimensions (Wendland 1995; Cai et al. 2025, Eq. 2), support radius 2h, q = r/h:
//
//   W(q)      = a_D (1 - q/2)^4 (2q + 1),  a_D = 21 / (16 pi h^3)
//   grad_i W  = -(5 a_D / h^2) (1 - q/2)^3 (r_i - r_j)          (no division by r: regular at coincidence)
#pragma once

#include <algorithm>
#include <numbers>

namespace nilas::sph {

class WendlandC2 {
 public:
  /// smoothing_length h [m] > 0.
  explicit WendlandC2(double smoothing_length)
      : h_(smoothing_length), normalisation_(21 / (16 * std::numbers::pi * h_ * h_ * h_)) {}

  double smoothing_length() const { return h_; }
  double support_radius() const { return 2 * h_; }

  /// W(r) [1/m3].
  double value(double r) const {
    const double t = std::max(0.0, 1 - 0.5 * r / h_);
    return normalisation_ * t * t * t * t * (2 * r / h_ + 1);
  }
  /// The scalar f in grad_i W = f (r_i - r_j) [1/m5], <= 0, zero outside the support.
  double gradient_factor(double r) const {
    const double t = std::max(0.0, 1 - 0.5 * r / h_);
    return gradient_scale() * t * t * t;
  }
  /// f at t = 1, for loops that form t = 1 - r/(2h) themselves.
  double gradient_scale() const { return -5 * normalisation_ / (h_ * h_); }

 private:
  double h_;
  double normalisation_;
};

}  // namespace nilas::sph
