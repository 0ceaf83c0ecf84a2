// One run of a scene, with its cost, for the reports that compare runs.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "cases/scene.hpp"

namespace nilas::cases {

/// What the run's summary.json says; forces and motion are those of the scene's first body.
struct MeasuredRun {
  double spacing = 0;  // m
  std::size_t particles = 0, steps = 0;
  double cpu_time = 0;                 // s, all threads
  double force_window = 0;             // s
  double peak_force = 0;               // N, filtered
  double raw_peak_force = 0;           // N
  double impulse = 0;                  // N s, magnitude, on the body by the ice
  double momentum_of_ice = 0;          // N s, that the ice came with
  double velocity_loss = 0;            // m/s, of the body's speed
  Vec3 final_velocity = Vec3::Zero();  // m/s
  double attitude_change = 0;          // deg
  double energy_residual = 0;
  double end_time = 0;              // s
  double domain_peak_bound = 0;     // relative; 0 where nothing is cut away
  double domain_impulse_bound = 0;  // as that
  std::string ice;                  // name of the material
  std::string stopped_by;
  bool finished = false;
};

/// Runs the scene into `directory`, over a run that is there; threads 0: as many as there are. A run that stops is
/// returned unfinished. Throws SceneError, also for a scene without a body, and IoError.
MeasuredRun measure_run(const Scene& scene, const std::string& name, const std::filesystem::path& directory,
                        int threads, const std::function<bool()>& interrupted);

}  // namespace nilas::cases
