#include "cases/material_presets.hpp"

#include "cases/scene_words.hpp"

namespace nilas::cases {

sph::MaterialSpec cai_2025_ice() {
  return {.model = sph::Model::drucker_prager,
          .density = 900,
          .young_modulus = 9.38e9,
          .poisson_ratio = 0.33,
          .pressure = sph::PressureLaw::volumetric_strain,
          .cohesion = 0.58e6,
          .friction_angle_deg = 36,
          .dilation_angle_deg = 12,
          .after_failure = sph::AfterFailure::fluid};
}

std::string ice_name(const sph::MaterialSpec& material) {
  if (material.model == sph::Model::elastic) return "elastic";
  if (material == cai_2025_ice()) return "cai-2025";
  const std::string after =
      " after_failure = " + std::string(words::word_of(words::after_failure, material.after_failure));
  sph::MaterialSpec same = material;
  const sph::MaterialSpec preset = cai_2025_ice();
  same.after_failure = preset.after_failure;
  same.residual_strength = preset.residual_strength;
  same.softening_strain = preset.softening_strain;
  return (same == preset ? "cai-2025 but" : "own drucker-prager,") + after;
}

}  // namespace nilas::cases
