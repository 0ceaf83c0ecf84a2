// A scene without an exact answer, run at several spacings: Richardson extrapolation and grid convergence index.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "cases/accuracy/convergence.hpp"

namespace nilas::cases {

/// One run of a scene: what its summary.json says.
struct SpacingRun {
  double spacing = 0;  // m
  std::size_t particles = 0, steps = 0;
  double cpu_time = 0;         // s, all threads
  double force_window = 0;     // s
  double peak_force = 0;       // N, filtered
  double raw_peak_force = 0;   // N
  double impulse = 0;          // N s, magnitude, on the body by the ice
  double momentum_of_ice = 0;  // N s, that the ice came with
  double velocity_loss = 0;    // m/s, of the body's speed
  double attitude_change = 0;  // deg
  double energy_residual = 0;
  double end_time = 0;  // s
  std::string ice;      // name of the material
  std::string stopped_by;
  bool finished = false;
};

struct GridStudyPlan {
  std::string scene;                   // as on the command line
  std::vector<std::string> overrides;  // "key=value"
  std::vector<double> spacings;        // m, coarse to fine
  std::vector<double> end_times = {};  // s, one per spacing; empty: the scene's
  std::filesystem::path out;           // a run directory per spacing goes here
  std::function<bool()> interrupted;
};

/// Runs the scene at every spacing, with the force window of the coarsest. progress(text): one line per run.
/// Throws SceneError, IoError; a run that stops is returned unfinished.
std::vector<SpacingRun> run_spacings(const GridStudyPlan& plan,
                                     const std::function<void(const std::string&)>& progress);

/// The runs, and from the last three, if all finished, order, extrapolated value and GCI of peak force, impulse, loss
/// of velocity and attitude change. Markdown.
void print_grid_study(const GridStudyPlan& plan, const std::vector<SpacingRun>& runs, std::ostream& out);

/// The same numbers as grid_convergence.csv: quantity, unit, one column per spacing, order, extrapolated, gci.
void write_grid_study_csv(const std::vector<SpacingRun>& runs, const std::filesystem::path& file);

}  // namespace nilas::cases
