// From few threads to many: an extrapolation, with its formulas.
//
//   serial fraction  e = (1/S - 1/p) / (1 - 1/p),  S = t(1)/t(p)    Karp and Flatt 1990: Amdahl's law solved for e
//   arithmetic       t = N t1 (e + (1 - e)/p)                       t1: wall time per particle-step on one thread
//   memory           t = N b / B                                    b: bytes per particle-step (work.hpp), B: bandwidth
//   a step           the longer of the two
//
// e holds whatever does not scale, a shared cache or clock included. b is what any code must move at least, so the
// memory's time is a lower bound.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/benchmarks/measured_run.hpp"

namespace nilas::benchmarks {

double serial_fraction(double speed_up, double threads);

struct StepTime {
  double arithmetic, memory;  // s
  double longer() const { return arithmetic > memory ? arithmetic : memory; }
};
/// seconds: wall time per particle-step on one thread; bytes: per particle-step; bandwidth [bytes/s].
StepTime step_time(double particles, double cores, double seconds, double serial, double bytes, double bandwidth);

/// Measures and prints strong scaling (so many particles) and weak scaling (so many per thread), and what 64 cores
/// would take for 100 million particles, the scene's whole sheet to the scene's end. threads: ascending from 1.
/// bandwidth [GB/s]: of the machine extrapolated to; 0: what all threads of this one have.
nlohmann::ordered_json run_scaling(double particles, const std::vector<int>& threads, bool single_precision,
                                   const Effort& effort, double bandwidth, Probe& probe);

}  // namespace nilas::benchmarks
