// A particle went non-finite or ran away, and what is known of it.
#pragma once

#include <stdexcept>
#include <string>

#include "sph/neighbours.hpp"
#include "sph/particles.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

/// what() names particle, position, velocity and neighbours.
class NumericalFailure : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The failure of this particle; `what` says what became of it.
NumericalFailure failure_of(const Particles& particles, const Neighbours& neighbours, const Period& period,
                            std::size_t particle, const std::string& what);

}  // namespace nilas::sph

#pragma GCC visibility pop
