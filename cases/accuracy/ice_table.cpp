#include "cases/accuracy/ice_table.hpp"

#include <fmt/format.h>

#include <fstream>

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
const Ice ices[] = {
    {"cai-2025", {"ice.material.preset=cai-2025"}, "predicted", "calibrated on the paper's forces"},
    {"real-ice", {"ice.material.preset=real-ice"}, "softening slip calibrated on it", "predicted"},
};

struct Impact {
  const char* scene;
  double diameter;               // m, of the ball or the HCC
  std::vector<double> spacings;  // m
  const char* end_time;          // the contact is over by then
  const char* reference;
};
const Impact impacts[] = {
    {"ice-ball-on-plate",
     0.061,
     {0.061 / 30, 0.061 / 45, 0.061 / 60},
     "run.end_time_s=7e-4",
     "61 mm ball, 81.2 m/s: experiment 31.58 kN (implied by Cai et al. 2025, Table 2), paper 35.6 to 36.9 kN"},
    {"hcc-90", 0.3, {0.03, 0.02, 0.015}, "run.end_time_s=5e-3", "HCC, 100 m/s, 90 deg: paper 285.3 kN, no experiment"},
};

}  // namespace

void run_ice_table(const IceTablePlan& plan, std::ostream& out) {
  std::filesystem::create_directories(plan.out);
  const auto csv_file = plan.out / "ices.csv";
  std::ofstream csv(csv_file);
  csv << "scene,ice,force,spacing_m,particles,steps,cpu_time_s,force_window_s,peak_force_filtered_N,peak_force_N,"
         "impulse_N_s,impulse_ratio,velocity_loss_m_s,energy_residual,stopped_by\n";
  std::string table =
      "| impact | ice | force is | D/dx | peak, filtered kN | raw kN | impulse / (m v) | loss of speed m/s |\n"
      "|---|---|---|---:|---:|---:|---:|---:|\n";
  std::string convergence =
      "\n| impact | ice | order | extrapolated kN | GCI of the finest |\n|---|---|---:|---:|---:|\n";
  for (const Impact& impact : impacts)
    for (const Ice& ice : ices) {
      const bool ball = &impact == &impacts[0];
      GridStudyPlan grids{impact.scene, ice.overrides, impact.spacings, plan.out / impact.scene / ice.name,
                          plan.interrupted};
      grids.overrides.push_back(impact.end_time);
      if (plan.quick) grids.spacings.pop_back();
      const auto runs = run_spacings(grids, [&](const std::string& line) { out << line << std::endl; });
      const char* status = ball ? ice.on_ball : ice.on_hcc;
      std::vector<double> spacings, peaks;
      for (const SpacingRun& run : runs) {
        const double ratio = ball ? run.impulse / run.momentum_of_ice : 0;
        table +=
            fmt::format("| {} | {} | {} | {:.0f} | {:.1f} | {:.1f} | {} | {} |{}\n", impact.scene, ice.name, status,
                        impact.diameter / run.spacing, 1e-3 * run.peak_force, 1e-3 * run.raw_peak_force,
                        ball ? fmt::format("{:.3f}", ratio) : "", ball ? "" : fmt::format("{:.2f}", run.velocity_loss),
                        run.finished ? "" : " stopped: " + run.stopped_by);
        csv << fmt::format("{},\"{}\",\"{}\",{},{},{},{:.2f},{},{},{},{},{},{},{},\"{}\"\n", impact.scene, ice.name,
                           status, number_text(run.spacing), run.particles, run.steps, run.cpu_time, run.force_window,
                           run.peak_force, run.raw_peak_force, run.impulse, ball ? number_text(ratio) : "",
                           run.velocity_loss, run.energy_residual, run.stopped_by);
        if (run.finished) spacings.push_back(run.spacing), peaks.push_back(1e-3 * run.peak_force);
      }
      if (spacings.size() < 3) continue;
      const GridConvergence c = grid_convergence(spacings, peaks);
      convergence +=
          fmt::format("| {} | {} | {} | {:.1f} | {:.0f} % |\n", impact.scene, ice.name,
                      c.monotone ? fmt::format("{:.2f}", c.order) : "not monotone", c.extrapolated, 100 * c.index);
    }
  out << "\n";
  for (const Impact& impact : impacts) out << impact.scene << ": " << impact.reference << "\n";
  out << "\n" << table << convergence;
  if (!csv.flush()) throw IoError("cannot write " + csv_file.string());
}

}  // namespace nilas::cases
