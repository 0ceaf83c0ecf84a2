// Fills pieces of ice with particles on a cubic lattice.
#pragma once

#include <functional>

#include "sph/particles.hpp"
#include "sph/spec.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

/// Initial velocity [m/s] at a position [m], added to the piece's own; empty: none.
using VelocityField = std::function<Vec3(const Vec3&)>;

/// What the ice is like at the start beyond its spec.
struct InitialState {
  VelocityField velocity = {};  // empty: none
  std::function<bool(const Vec3& position)> keep =
      {};  // lattice sites for which it is false stay empty; empty: keep all
  std::function<Vec3(const Vec3& position)> displacement =
      {};  // m, of particles that are not held from their lattice sites; the ice is still free of stress; empty: none
};

/// Extent of a piece's bounding box [m].
Vec3 extent(const PieceSpec& piece);

/// Number of particles that `lattice` would make, without making them: exact for blocks, within 2 % for the others.
double estimated_particles(const IceSpec& spec);

/// Cell-centred lattice, symmetric about the centre of every piece: n = round(extent / spacing) cells along each axis
/// (at least one); discs and spheres keep the cells whose centre lies inside. Held: particles within one kernel radius
/// 2h of a fixed rim or face, at the lattice site. With `jitter` every particle that is not held is then displaced
/// along each axis by a random share of it, the same one in every run. Stress-free, density as specified.
/// Throws std::invalid_argument if a piece gets no particle or pieces overlap by more than half a spacing.
Particles lattice(const IceSpec& spec, const InitialState& initial = {});

}  // namespace nilas::sph

#pragma GCC visibility pop
