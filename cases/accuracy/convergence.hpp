// Orders of convergence and the grid convergence index.
#pragma once

#include <optional>
#include <vector>

namespace nilas::cases {

/// Order between two resolutions, ln(e1/e2)/ln(r1/r2). Nothing if an error is zero or not finite.
std::optional<double> observed_order(double coarse_error, double coarse_resolution, double fine_error,
                                     double fine_resolution);

/// What three grids say about the value without grid, after Celik et al. 2008, J. Fluids Eng. 130, 078001
/// (Richardson extrapolation with the observed order, grid convergence index of Roache with a safety factor of 1.25).
struct GridConvergence {
  double order;         // observed
  double extrapolated;  // the value at spacing zero
  double index;         // GCI of the finest grid, relative: the value is uncertain by this share
  /// Whether the three values approach a limit from one side. If not, the order means nothing: the index is then the
  /// spread of the three values with a safety factor of 3, and the extrapolated value is that of the finest grid.
  bool monotone;
};
/// Spacings and values from coarse to fine, three of each, spacings falling.
GridConvergence grid_convergence(const std::vector<double>& spacings, const std::vector<double>& values);

}  // namespace nilas::cases
