// Parallel loops over particles, or groups of them, whose sums do not depend on the number of threads: partial sums of
// fixed chunks are added in order.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace nilas::sph {

constexpr std::size_t kMostChunks = 512;

/// Runs body(i, partial) for i in [0, n) and returns the sum of the chunks' partials; Partial needs a default value
/// and operator+=. smallest: of a chunk.
template <class Partial, class Body>
Partial chunked_sum(std::size_t n, const Body& body, std::size_t smallest = 256) {
  const std::size_t length = std::max(smallest, (n + kMostChunks - 1) / kMostChunks);
  const std::size_t chunks = (n + length - 1) / length;
  std::array<Partial, kMostChunks> partial;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t c = 0; c < chunks; ++c) {
    Partial local{};
    const std::size_t end = std::min(n, (c + 1) * length);
    for (std::size_t i = c * length; i < end; ++i) body(i, local);
    partial[c] = local;
  }
  Partial total{};
  for (std::size_t c = 0; c < chunks; ++c) total += partial[c];
  return total;
}

}  // namespace nilas::sph
