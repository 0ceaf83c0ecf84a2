// Reads [ice.material].
#include "cases/material_presets.hpp"
#include "cases/number_text.hpp"
#include "cases/scene_parts.hpp"
#include "cases/scene_words.hpp"

namespace nilas::cases {

namespace {

constexpr Word<sph::MaterialSpec (*)()> presets[] = {{"cai-2025", cai_2025_ice}};

void read_plasticity(TomlTable& table, sph::MaterialSpec& material) {
  material.cohesion = table.number("cohesion_Pa", not_negative, material.cohesion);
  const Range friction{.low = 0, .high = 90, .high_excluded = true};
  material.friction_angle_deg = table.number("friction_angle_deg", friction, material.friction_angle_deg);
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
}

}  // namespace

sph::MaterialSpec read_material(TomlTable table) {
  auto material = table.choice("preset", presets, std::optional(&cai_2025_ice))();
  material.model = table.choice("model", words::model, std::optional(material.model));
  material.density = table.number("density_kg_m3", positive, material.density);
  material.young_modulus = table.number("young_modulus_Pa", positive, material.young_modulus);
  const Range poisson{.low = 0, .high = 0.5, .high_excluded = true};
  material.poisson_ratio = table.number("poisson_ratio", poisson, material.poisson_ratio);
  material.pressure = table.choice("pressure", words::pressure, std::optional(material.pressure));
  if (material.model == sph::Model::drucker_prager) {
    read_plasticity(table, material);
  } else {
    for (const char* key : {"cohesion_Pa", "friction_angle_deg", "dilation_angle_deg", "after_failure",
                            "residual_strength", "softening_strain"})
      table.refuse(key, "allowed only with model = \"drucker-prager\"");
  }
  table.refuse_unknown_keys();
  return material;
}

}  // namespace nilas::cases
