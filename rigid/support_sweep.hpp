// What the support function of a body tells about its projections, by a sweep of directions around an axis.
#pragma once

#include <functional>
#include <vector>

#include "rigid/shape.hpp"

namespace nilas::rigid::geometry {

/// Point of a body farthest along a unit direction.
using Support = std::function<Vec3(const Vec3& direction)>;

/// Largest distance of the body from the axis (0, 1, 2: along x, y, z) through `centre` [m]: an upper bound, too large
/// by at most 5e-6 of itself.
double farthest_from_axis(const Support& support, int axis, const Vec3& centre);
/// Convex outline of the projection along x, closed (last point = first), in the y-z plane.
std::vector<Vec3> projected_outline(const Support& support);

}  // namespace nilas::rigid::geometry
