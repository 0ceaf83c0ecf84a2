// One measurement of whole steps: the impact of `nilas run cai-2025-90` (HCC, 90 degrees, 100 m/s, Drucker-Prager ice)
// on a sheet of 2 cm spacing, with the body's tip half way into it.
#pragma once

#include <map>

#include "tests/benchmarks/machine_probe.hpp"
#include "tests/benchmarks/work.hpp"

namespace nilas::benchmarks {

struct Configuration {
  double particles;  // about: the sheet's diameter is an even number of spacings
  int threads;
  bool single_precision;
};

/// `repetitions` times `steps` steps are timed, after `warm_up` that are not.
struct Effort {
  int steps = 20, warm_up = 10, repetitions = 3;
};

struct Measured {
  Configuration of;
  double particles;
  double diameter, thickness, spacing;  // m
  double dt;                            // s, mean
  double cpu, wall;                     // s per particle-step, medians over the repetitions
  double rebuilds;                      // of the neighbour list, per step
  double ice_bytes;                     // per particle, Ice::bytes
  double resident_bytes;                // per particle: by how much the process grew, at its peak
  Work work;                            // per particle-step
  /// Of the cores asked for, what this process got: below 1 its threads waited, on one thread for other processes.
  double core_share() const { return cpu / (wall * of.threads); }
};

/// Says on stderr if a run on one thread shared its core: wall times, and what follows from them, are then worthless.
void warn_if_busy(const Measured& on_one_thread);

/// In a process of its own.
Measured measure(const Configuration& configuration, const Effort& effort);

/// Limits of the machine by number of threads, each measured when first asked for.
class Probe {
 public:
  const MachineLimits& operator()(int threads);
  const std::map<int, MachineLimits>& all() const { return limits_; }

 private:
  std::map<int, MachineLimits> limits_;
};

}  // namespace nilas::benchmarks
