// A preview as text.
#pragma once

#include <ostream>

#include "cases/run.hpp"

namespace nilas::cases {

/// What `nilas check` prints, a few dozen lines.
void print_preview(const Scene& scene, const Preview& preview, std::ostream& out);

}  // namespace nilas::cases
