// Ice that a body is in the middle of breaking: the body starts with its tip inside the sheet, in a hole that fits it,
// so that contact, failure and rebuilds of the neighbour list are what they are in an impact from the first steps on.
#pragma once

#include "coupling/impact.hpp"

namespace nilas::benchmarks {

/// The body is pushed `depth` [m] along its velocity; ice closer than half a spacing to it, or inside, is left out.
Impact struck(const sph::IceSpec& ice, rigid::BodySpec body, double depth);

/// One step, of the largest stable length.
void step(Impact& impact);

/// Diameter [m] of the disc that has about so many particles, an even number of spacings.
double disc_diameter(double particles, double thickness, double spacing);

/// Pairs of particles closer than `reach` [m] on the lattice of a disc, per particle, each pair counted from both
/// sides.
double pairs_per_particle(double diameter, double thickness, double spacing, double reach);

}  // namespace nilas::benchmarks
