// The ices that nilas ships, the name that a report gives to the ice of a run, and what in an ice was fitted.
#pragma once

#include <string>
#include <vector>

#include "sph/spec.hpp"

namespace nilas::cases {

/// Cai et al. 2025, Table 1, with what the paper's forces on the HCC ask for after failure (`fluid`: a calibration).
sph::MaterialSpec cai_2025_ice();

/// Ice at impact rates (sph/rate_dependent_ice.hpp), elastic constants and density as cai-2025. One constant, the
/// softening slip, was calibrated on one ice-ball test; the rest is from the literature or assumed.
sph::MaterialSpec real_ice();

/// "cai-2025" or "real-ice" if the material is that preset to the last digit; else the model and what tells it apart,
/// marked as not being a preset. Ice with reduced stiffness is named so: ", softened to 0.5 of its sound speeds".
std::string ice_name(const sph::IceSpec& ice);

/// What in this ice was fitted, and to what; each entry begins with the key that it is about.
struct Calibration {
  std::string key;
  std::string text;
};
std::vector<Calibration> calibrations(const sph::MaterialSpec& material);

}  // namespace nilas::cases
