// Parallel loops over particles whose sums do not depend on the number of threads: partial sums of fixed chunks are
// added in order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nilas::sph {

constexpr std::size_t kChunk = 256;

/// Runs body(i, partial) for i in [0, n) and returns the sum of the chunks' partials; Partial needs a default value
/// and operator+=.
template <class Partial, class Body>
Partial chunked_sum(std::size_t n, const Body& body) {
  const std::size_t chunks = (n + kChunk - 1) / kChunk;
  std::vector<Partial> partial(chunks);
#pragma omp parallel for schedule(dynamic, 4)
  for (std::size_t c = 0; c < chunks; ++c) {
    Partial local{};
    const std::size_t end = std::min(n, (c + 1) * kChunk);
    for (std::size_t i = c * kChunk; i < end; ++i) body(i, local);
    partial[c] = local;
  }
  Partial total{};
  for (const Partial& p : partial) total += p;
  return total;
}

}  // namespace nilas::sph
