// [ice] domain = "auto": of a sheet that bodies break, the part that matters.
//
// The sheet is cut to a disc about its own middle and closed by an absorbing rim (sph/absorbing_rim.hpp):
//
//     radius = reach + 2 a + thickness + depth of the rim
//
// reach: the farthest from the sheet's middle that a body's surface gets inside the sheet before the end of the run, on
// its straight path, the way along the sheet while it is crossed included. a: half the width of the body across its
// path. The stress about a hole that is driven open falls as (a/r)^2, to a ninth at 3 a; one thickness more, and what
// the faces do to it is evened out (Saint-Venant). README.md has the measured error.
#pragma once

#include <string>
#include <vector>

#include "cases/scene.hpp"

namespace nilas::cases {

/// How bodies go through a sheet, spin and deflection left aside; the largest over the bodies that enter it.
struct Passage {
  double reach = 0;       // m, from the sheet's middle, along it; 0 if no body enters
  double half_width = 0;  // m, from the path of the centre of mass
};
/// `sheet`: a disc.
Passage passage(const sph::PieceSpec& sheet, const std::vector<rigid::BodySpec>& bodies, double end_time);

/// Depth of the absorbing rim, one kernel radius [m].
double rim_depth(const sph::IceSpec& ice);

/// Diameter by the rule above [m], for the scene's sheet or the whole one that it is cut from.
double domain_diameter(const Scene& scene);

/// The scene with its sheet cut to `diameter` [m], rounded up to such a number of spacings that the particles that are
/// left are the whole sheet's. The whole sheet where that is not smaller. An earlier cut is undone first.
Scene cut(Scene scene, double diameter);

/// One line for log and `nilas check`; empty for domain = "full".
std::string describe_domain(const Scene& scene);

}  // namespace nilas::cases
