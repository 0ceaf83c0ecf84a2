#include "sph/material.hpp"

#include <algorithm>

namespace nilas::sph {

DruckerPrager::DruckerPrager(const MaterialSpec& spec)
    : elastic_{ElasticConstants(spec), spec.pressure},
      intact_(spec, elastic_.constants),
      crushed_(intact_.cohesionless()),
      after_failure_(spec.after_failure),
      residual_strength_(spec.residual_strength),
      softening_strain_(spec.softening_strain) {}

double DruckerPrager::strength(const PlasticState& state) const {
  if (!state.failed) return 1;
  switch (after_failure_) {
    case AfterFailure::plastic:
    case AfterFailure::cohesionless:
      return 1;
    case AfterFailure::fluid:
      return 0;
    case AfterFailure::softening:
      break;
  }
  const double progress = softening_strain_ > 0 ? std::min(1.0, state.plastic_strain / softening_strain_) : 1;
  return 1 - progress * (1 - residual_strength_);
}

Sym3 DruckerPrager::update(const Sym3& turned, const StrainStep& step, PlasticState& state) const {
  const Sym3 S = elastic_.trial_deviator(turned, step);
  const double p = elastic_.trial_pressure(turned, step, state.bulking);

  if (!state.failed && intact_.yield_function(std::sqrt(second_invariant(S)), p) > 0) state.failed = true;
  const DruckerPragerCone& cone = state.failed && after_failure_ == AfterFailure::cohesionless ? crushed_ : intact_;
  const ReturnedStress r = cone.hardening > 0 ? cone.hardened(state.plastic_strain).return_map(S, p, strength(state))
                                              : cone.return_map(S, p, strength(state));

  state.plastic_strain += r.multiplier / std::sqrt(3.0);
  // Pressure from density remembers only the dilation of the cone; a void opened at the tension limit has to close.
  if (r.plastic_volume > 0 && r.pressure > 0) state.bulking += r.plastic_volume;
  return add_isotropic(r.deviator, -r.pressure);
}

Material make_material(const MaterialSpec& spec, double spacing, double smoothing_length) {
  switch (spec.model) {
    case Model::elastic:
      return Elastic{ElasticConstants(spec), spec.pressure};
    case Model::neo_hookean:
      return NeoHookean(spec, smoothing_length);
    case Model::rate_dependent:
      return RateDependentIce(spec, spacing);
    case Model::drucker_prager:
      break;
  }
  return DruckerPrager(spec);
}

}  // namespace nilas::sph
