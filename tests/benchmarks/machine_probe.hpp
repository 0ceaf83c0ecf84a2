// What this machine can do at most, measured: memory bandwidth by the STREAM triad (McCalpin 1995) and arithmetic by
// independent fused multiply-adds that stay in registers. Both take the best of several repetitions: a limit, not a
// mean.
#pragma once

#include <cstddef>

namespace nilas::benchmarks {

struct MachineLimits {
  int threads;
  double triad_GB_s;          // counted as STREAM does: 24 bytes per element, without the read before the write
  double fma_double_GFLOP_s;  // two per fused multiply-add
  double fma_single_GFLOP_s;
};

/// Bytes of one array of the triad: four times the last-level cache that the system states, at least 128 MiB and at
/// most 1 GiB.
std::size_t triad_array_bytes();

/// Uses 32-byte vectors and fused multiply-add as the pair loops do, where the processor has them; else 16-byte
/// vectors, multiplication and addition apart.
MachineLimits probe_machine(int threads);

}  // namespace nilas::benchmarks
