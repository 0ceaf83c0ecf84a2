// Constitutive laws of the ice, one value type each: from the stress turned with the material and the strain increment
// to the new stress (neo-Hookean ice: from the deformation gradient). A law is chosen once per run; the stress update
// is compiled once per law.
#pragma once

#include <variant>

#include "sph/drucker_prager.hpp"
#include "sph/neo_hookean.hpp"
#include "sph/rate_dependent_ice.hpp"
#include "sph/strain_step.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

/// Fields of one particle that a law reads and writes: none, or those of plasticity.
struct NoState {};
struct PlasticState {
  double plastic_strain;
  double bulking;
  bool failed;
};

/// Hypo-elastic ice. Deviator: dS = 2G dev(D) dt. Pressure: from the volumetric strain increment or from density.
struct Elastic {
  using State = NoState;
  ElasticConstants constants;
  PressureLaw pressure_law;

  const ElasticConstants& elastic_constants() const { return constants; }

  /// Trial stress. `turned`: stress after the rotation [Pa].
  Sym3 trial_deviator(const Sym3& turned, const StrainStep& step) const {
    return deviator(turned) + (2 * constants.shear_modulus) * deviator(step.strain);
  }
  double trial_pressure(const Sym3& turned, const StrainStep& step, double bulking) const {
    const double K = constants.bulk_modulus;
    return pressure_law == PressureLaw::density ? K * (step.compression + bulking)
                                                : -trace(turned) / 3 - K * trace(step.strain);
  }
  Sym3 update(const Sym3& turned, const StrainStep& step, NoState&) const {
    return add_isotropic(trial_deviator(turned, step), -trial_pressure(turned, step, 0));
  }
};

/// Drucker-Prager ice (drucker_prager.hpp) with a choice of what it carries after first yield (AfterFailure).
class DruckerPrager {
 public:
  using State = PlasticState;
  explicit DruckerPrager(const MaterialSpec& spec);
  Sym3 update(const Sym3& turned, const StrainStep& step, PlasticState& state) const;
  const ElasticConstants& elastic_constants() const { return elastic_.constants; }
  PressureLaw pressure_law() const { return elastic_.pressure_law; }
  /// The cone up to which unbroken ice is elastic.
  const DruckerPragerCone& intact() const { return intact_; }

 private:
  double strength(const PlasticState& state) const;
  Elastic elastic_;
  DruckerPragerCone intact_, crushed_;
  AfterFailure after_failure_;
  double residual_strength_, softening_strain_;
};

using Material = std::variant<Elastic, NeoHookean, DruckerPrager, RateDependentIce>;

/// The law of a spec. Lengths [m] for the laws that know one: particle spacing (crack energy), smoothing length
/// (Kelvin-Voigt damping).
Material make_material(const MaterialSpec& spec, double spacing, double smoothing_length);

}  // namespace nilas::sph

#pragma GCC visibility pop
