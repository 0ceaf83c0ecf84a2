// Error against run time of what makes a run cheaper: one scene, run plain and with each economy.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace nilas::cases {

/// By default a sheet large enough that each economy means something, and a run that ends when the force is past its
/// peak.
struct EconomiesPlan {
  std::string scene = "hcc-oblique";  // as on the command line; its first body is looked at
  std::vector<std::string> overrides = {"ice.diameter_m=3.6", "run.end_time_s=0.003"};  // in every run
  std::filesystem::path out;  // a run directory per variant, economies.csv and economies.md go here
  std::function<bool()> interrupted;
};

/// Runs every variant on one thread and prints cost, forces and motion, each with its difference from the plain run, as
/// Markdown. A run that stops is a row that says so; an economy that the scene cannot have is left out with its reason.
/// Returns whether all finished. Throws SceneError (nothing written) and IoError.
bool run_economies(const EconomiesPlan& plan, std::ostream& out);

}  // namespace nilas::cases
