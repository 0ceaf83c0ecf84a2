// `nilas accuracy`: what is run, where the results go.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace nilas::cases {

struct AccuracyOptions {
  std::vector<std::string> cases;    // names or their beginnings ("V9"); empty: all
  std::vector<std::string> schemes;  // names of options; empty: all
  bool quick = false;
  std::filesystem::path out = "accuracy";
  int jobs = 1;
  // Instead of the cases: a scene over spacings, the table of the two ices, or what economies cost on a scene.
  std::string scene;
  std::vector<std::string> overrides;
  std::vector<double> spacings;
  bool ices = false;
  bool economies = false;
  std::function<bool()> interrupted;
};

/// Runs and writes accuracy.csv, accuracy.md and pareto.png (cases), or grid_convergence.csv (scene), ices.csv, or
/// economies.csv into `out`. Returns whether every tolerance held and every run finished. Throws SceneError (an unknown
/// case or option, nothing written), IoError.
bool run_accuracy(const AccuracyOptions& options, std::ostream& out);

/// Names and titles, one line each.
void list_accuracy_cases(std::ostream& out);

}  // namespace nilas::cases
