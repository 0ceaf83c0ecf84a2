// Which terms a piece of ice leaves out: no memory, no work in any loop.
#pragma once

#include <string>
#include <vector>

#include "sph/spec.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

/// One phrase per term that `spec` does not use. has_bodies: whether anything can touch the ice.
std::vector<std::string> terms_left_out(const IceSpec& spec, bool has_bodies);

/// Whether any ice of this spec may sleep (quiet_ice.hpp): a quiet speed is stated, and no term works on ice at rest.
bool has_quiet_ice(const IceSpec& spec);

}  // namespace nilas::sph

#pragma GCC visibility pop
