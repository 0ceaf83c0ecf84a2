// Reads [ice.material].
#include "cases/material_presets.hpp"
#include "cases/number_text.hpp"
#include "cases/scene_parts.hpp"
#include "cases/scene_words.hpp"

namespace nilas::cases {

namespace {

constexpr Word<sph::MaterialSpec (*)()> presets[] = {{"cai-2025", cai_2025_ice}, {"real-ice", real_ice}};

constexpr Range angle{.low = 0, .high = 90, .high_excluded = true};

void read_plasticity(TomlTable& table, sph::MaterialSpec& material) {
  material.cohesion = table.number("cohesion_Pa", not_negative, material.cohesion);
  material.friction_angle_deg = table.number("friction_angle_deg", angle, material.friction_angle_deg);
  const Range dilation{.low = 0, .high = material.friction_angle_deg};
  const double usual = material.dilation_angle_deg;
  material.dilation_angle_deg = table.number("dilation_angle_deg", dilation, usual);
  if (!dilation.holds(material.dilation_angle_deg))
    table.fail("dilation_angle_deg", "needed, the default of " + number_text(usual) +
                                         " is larger than friction_angle_deg; allowed: a finite number" +
                                         dilation.text());
  material.after_failure = table.choice("after_failure", words::after_failure, std::optional(material.after_failure));
  if (material.after_failure == sph::AfterFailure::softening) {
    material.residual_strength = table.number("residual_strength", {.low = 0, .high = 1}, material.residual_strength);
    material.softening_strain = table.number("softening_strain", not_negative, material.softening_strain);
  } else {
    for (const char* key : {"residual_strength", "softening_strain"})
      table.refuse(key, "allowed only with after_failure = \"softening\"");
  }
  if (material.after_failure == sph::AfterFailure::plastic)
    material.hardening_modulus = table.number("hardening_modulus_Pa", not_negative, material.hardening_modulus);
  else
    table.refuse("hardening_modulus_Pa", "allowed only with after_failure = \"plastic\"");
}

void read_rate_dependence(TomlTable& table, sph::RateDependentSpec& ice) {
  ice.strength_at_unit_rate = table.number("strength_at_unit_rate_Pa", positive, ice.strength_at_unit_rate);
  ice.rate_exponent = table.number("rate_exponent", {.low = 0, .high = 1}, ice.rate_exponent);
  ice.tensile_strength = table.number("tensile_strength_Pa", positive, ice.tensile_strength);
  ice.fracture_energy = table.number("fracture_energy_J_m2", positive, ice.fracture_energy);
  ice.fracture_toughness = table.number("fracture_toughness_Pa_sqrt_m", positive, ice.fracture_toughness);
  ice.softening_slip = table.number("softening_slip_m", not_negative, ice.softening_slip);
  ice.residual_friction_angle_deg = table.number("residual_friction_angle_deg", angle, ice.residual_friction_angle_deg);
  ice.largest_bulking = table.number("largest_bulking", {.low = 0, .high = 1}, ice.largest_bulking);
}

/// Keys that belong to one model.
constexpr const char* drucker_prager_keys[] = {"cohesion_Pa",         "friction_angle_deg", "dilation_angle_deg",
                                               "after_failure",       "residual_strength",  "softening_strain",
                                               "hardening_modulus_Pa"};
constexpr const char* rate_dependent_keys[] = {
    "strength_at_unit_rate_Pa",     "rate_exponent",    "tensile_strength_Pa",         "fracture_energy_J_m2",
    "fracture_toughness_Pa_sqrt_m", "softening_slip_m", "residual_friction_angle_deg", "largest_bulking"};
constexpr const char* neo_hookean_keys[] = {"kelvin_voigt"};

template <std::size_t n>
void refuse_keys(TomlTable& table, const char* const (&keys)[n], sph::Model of) {
  const std::string model(words::word_of(words::model, of));
  for (const char* key : keys) table.refuse(key, "allowed only with model = \"" + model + "\"");
}

/// Two models have one pressure each: from the density that their own state implies.
void read_pressure(TomlTable& table, sph::MaterialSpec& material) {
  if (material.model == sph::Model::elastic || material.model == sph::Model::drucker_prager) {
    material.pressure = table.choice("pressure", words::pressure, std::optional(material.pressure));
    return;
  }
  table.refuse("pressure", "allowed only with model = \"elastic\" or \"drucker-prager\"");
  material.pressure = sph::PressureLaw::density;
}

}  // namespace

sph::MaterialSpec read_material(TomlTable table) {
  using sph::Model;
  auto material = table.choice("preset", presets, std::optional(&cai_2025_ice))();
  material.model = table.choice("model", words::model, std::optional(material.model));
  material.density = table.number("density_kg_m3", positive, material.density);
  material.young_modulus = table.number("young_modulus_Pa", positive, material.young_modulus);
  const Range poisson{.low = 0, .high = 0.5, .high_excluded = true};
  material.poisson_ratio = table.number("poisson_ratio", poisson, material.poisson_ratio);
  read_pressure(table, material);
  if (material.model == Model::drucker_prager)
    read_plasticity(table, material);
  else
    refuse_keys(table, drucker_prager_keys, Model::drucker_prager);
  if (material.model == Model::rate_dependent)
    read_rate_dependence(table, material.rate_dependent);
  else
    refuse_keys(table, rate_dependent_keys, Model::rate_dependent);
  if (material.model == Model::neo_hookean)
    material.kelvin_voigt = table.number("kelvin_voigt", not_negative, material.kelvin_voigt);
  else
    refuse_keys(table, neo_hookean_keys, Model::neo_hookean);
  table.refuse_unknown_keys();
  return material;
}

}  // namespace nilas::cases
