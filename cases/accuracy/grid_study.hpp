// A scene without an exact answer, run at several spacings: Richardson extrapolation and grid convergence index.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "cases/accuracy/convergence.hpp"
#include "cases/accuracy/measured_run.hpp"

namespace nilas::cases {

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
std::vector<MeasuredRun> run_spacings(const GridStudyPlan& plan,
                                      const std::function<void(const std::string&)>& progress);

/// The runs, and from the last three, if all finished, order, extrapolated value and GCI of peak force, impulse, loss
/// of velocity and attitude change. Markdown.
void print_grid_study(const GridStudyPlan& plan, const std::vector<MeasuredRun>& runs, std::ostream& out);

/// The same numbers as grid_convergence.csv: quantity, unit, one column per spacing, order, extrapolated, gci.
void write_grid_study_csv(const std::vector<MeasuredRun>& runs, const std::filesystem::path& file);

}  // namespace nilas::cases
