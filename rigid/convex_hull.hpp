// Convex hull of points, as a closed mesh.
#pragma once

#include <vector>

#include "rigid/shape.hpp"

#pragma GCC visibility push(default)

namespace nilas::rigid {

/// The points [m] are first put on a grid of 2^-24 of the hull's largest extent (the precision of a float), on which
/// all tests are exact in integers: the result is convex and without degenerate triangles whatever lies in a line or a
/// plane. Incremental; O(number of points times faces). Throws std::invalid_argument if a point is not finite or the
/// points lie in a plane.
Mesh convex_hull(const std::vector<Vec3>& points);

}  // namespace nilas::rigid

#pragma GCC visibility pop
