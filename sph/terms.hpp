// Which terms a piece of ice leaves out: no memory, no work in any loop.
#pragma once

#include <string>
#include <vector>

#include "sph/spec.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

/// One phrase per term that `spec` does not use. has_bodies: whether anything can touch the ice.
std::vector<std::string> terms_left_out(const IceSpec& spec, bool has_bodies);

}  // namespace nilas::sph

#pragma GCC visibility pop
