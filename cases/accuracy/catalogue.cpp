#include "cases/accuracy/catalogue.hpp"

namespace nilas::cases {

std::vector<VerificationCase> verification_cases() {
  return {
      elastic_pulse(),
  };
}

}  // namespace nilas::cases
