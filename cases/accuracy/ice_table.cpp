#include "cases/accuracy/ice_table.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "cases/accuracy/grid_study.hpp"
#include "cases/number_text.hpp"
#include "cases/run.hpp"

namespace nilas::cases {

namespace {

struct Ice {
  const char* name;
  std::vector<std::string> overrides;
  const char* on_ball;  // what its force on the ball is
  const char* on_hcc;
};
// cai-2025 with the numerics that it was calibrated with.
const Ice ices[] = {
    {"cai-2025",
     {"ice.material.preset=cai-2025", "numerics.preset=cai-2025"},
     "predicted",
     "calibrated on the paper's forces"},
    {"real-ice",
     {"ice.material.preset=real-ice", "numerics.preset=nilas"},
     "fitted to it (softening slip)",
     "predicted"},
};

struct Impact {
  const char* scene;
  double diameter;                // m, of the ball or the HCC
  std::vector<double> spacings;   // m
  std::vector<double> end_times;  // s, one per spacing
  double event;                   // s, when the ball has left the plate: the impulse means something from then on
  const char* reference;
};
const Impact impacts[] = {
    {"ice-ball-on-plate",
     0.061,
     {0.061 / 30, 0.061 / 45, 0.061 / 60},
     {1.5e-3, 1.5e-3, 2e-4},
     1.5e-3,
     "61 mm ball, 81.2 m/s: experiment 31.58 kN (implied by Cai et al. 2025, Table 2), paper 35.6 to 36.9 kN"},
    {"hcc-90", 0.3, {0.03, 0.02, 0.015}, {2e-3, 2e-3, 2e-3}, 0, "HCC, 100 m/s, 90 deg: paper 285.3 kN, no experiment"},
};

}  // namespace

void run_ice_table(const IceTablePlan& plan, std::ostream& out) {
  std::filesystem::create_directories(plan.out);
  const auto csv_file = plan.out / "ices.csv";
  std::ofstream csv(csv_file);
  csv << "scene,ice,force,spacing_m,particles,steps,cpu_time_s,end_time_s,force_window_s,peak_force_filtered_N,"
         "peak_force_N,impulse_ratio,energy_residual,stopped_by\n";
  std::string table =
      "| impact | ice | its force is | D/dx | peak, filtered kN | raw kN | impulse / (m v) |\n"
      "|---|---|---|---:|---:|---:|---:|\n";
  std::string convergence =
      "\n| impact | ice | order | extrapolated kN | GCI of the finest |\n|---|---|---:|---:|---:|\n";
  for (const Impact& impact : impacts)
    for (const Ice& ice : ices) {
      const bool ball = &impact == &impacts[0];
      const char* status = ball ? ice.on_ball : ice.on_hcc;
      GridStudyPlan grids{
          impact.scene,    ice.overrides, impact.spacings, impact.end_times, plan.out / impact.scene / ice.name,
          plan.interrupted};
      if (plan.quick) grids.spacings.pop_back();
      const auto runs = run_spacings(grids, [&](const std::string& line) { out << line << std::endl; });
      std::vector<double> spacings, peaks;
      for (const MeasuredRun& run : runs) {
        // The ball brings all the momentum there is; a run that ends before the event does has not seen it all.
        const bool whole = ball && run.end_time >= impact.event;
        const std::string ratio = whole ? fmt::format("{:.3f}", run.impulse / run.momentum_of_ice) : "";
        table += fmt::format("| {} | {} | {} | {:.0f} | {:.1f} | {:.1f} | {} |{}\n", impact.scene, ice.name, status,
                             impact.diameter / run.spacing, 1e-3 * run.peak_force, 1e-3 * run.raw_peak_force, ratio,
                             run.finished ? "" : " stopped: " + run.stopped_by);
        csv << fmt::format("{},\"{}\",\"{}\",{},{},{},{:.2f},{},{},{},{},{},{},\"{}\"\n", impact.scene, ice.name,
                           status, number_text(run.spacing), run.particles, run.steps, run.cpu_time, run.end_time,
                           run.force_window, run.peak_force, run.raw_peak_force, ratio, run.energy_residual,
                           run.stopped_by);
        if (run.finished) spacings.push_back(run.spacing), peaks.push_back(1e-3 * run.peak_force);
      }
      if (spacings.size() < 3) continue;
      const GridConvergence c = grid_convergence(spacings, peaks);
      convergence +=
          fmt::format("| {} | {} | {} | {:.1f} | {:.0f} % |\n", impact.scene, ice.name,
                      c.monotone ? fmt::format("{:.2f}", c.order) : "not monotone", c.extrapolated, 100 * c.index);
    }
  std::ostringstream report;
  for (const Impact& impact : impacts) report << "* `" << impact.scene << "`: " << impact.reference << "\n";
  report << "\n" << table << convergence;
  out << "\n" << report.str();
  std::ofstream page(plan.out / "ices.md");
  page << report.str();
  if (!csv.flush() || !page.flush()) throw IoError("cannot write " + csv_file.string());
}

}  // namespace nilas::cases
