// A bar along x whose sides are periodic, so that every strain is uniaxial and waves travel with c_p: the ice of the
// wave cases.
#pragma once

#include <cmath>
#include <cstdint>

#include "cases/scheme.hpp"
#include "sph/ice.hpp"

namespace nilas::cases {

/// Cells along a periodic axis: at least two kernel radii with skin, so that no particle meets two images of another.
inline int cells_across(const sph::NumericsSpec& numerics) {
  return static_cast<int>(std::ceil(4 * numerics.smoothing_ratio * (1 + numerics.skin_ratio)));
}

/// Elastic ice, nu = 0.33, from x = 0 to `length` [m].
inline sph::IceSpec periodic_bar(const Scheme& scheme, double dx, double length) {
  sph::IceSpec ice;
  sph::PieceSpec piece;
  piece.shape = sph::IceShape::block;
  const double across = cells_across(scheme.numerics) * dx;
  piece.size = {length, across, across};
  piece.centre = {length / 2, 0, 0};
  ice.pieces = {piece};
  ice.spacing = dx;
  ice.periodic = {false, true, true};
  ice.material.model = sph::Model::elastic;
  ice.numerics = scheme.numerics;
  ice.contact = scheme.contact;
  return ice;
}

/// Place in order of creation of a particle of the layer nearest to x.
inline std::uint32_t layer_at(const sph::Ice& ice, double x) {
  const auto order = ice.creation_order();
  std::uint32_t nearest = 0;
  const auto away = [&](std::uint32_t k) { return std::abs(ice.particles().motion[order[k]].position[0] - x); };
  for (std::uint32_t k = 0; k < order.size(); ++k)
    if (away(k) < away(nearest)) nearest = k;
  return nearest;
}

}  // namespace nilas::cases
