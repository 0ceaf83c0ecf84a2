// The numerics that `nilas accuracy` compares: the preset `nilas`, with one thing changed at a time, and the paper's.
#pragma once

#include <vector>

#include "cases/scheme.hpp"

namespace nilas::cases {

/// The preset `nilas` first.
std::vector<Scheme> schemes_under_test();

}  // namespace nilas::cases
