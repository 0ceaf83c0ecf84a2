// One point of material driven along a path of strain, or of axial strain at a given lateral stress.
#pragma once

#include <cmath>

#include "sph/material.hpp"

namespace nilas::sph::test {

template <class Law>
class MaterialPoint {
 public:
  /// `dt`: duration of every increment [s], for laws with rates.
  explicit MaterialPoint(const Law& law, double dt = 0) : law_(law), dt_(dt) {}

  /// Adds a strain increment without rotation.
  void strain(const Sym3& increment) {
    volume_strain_ += trace(increment);
    stress_ = law_.update(stress_, {increment, std::exp(-volume_strain_) - 1, dt_}, state_);
  }
  /// Adds axial strain (xx) with the lateral stress (yy, zz) held at `lateral` [Pa]: the lateral strain increment that
  /// does it is found by bisection, the lateral stress being a rising function of it.
  void axial(double increment, double lateral) {
    double low = -20 * std::abs(increment) - 1e-6, high = -low;
    for (int n = 0; n < 80; ++n) {
      const double middle = 0.5 * (low + high);
      MaterialPoint trial = *this;
      trial.strain({increment, middle, middle});
      (trial.stress_.yy < lateral ? low : high) = middle;
    }
    lateral_strain_ += low;
    strain({increment, low, low});
  }

  const Sym3& stress() const { return stress_; }
  double pressure() const { return -trace(stress_) / 3; }
  double sqrt_j2() const { return std::sqrt(second_invariant(deviator(stress_))); }
  const typename Law::State& state() const { return state_; }
  typename Law::State& state() { return state_; }
  double lateral_strain() const { return lateral_strain_; }

 private:
  Law law_;
  double dt_;
  Sym3 stress_{};
  typename Law::State state_{};
  double volume_strain_ = 0, lateral_strain_ = 0;
};

}  // namespace nilas::sph::test
