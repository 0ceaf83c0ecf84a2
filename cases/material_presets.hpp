// The ices that nilas ships, and the name that a report gives to the ice of a run.
#pragma once

#include <string>

#include "sph/spec.hpp"

namespace nilas::cases {

/// Cai et al. 2025, Table 1, with what the paper's forces on the HCC ask for after failure (`fluid`: a calibration).
sph::MaterialSpec cai_2025_ice();

/// "cai-2025" if the material is that preset to the last digit; else the model and what failed ice carries, marked as
/// not being a preset.
std::string ice_name(const sph::MaterialSpec& material);

}  // namespace nilas::cases
