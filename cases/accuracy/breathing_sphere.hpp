// The breathing modes of a free elastic sphere: the exact solution that V15 is measured against.
#pragma once

namespace nilas::cases {

/// First root x = k R of the breathing modes (Lamb 1882), x cot x = 1 - x^2 (c_p/c_s)^2/4, for Poisson's ratio nu in
/// [0, 0.5). Round-off accurate.
double breathing_root(double nu);

}  // namespace nilas::cases
