// Constitutive laws of the ice, one value type each: from the stress turned with the material and the strain increment
// to the new stress. A law is chosen once per run; the stress update is compiled once per law.
#pragma once

#include <variant>

#include "sph/drucker_prager.hpp"

namespace nilas::sph {

/// Fields of one particle that a plastic law reads and writes.
struct PlasticState {
  double plastic_strain;
  double bulking;
  bool failed;
};

/// Hypo-elastic ice. Deviator: dS = 2G dev(D) dt. Pressure: from the volumetric strain increment or from density.
struct Elastic {
  static constexpr bool plastic = false;
  ElasticConstants constants;
  PressureLaw pressure_law;

  /// Trial stress. `turned`: stress after the rotation [Pa]; `strain`: D dt; `compression`: rho/rho0 - 1.
  Sym3 trial_deviator(const Sym3& turned, const Sym3& strain) const {
    return deviator(turned) + (2 * constants.shear_modulus) * deviator(strain);
  }
  double trial_pressure(const Sym3& turned, const Sym3& strain, double compression, double bulking) const {
    const double K = constants.bulk_modulus;
    return pressure_law == PressureLaw::density ? K * (compression + bulking) : -trace(turned) / 3 - K * trace(strain);
  }
  Sym3 update(const Sym3& turned, const Sym3& strain, double compression, PlasticState&) const {
    return add_isotropic(trial_deviator(turned, strain), -trial_pressure(turned, strain, compression, 0));
  }
};

/// Drucker-Prager ice (drucker_prager.hpp) with a choice of what it carries after first yield (AfterFailure).
class DruckerPrager {
 public:
  static constexpr bool plastic = true;
  explicit DruckerPrager(const MaterialSpec& spec);
  Sym3 update(const Sym3& turned, const Sym3& strain, double compression, PlasticState& state) const;

 private:
  double strength(const PlasticState& state) const;
  Elastic elastic_;
  DruckerPragerCone intact_, crushed_;
  AfterFailure after_failure_;
  double residual_strength_, softening_strain_;
};

using Material = std::variant<Elastic, DruckerPrager>;
Material make_material(const MaterialSpec& spec);

}  // namespace nilas::sph
