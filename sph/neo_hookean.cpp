#include "sph/neo_hookean.hpp"

#include <Eigen/LU>
#include <cmath>

namespace nilas::sph {

double kelvin_voigt_viscosity(const MaterialSpec& spec, double smoothing_length) {
  if (spec.model != Model::neo_hookean) return 0;
  return spec.kelvin_voigt * spec.density * ElasticConstants(spec).bulk_sound_speed() * smoothing_length / 2;
}

Mat3 NeoHookean::advance(const Mat3& F, const Mat3& velocity_gradient, double dt) {
  const Mat3 half = 0.5 * dt * velocity_gradient;
  const Mat3 after = (Mat3::Identity() + half) * F;
  return (Mat3::Identity() - half).inverse() * after;
}

double NeoHookean::energy(const Mat3& F) const {
  const double J = F.determinant();
  const double volumetric = 0.5 * (J * J - 1) - std::log(J);
  return 0.5 * constants.bulk_modulus * volumetric +
         0.5 * constants.shear_modulus * (std::pow(J, -2.0 / 3) * F.squaredNorm() - 3);
}

Sym3 NeoHookean::elastic_kirchhoff(const Mat3& F) const {
  const double J = F.determinant();
  const Sym3 b = symmetric_part(F * F.transpose());
  return add_isotropic((constants.shear_modulus * std::pow(J, -2.0 / 3)) * deviator(b),
                       0.5 * constants.bulk_modulus * (J * J - 1));
}

Sym3 NeoHookean::damping_kirchhoff(const Mat3& F, const Mat3& velocity_gradient) const {
  // chi/2 (L b + b L^T) = chi sym(L b)
  return damping * symmetric_part(velocity_gradient * (F * F.transpose()));
}

}  // namespace nilas::sph
