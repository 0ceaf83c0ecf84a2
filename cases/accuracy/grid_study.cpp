#include "cases/accuracy/grid_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include "cases/number_text.hpp"
#include "cases/run.hpp"
#include "cases/scene.hpp"

namespace nilas::cases {

namespace {

struct Quantity {
  const char* name;
  const char* unit;
  double MeasuredRun::*value;
  double scale;  // SI to the unit
};
constexpr Quantity quantities[] = {{"peak force, filtered", "kN", &MeasuredRun::peak_force, 1e-3},
                                   {"impulse", "N s", &MeasuredRun::impulse, 1},
                                   {"loss of speed", "m/s", &MeasuredRun::velocity_loss, 1},
                                   {"attitude change", "deg", &MeasuredRun::attitude_change, 1}};

/// Boundary particles are refined with the ice, in the proportion that the scene states.
std::vector<std::string> at_spacing(const Scene& stated, std::vector<std::string> overrides, double spacing) {
  overrides.push_back("ice.spacing_m=" + number_text(spacing));
  for (std::size_t k = 0; k < stated.bodies.size(); ++k)
    overrides.push_back("body." + std::to_string(k) +
                        ".spacing_m=" + number_text(spacing * stated.bodies[k].boundary_spacing / stated.ice.spacing));
  return overrides;
}

std::vector<double> values_of(const std::vector<MeasuredRun>& runs, const Quantity& quantity) {
  std::vector<double> values;
  for (const MeasuredRun& run : runs) values.push_back(quantity.scale * run.*quantity.value);
  return values;
}

/// The three finest of the runs, if there are three and all of them finished.
std::optional<GridConvergence> convergence_of(const std::vector<MeasuredRun>& runs, const Quantity& quantity) {
  if (runs.size() < 3) return {};
  const std::vector<MeasuredRun> finest(runs.end() - 3, runs.end());
  if (!std::all_of(finest.begin(), finest.end(), [](auto& run) { return run.finished; })) return {};
  std::vector<double> spacings;
  for (const MeasuredRun& run : finest) spacings.push_back(run.spacing);
  return grid_convergence(spacings, values_of(finest, quantity));
}

}  // namespace

std::vector<MeasuredRun> run_spacings(const GridStudyPlan& plan,
                                      const std::function<void(const std::string&)>& progress) {
  std::vector<MeasuredRun> runs;
  const auto file = find_scene(plan.scene);
  const Scene stated = read_scene(file, plan.overrides);
  std::vector<std::string> overrides = plan.overrides;
  for (std::size_t k = 0; k < plan.spacings.size(); ++k) {
    const double spacing = plan.spacings[k];
    auto own = at_spacing(stated, overrides, spacing);
    if (!plan.end_times.empty()) own.push_back("run.end_time_s=" + number_text(plan.end_times[k]));
    const Scene scene = read_scene(file, own);
    const MeasuredRun result =
        measure_run(scene, file.stem().string(), plan.out / ("spacing-" + number_text(spacing)), 0, plan.interrupted);
    progress(fmt::format("{} at {:g} mm: {} particles, {} steps, {:.0f} CPU s, {}", plan.scene, 1e3 * spacing,
                         result.particles, result.steps, result.cpu_time, result.stopped_by));
    runs.push_back(result);
    if (plan.interrupted && plan.interrupted()) break;
    if (runs.size() == 1) overrides.push_back("output.force_window_s=" + number_text(result.force_window));
  }
  return runs;
}

void print_grid_study(const GridStudyPlan& plan, const std::vector<MeasuredRun>& runs, std::ostream& out) {
  if (runs.empty()) return;
  out << fmt::format("{}, ice {}, peak force over {:g} ms\n\n| quantity | unit |", plan.scene, runs.front().ice,
                     1e3 * runs.front().force_window);
  for (const MeasuredRun& run : runs) out << fmt::format(" {:g} mm |", 1e3 * run.spacing);
  out << " order | extrapolated | GCI of the finest |\n|---|---|";
  for (std::size_t n = 0; n < runs.size() + 3; ++n) out << "---:|";
  out << "\n";
  for (const Quantity& quantity : quantities) {
    out << fmt::format("| {} | {} |", quantity.name, quantity.unit);
    for (const double value : values_of(runs, quantity)) out << fmt::format(" {:.4g} |", value);
    const auto c = convergence_of(runs, quantity);
    if (!c)
      out << " | | not three finished runs |\n";
    else if (c->monotone)
      out << fmt::format(" {:.2f} | {:.4g} | {:.2g} % |\n", c->order, c->extrapolated, 100 * c->index);
    else
      out << fmt::format(" not monotone | | {:.2g} % (3 x spread) |\n", 100 * c->index);
  }
  out << "| CPU time | s |";
  for (const MeasuredRun& run : runs) out << fmt::format(" {:.0f} |", run.cpu_time);
  out << " | | |\n";
  for (const MeasuredRun& run : runs)
    if (!run.finished) out << fmt::format("\nat {:g} mm: {}\n", 1e3 * run.spacing, run.stopped_by);
}

void write_grid_study_csv(const std::vector<MeasuredRun>& runs, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "quantity,unit";
  for (const MeasuredRun& run : runs) out << ",at_" << number_text(run.spacing) << "_m";
  out << ",order,extrapolated,gci\n";
  for (const Quantity& quantity : quantities) {
    out << fmt::format("\"{}\",{}", quantity.name, quantity.unit);
    for (const double value : values_of(runs, quantity)) out << "," << number_text(value);
    const auto c = convergence_of(runs, quantity);
    if (c && c->monotone)
      out << "," << number_text(c->order) << "," << number_text(c->extrapolated) << "," << number_text(c->index)
          << "\n";
    else
      out << ",,," << (c ? number_text(c->index) : "") << "\n";
  }
  if (!out.flush()) throw IoError("cannot write " + file.string());
}

}  // namespace nilas::cases
