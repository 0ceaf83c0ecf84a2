#include "cases/accuracy/accuracy_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "cases/accuracy/accuracy_report.hpp"
#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/economies.hpp"
#include "cases/accuracy/grid_study.hpp"
#include "cases/accuracy/ice_table.hpp"
#include "cases/accuracy/schemes.hpp"
#include "cases/nearest.hpp"
#include "cases/plot_script.hpp"
#include "cases/run.hpp"
#include "cases/scene.hpp"

namespace nilas::cases {

namespace {

/// "V9" names V9-elastic-pulse, not V9x: the whole name or what stands before a hyphen.
bool names(const std::string& word, const std::string& name) { return word == name || name.starts_with(word + "-"); }

template <class Named>
std::vector<Named> select(const std::vector<Named>& all, const std::vector<std::string>& words, const char* what) {
  if (words.empty()) return all;
  std::vector<std::string> known;
  for (const Named& named : all) known.push_back(named.name);
  for (const std::string& word : words)
    if (std::none_of(known.begin(), known.end(), [&](auto& name) { return names(word, name); }))
      throw SceneError("no " + std::string(what) + " " + word + "; did you mean " + nearest(word, known) +
                       "? allowed: the names that nilas accuracy --list prints");
  std::vector<Named> chosen;
  for (const Named& named : all)
    if (std::any_of(words.begin(), words.end(), [&](auto& word) { return names(word, named.name); }))
      chosen.push_back(named);
  return chosen;
}

void make_directory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw IoError("cannot create " + path.string() + ": " + error.message());
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw IoError("cannot write " + file.string());
}

bool run_cases(const AccuracyOptions& options, std::ostream& out) {
  StudyPlan plan;
  plan.cases = select(verification_cases(), options.cases, "case");
  plan.schemes = select(schemes_under_test(), options.schemes, "option");
  plan.quick = options.quick;
  plan.jobs = options.jobs;
  make_directory(options.out);
  const auto rows = run_study(plan, [&](const std::string& line) { out << line << std::endl; });
  write_accuracy_csv(rows, options.out / "accuracy.csv");
  std::ostringstream report;
  print_accuracy_table(rows, false, report);
  print_scheme_comparison(rows, report);
  write_text(options.out / "accuracy.md", report.str());
  out << "\n" << report.str() << "\nresults: " << options.out.string() << std::endl;
  try {
    run_plot_script("accuracy.py", {options.out.string()});
  } catch (const IoError& error) {  // the numbers are written: a missing picture does not undo them
    out << error.what() << std::endl;
  }
  return std::all_of(rows.begin(), rows.end(), [&](const AccuracyRow& row) {
    return row.scheme != plan.schemes.front().name || row.pass.value_or(true);
  });
}

bool run_scene(const AccuracyOptions& options, std::ostream& out) {
  if (options.spacings.empty())
    throw SceneError("--scene needs --spacing; allowed: three or more spacings in m, 0.04,0.03,0.02");
  GridStudyPlan plan{options.scene, options.overrides, options.spacings, {}, options.out, options.interrupted};
  std::sort(plan.spacings.begin(), plan.spacings.end(), std::greater<>());
  if (std::adjacent_find(plan.spacings.begin(), plan.spacings.end()) != plan.spacings.end() || plan.spacings.size() < 3)
    throw SceneError("--spacing: allowed: three or more different spacings in m");
  const auto runs = run_spacings(plan, [&](const std::string& line) { out << line << std::endl; });
  out << "\n";
  print_grid_study(plan, runs, out);
  write_grid_study_csv(runs, options.out / "grid_convergence.csv");
  return std::all_of(runs.begin(), runs.end(), [](auto& run) { return run.finished; });
}

}  // namespace

bool run_accuracy(const AccuracyOptions& options, std::ostream& out) {
  const bool scene = !options.scene.empty() && !options.economies;
  if (!scene && (!options.spacings.empty() || (!options.overrides.empty() && !options.economies)))
    throw SceneError(
        "--spacing goes with --scene SCENE, --set with that or --economies; allowed: --scene SCENE --spacing A,B,C "
        "[--set key=value], or --economies [--scene SCENE] [--set key=value]");
  const int instead = scene + options.ices + options.economies;
  if (instead > 1 || (instead == 1 && !(options.cases.empty() && options.schemes.empty())))
    throw SceneError("allowed: cases with --option, or --scene, or --ices, or --economies; not two of them");
  if (options.economies) {
    EconomiesPlan plan;
    if (!options.scene.empty()) plan.scene = options.scene, plan.overrides.clear();
    plan.overrides.insert(plan.overrides.end(), options.overrides.begin(), options.overrides.end());
    plan.out = options.out, plan.interrupted = options.interrupted;
    return run_economies(plan, out);
  }
  if (options.ices) {
    run_ice_table({options.quick, options.out, options.interrupted}, out);
    return true;
  }
  return scene ? run_scene(options, out) : run_cases(options, out);
}

void list_accuracy_cases(std::ostream& out) {
  for (const VerificationCase& problem : verification_cases())
    out << fmt::format("{:<28} {}\n{:<28} against: {}\n", problem.name, problem.title, "", problem.reference);
  out << "\noptions:";
  for (const Scheme& scheme : schemes_under_test()) out << " \"" << scheme.name << "\"";
  out << "\n";
}

}  // namespace nilas::cases
