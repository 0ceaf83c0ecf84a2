// summary.json: what a run found, in one place.
#pragma once

#include <filesystem>
#include <string>

#include "cases/domain_check.hpp"
#include "cases/recorder.hpp"
#include "cases/run.hpp"
#include "cases/scene.hpp"
#include "coupling/impact.hpp"

namespace nilas::cases {

/// Facts of the run that neither the state nor the recorder knows.
struct RunFacts {
  std::string scene_name;
  std::string stopped_by;
  double wall_time = 0;  // s
  int threads = 0;
  double force_window = 0;               // s
  double coupling_stability_number = 0;  // at the first step, largest over bodies
  std::vector<std::string> warnings;
  DomainReport domain;
};

/// Writes summary.json. Keys carry their unit; design: one object, per-body entries at the top level with one body and
/// under bodies.<name> with more. Throws IoError.
void write_summary(const std::filesystem::path& file, const Scene& scene, const Impact& impact,
                   const Recorder& recorder, const RunFacts& facts);

/// The lines that a run prints at its end.
std::string summary_text(const Scene& scene, const Impact& impact, const Recorder& recorder, const RunFacts& facts);

}  // namespace nilas::cases
