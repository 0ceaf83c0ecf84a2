// Runs a scene from start to end and writes its run directory; or tells beforehand what it would cost.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/scene.hpp"

namespace nilas::cases {

/// A file could not be read or written. what(): path and reason.
class IoError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct RunOptions {
  std::string scene_name;     // for summary and pictures
  std::filesystem::path out;  // run directory; must not exist, or be empty, unless `overwrite`
  bool overwrite = false;
  int threads = 0;                    // 0: all cores
  bool terminal = false;              // progress bar instead of a line every few seconds
  std::function<bool()> interrupted;  // asked after every sub-step; true ends the run; empty: never
};

enum class RunEnd { finished, numerical_failure, ledger_open, interrupted };

struct RunOutcome {
  RunEnd end;
  std::string message;  // one paragraph: what stopped the run, where. Also in dump.txt unless finished or interrupted
};

/// Everything a run does. Progress and log lines go to `log` and to log.txt.
/// Throws SceneError (the directory holds something and `overwrite` is off, or the scene needs more memory than the
/// machine has; nothing written) and IoError.
RunOutcome run(const Scene& scene, const RunOptions& options, std::ostream& log);

/// What `nilas check` prints, without running.
struct Preview {
  std::size_t particles = 0;
  std::size_t boundary_particles = 0;
  double step = 0;          // s, first stable step
  std::string limiter;      // which limit sets it
  double steps = 0;         // estimate to the end time
  double memory_bytes = 0;  // estimate
  double machine_memory_bytes = 0;
  double seconds = 0;                    // estimate of the run on this machine
  double coupling_stability_number = 0;  // largest over bodies and motions, 0 without a free body
  std::vector<std::string> terms_left_out;
  std::vector<std::string> warnings;
};
/// Throws SceneError if the scene needs more memory than the machine has, or leaves no particle.
Preview preview(const Scene& scene);

}  // namespace nilas::cases
