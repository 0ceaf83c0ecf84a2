// How strongly one explicit exchange of force and velocity couples body and ice: the staggered scheme is stable while
// z A dt / m < 2 (z = rho c_p: impedance of the ice), and the error of one exchange is of that order.
#pragma once

#include "coupling/body.hpp"
#include "sph/elastic_constants.hpp"

#pragma GCC visibility push(default)

namespace nilas {

struct StabilityNumber {
  double translation = 0;  // z dt A_f / m, A_f: frontal area along the body's velocity
  double pitch = 0;        // z dt the larger of SUM A (r x n)_k^2 / I_k for k = x, y (body), whole surface in contact
  double roll = 0;         // the same about the body's z axis, plus, with friction, SUM A |r x t|^2
  double largest() const;
};

/// Numbers above this deserve a warning: the exchange is no longer a small correction.
constexpr double kStabilityWarning = 0.1;
/// From here on the exchange can be unstable: once as much of the body is in contact as the number counts.
constexpr double kStabilityLimit = 2;

/// Zero for motions that are locked.
StabilityNumber stability_number(const Body& body, const sph::ElasticConstants& ice, bool friction, double dt);

/// The largest over all bodies and motions, at a step of one second [1/s]: the number of a step is this times the step.
double stability_rate(const std::vector<Body>& bodies, const sph::ElasticConstants& ice,
                      const sph::ContactSpec& contact);

}  // namespace nilas

#pragma GCC visibility pop
