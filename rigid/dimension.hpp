// The check of one dimension of a shape.
#pragma once

namespace nilas::rigid::geometry {

/// Throws std::invalid_argument "<shape>: <dimension> = <value> m, must be positive and finite" unless it is.
void require_positive(const char* shape, const char* dimension, double value_m);

}  // namespace nilas::rigid::geometry
