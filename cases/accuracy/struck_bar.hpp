// A rigid mass on the end of an elastic bar in uniaxial stress and strain at once (nu = 0, periodic sides): V20 and
// V21.
#pragma once

#include "cases/scheme.hpp"
#include "rigid/spec.hpp"

namespace nilas::cases {

/// The bar: x from 0 to length [m], whole cells; `fixed`: held beyond x = length, for one kernel radius.
sph::IceSpec elastic_bar(const Scheme& scheme, double length, double spacing, bool fixed);

/// The mass [kg]: a box whose face, wider than the bar, touches the bar's end at x = 0; it moves along x at `speed`.
rigid::BodySpec mass_on_end(const sph::IceSpec& bar, double mass, double speed, rigid::Motion motion);

/// Cells across ice with periodic sides: at least two kernel radii with skin, so that no particle meets two images of
/// another.
int periodic_cells(const sph::NumericsSpec& numerics);

}  // namespace nilas::cases
