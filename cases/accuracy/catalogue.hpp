// All verification cases, by the numbers V1-V41 of the project's physics reference.
#pragma once

#include "cases/accuracy/verification_case.hpp"

namespace nilas::cases {

// Waves and vibration.
VerificationCase elastic_pulse();  // V9

/// Every case, in the order of the numbers.
std::vector<VerificationCase> verification_cases();

}  // namespace nilas::cases
