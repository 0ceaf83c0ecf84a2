// How far a body stands clear of ice: contact presses ice off a surface, but cannot undo a body put into the middle of
// it.
#pragma once

#include "coupling/body.hpp"
#include "sph/ice.hpp"

namespace nilas {

/// Least distance of an ice-particle centre from the body's surface [m], negative inside; infinite where all are
/// farther than a spacing from the sphere around the body.
double clearance(const sph::Ice& ice, const Body& body);

}  // namespace nilas
