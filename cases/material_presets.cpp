#include "cases/material_presets.hpp"

#include "cases/number_text.hpp"
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
          .after_failure = sph::AfterFailure::fluid,
          .rate_dependent = {}};
}

sph::MaterialSpec real_ice() {
  sph::MaterialSpec ice = cai_2025_ice();
  ice.model = sph::Model::rate_dependent;
  ice.pressure = sph::PressureLaw::density;
  return ice;
}

namespace {

std::string material_name(const sph::MaterialSpec& material) {
  if (material == cai_2025_ice()) return "cai-2025";
  if (material == real_ice()) return "real-ice";
  if (material.model == sph::Model::rate_dependent) return "own rate-dependent";
  if (material.model != sph::Model::drucker_prager) return std::string(words::word_of(words::model, material.model));
  const std::string after =
      " after_failure = " + std::string(words::word_of(words::after_failure, material.after_failure));
  sph::MaterialSpec same = material;
  const sph::MaterialSpec preset = cai_2025_ice();
  same.after_failure = preset.after_failure;
  same.residual_strength = preset.residual_strength;
  same.softening_strain = preset.softening_strain;
  return (same == preset ? "cai-2025 but" : "own drucker-prager,") + after;
}

}  // namespace

std::string ice_name(const sph::IceSpec& ice) {
  const double scale = ice.numerics.sound_speed_scale;
  return material_name(ice.material) +
         (scale == 1 ? "" : ", softened to " + number_text(scale) + " of its sound speeds");
}

std::vector<Calibration> calibrations(const sph::MaterialSpec& material) {
  std::vector<Calibration> fitted;
  if (material.model == sph::Model::drucker_prager && material.after_failure == sph::AfterFailure::fluid)
    fitted.push_back({"after_failure",
                      "after_failure = fluid: found by scanning against the peak forces of Cai et al. 2025, "
                      "not measured on ice"});
  if (material.model == sph::Model::rate_dependent &&
      material.rate_dependent.softening_slip == real_ice().rate_dependent.softening_slip)
    fitted.push_back({"softening_slip_m",
                      "softening_slip_m = 0.0005: fitted to the peak force of one ice-ball test (61 mm at 81.2 m/s); "
                      "everything else that this ice gives is a prediction"});
  return fitted;
}

}  // namespace nilas::cases
