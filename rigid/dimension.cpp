#include "rigid/dimension.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace nilas::rigid::geometry {

void require_positive(const char* shape, const char* dimension, double value_m) {
  if (std::isfinite(value_m) && value_m > 0) return;
  std::ostringstream message;
  message << shape << ": " << dimension << " = " << value_m << " m, must be positive and finite";
  throw std::invalid_argument(message.str());
}

}  // namespace nilas::rigid::geometry
