#include "sph/rate_dependent_ice.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "sph/drucker_prager.hpp"

namespace nilas::sph {

namespace {
constexpr double kLowestRate = 1, kHighestRate = 1e4;  // 1/s
constexpr double kSmallestFailureStrain = 0.002;
constexpr double kRelaxationCrossings = 7;  // of a spacing by sound
const double kSqrt3 = std::sqrt(3.0);
}  // namespace

RateDependentIce::RateDependentIce(const MaterialSpec& spec, double spacing)
    : constants_(spec),
      spec_(spec.rate_dependent),
      friction_(3 * plane_strain_slope(spec_.residual_friction_angle_deg)),
      young_modulus_(spec.young_modulus),
      tensile_damage_rate_(spacing * spec_.tensile_strength / (2 * spec_.fracture_energy)),
      fragment_scale_(std::cbrt(24 * std::pow(spec_.fracture_toughness / constants_.impedance(), 2))),
      relaxation_time_(kRelaxationCrossings * spacing / constants_.bulk_sound_speed()) {}

double RateDependentIce::compressive_strength(double strain_rate) const {
  return spec_.strength_at_unit_rate *
         std::pow(std::clamp(strain_rate, kLowestRate, kHighestRate), spec_.rate_exponent);
}

double RateDependentIce::failure_strain(double strain_rate) const {
  const double rate = std::clamp(strain_rate, kLowestRate, kHighestRate);
  const double fragment = fragment_scale_ / std::cbrt(rate * rate);
  return std::max(kSmallestFailureStrain, spec_.softening_slip / fragment);
}

void RateDependentIce::relax_rate(const StrainStep& step, DamageState& state) const {
  if (step.dt <= 0) return;
  // sqrt(2/3 e:e) = sqrt(4/3 J2(e))
  const double rate = std::sqrt(4.0 / 3 * second_invariant(deviator(step.strain))) / step.dt;
  const double relaxed = state.strain_rate - std::expm1(-step.dt / relaxation_time_) * (rate - state.strain_rate);
  state.strain_rate = std::clamp(relaxed, kLowestRate, kHighestRate);
}

void RateDependentIce::shear_return(Sym3& deviator, double pressure, DamageState& state) const {
  const double D = state.shear_damage;
  const double friction = friction_ * std::max(0.0, pressure);
  const auto strength = [&](double sigma_c) {
    return (1 - D) * sigma_c / kSqrt3 + D * std::min(sigma_c / kSqrt3, friction);
  };
  const double sqrt_j2 = std::sqrt(second_invariant(deviator));
  // Strength rises with the rate: ice that holds at the lowest rate holds.
  if (sqrt_j2 <= strength(spec_.strength_at_unit_rate)) return;
  const double Y = strength(compressive_strength(state.strain_rate));
  if (sqrt_j2 <= Y) return;
  const double plastic_strain = (sqrt_j2 - Y) / (kSqrt3 * constants_.shear_modulus);
  state.plastic_strain += plastic_strain;
  state.shear_damage = std::min(1.0, D + plastic_strain / failure_strain(state.strain_rate));
  deviator = (Y / sqrt_j2) * deviator;
}

Sym3 RateDependentIce::tension_cut_off(const Sym3& stress, DamageState& state) const {
  const double limit = (1 - state.tensile_damage) * spec_.tensile_strength;
  // The largest principal stress is at most tr/3 + 2 sqrt(J2/3): most ice is done with here.
  const double largest = trace(stress) / 3 + 2 * std::sqrt(second_invariant(deviator(stress)) / 3);
  if (largest <= limit) return stress;

  const Eigen::SelfAdjointEigenSolver<Mat3> principal(to_matrix(stress));
  Sym3 cut = stress;
  double largest_excess = 0;
  for (int i = 0; i < 3; ++i) {
    const double excess = principal.eigenvalues()[i] - limit;
    if (excess <= 0) continue;
    const Vec3 n = principal.eigenvectors().col(i);
    cut = cut + -excess * symmetric_part(n * n.transpose());
    largest_excess = std::max(largest_excess, excess);
  }
  const double opening = largest_excess / young_modulus_;
  state.tensile_damage = std::min(1.0, state.tensile_damage + opening * tensile_damage_rate_);
  // Voids relieve tension of the mean stress; pressure that the cut puts beyond zero is not kept as dilation.
  const double voids = (trace(stress) - std::max(0.0, trace(cut))) / (3 * constants_.bulk_modulus);
  state.bulking = std::max(state.bulking, std::min(spec_.largest_bulking, state.bulking + voids));
  return cut;
}

Sym3 RateDependentIce::update(const Sym3& turned, const StrainStep& step, DamageState& state) const {
  relax_rate(step, state);
  Sym3 S = deviator(turned) + (2 * constants_.shear_modulus) * deviator(step.strain);
  const double p = constants_.bulk_modulus * (step.compression + state.bulking);
  shear_return(S, p, state);
  const Sym3 stress = tension_cut_off(add_isotropic(S, -p), state);
  state.failed = state.failed || state.shear_damage >= 1 || state.tensile_damage >= 1;
  return stress;
}

}  // namespace nilas::sph
