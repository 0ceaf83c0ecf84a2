#include "cases/accuracy/economies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include "cases/accuracy/measured_run.hpp"
#include "cases/domain.hpp"
#include "cases/number_text.hpp"
#include "cases/run.hpp"
#include "cases/scene.hpp"

namespace nilas::cases {

namespace {

/// A way to run a scene; the first is the one that the others are measured against.
struct Variant {
  const char* name;
  const char* directory;
  std::vector<std::string> overrides;
  double domain = 1;  // share of the diameter that domain = "auto" finds
};
const Variant variants[] = {
    {"plain", "plain", {}},
    {"sound speed x 0.7", "scale-0.7", {"numerics.sound_speed_scale=0.7"}},
    {"sound speed x 0.5", "scale-0.5", {"numerics.sound_speed_scale=0.5"}},
    {"sound speed x 0.35", "scale-0.35", {"numerics.sound_speed_scale=0.35"}},
    {"sound speed x 0.25", "scale-0.25", {"numerics.sound_speed_scale=0.25"}},
    {"domain auto", "domain", {"ice.domain=auto"}},
    {"domain auto x 0.75", "domain-0.75", {"ice.domain=auto"}, 0.75},
    {"domain auto x 0.5", "domain-0.5", {"ice.domain=auto"}, 0.5},
    {"single precision", "single", {"numerics.precision=single"}},
    {"domain auto + single", "domain-single", {"ice.domain=auto", "numerics.precision=single"}},
    {"domain auto + single + sound speed x 0.5",
     "all",
     {"ice.domain=auto", "numerics.precision=single", "numerics.sound_speed_scale=0.5"}},
};

struct Row {
  const Variant* variant;
  std::vector<std::string> overrides;
  Scene scene;
  MeasuredRun run;
};

struct Quantity {
  const char* name;  // of the column of the table, with unit
  const char* key;   // of the CSV
  double (*value)(const MeasuredRun&);
  double scale;  // SI to the unit of the table
  const char* format;
  double (*bound)(const MeasuredRun&) = nullptr;  // relative, on what the cut of the domain changes; 0: none known
};
const Quantity quantities[] = {
    {"particles", "particles", [](auto& r) { return static_cast<double>(r.particles); }, 1, "{:.0f}"},
    {"steps", "steps", [](auto& r) { return static_cast<double>(r.steps); }, 1, "{:.0f}"},
    {"CPU s", "cpu_time_s", [](auto& r) { return r.cpu_time; }, 1, "{:.1f}"},
    {"peak, filtered kN", "peak_force_filtered_N", [](auto& r) { return r.peak_force; }, 1e-3, "{:.1f}",
     [](auto& r) { return r.domain_peak_bound; }},
    {"raw kN", "peak_force_N", [](auto& r) { return r.raw_peak_force; }, 1e-3, "{:.1f}"},
    {"impulse N s", "impulse_N_s", [](auto& r) { return r.impulse; }, 1, "{:.1f}",
     [](auto& r) { return r.domain_impulse_bound; }},
    {"attitude change deg", "attitude_change_deg", [](auto& r) { return r.attitude_change; }, 1, "{:.4f}"},
};

constexpr double kRoundOff = 1e-9;  // in SI and degrees: a share of less than this means nothing

std::optional<double> share(double difference, double plain) {
  return std::abs(plain) > kRoundOff ? std::optional(difference / plain) : std::nullopt;
}
std::optional<double> difference(const Quantity& quantity, const MeasuredRun& run, const MeasuredRun& plain) {
  return share(quantity.value(run) - quantity.value(plain), quantity.value(plain));
}
/// Of the final velocities, as vectors.
std::optional<double> velocity_difference(const MeasuredRun& run, const MeasuredRun& plain) {
  return share((run.final_velocity - plain.final_velocity).norm(), plain.final_velocity.norm());
}

std::string percent(const char* format, const std::optional<double>& difference) {
  return difference ? fmt::format(fmt::runtime(format), 100 * *difference) : "";
}
/// " (+1.2 %)", and the bound if the run has one.
std::string compared(const Quantity& quantity, const MeasuredRun& run, const MeasuredRun& plain) {
  const double bound = quantity.bound ? quantity.bound(run) : 0;
  return percent(bound > 0 ? " ({:+.1f} %" : " ({:+.1f} %)", difference(quantity, run, plain)) +
         (bound > 0 ? fmt::format(", bound {:.1f} %)", 100 * bound) : "");
}

std::string table_of(const std::vector<Row>& rows) {
  std::string table = "| variant |";
  for (const Quantity& q : quantities) table += fmt::format(" {} |", q.name);
  table += " final speed m/s |\n|---|";
  for (std::size_t n = 0; n <= std::size(quantities); ++n) table += "---:|";
  table += "\n";
  const MeasuredRun& plain = rows.front().run;
  for (const auto& [variant, overrides, scene, run] : rows) {
    const bool differs = &run != &plain;
    table += fmt::format("| {} |", variant->name);
    for (const Quantity& q : quantities)
      table += fmt::format(" {}{} |", fmt::format(fmt::runtime(q.format), q.scale * q.value(run)),
                           differs ? compared(q, run, plain) : "");
    table += fmt::format(" {:.2f}{} |{}\n", run.final_velocity.norm(),
                         differs ? percent(" ({:.2f} %)", velocity_difference(run, plain)) : "",
                         run.finished ? "" : " stopped: " + run.stopped_by);
  }
  return table;
}

std::string csv_of(const std::vector<Row>& rows) {
  std::string csv = "variant,overrides";
  for (const Quantity& q : quantities) csv += fmt::format(",{0},{0}_difference", q.key);
  csv += ",domain_peak_bound,domain_impulse_bound";
  csv += ",final_velocity_x_m_s,final_velocity_y_m_s,final_velocity_z_m_s,final_velocity_difference,ice,stopped_by\n";
  const auto text = [](const std::optional<double>& value) { return value ? number_text(*value) : ""; };
  const MeasuredRun& plain = rows.front().run;
  for (const auto& [variant, overrides, scene, run] : rows) {
    csv += fmt::format("\"{}\",\"{}\"", variant->name, fmt::join(overrides, " "));
    for (const Quantity& q : quantities)
      csv += fmt::format(",{},{}", number_text(q.value(run)), text(difference(q, run, plain)));
    csv += fmt::format(",{},{}", number_text(run.domain_peak_bound), number_text(run.domain_impulse_bound));
    for (const double v : run.final_velocity) csv += fmt::format(",{}", number_text(v));
    csv += fmt::format(",{},\"{}\",\"{}\"\n", text(velocity_difference(run, plain)), run.ice, run.stopped_by);
  }
  return csv;
}

/// The scenes of all variants, before the first runs: a refusal comes at once. What only an economy cannot have (a
/// domain of a sheet that no body enters) is left out with its reason.
std::vector<Row> rows_of(const EconomiesPlan& plan, const std::filesystem::path& file, std::ostream& out) {
  std::vector<Row> rows;
  for (const Variant& variant : variants) {
    auto overrides = plan.overrides;
    overrides.insert(overrides.end(), variant.overrides.begin(), variant.overrides.end());
    try {
      Scene scene = read_scene(file, overrides);
      if (variant.domain < 1) {
        overrides.push_back("ice.domain_diameter_m=" + number_text(variant.domain * domain_diameter(scene)));
        scene = read_scene(file, overrides);
      }
      rows.push_back({&variant, overrides, scene, {}});
    } catch (const SceneError& error) {
      if (rows.empty()) throw;
      out << variant.name << ": left out: " << error.what() << "\n";
    }
  }
  return rows;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw IoError("cannot write " + file.string());
}

}  // namespace

bool run_economies(const EconomiesPlan& plan, std::ostream& out) {
  const auto file = find_scene(plan.scene);
  std::vector<Row> rows = rows_of(plan, file, out);
  std::size_t done = 0;
  for (; done < rows.size() && !(plan.interrupted && plan.interrupted()); ++done) {
    auto& [variant, overrides, scene, run] = rows[done];
    run = measure_run(scene, file.stem().string(), plan.out / variant->directory, 1, plan.interrupted);
    out << fmt::format("{}, {}: {} particles, {} steps, {:.0f} CPU s, {}", plan.scene, variant->name, run.particles,
                       run.steps, run.cpu_time, run.stopped_by)
        << std::endl;
  }
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(done), rows.end());
  if (rows.empty()) return true;
  const MeasuredRun& plain = rows.front().run;
  std::string scene = plan.scene;
  for (const std::string& override : plan.overrides) scene += " --set " + override;
  const std::string report = fmt::format(
      "{}: ice {}, {:g} mm, peak force over {:g} ms, one thread; in brackets the difference from the plain run, of the "
      "final velocity the length of the difference; bound: what the run itself says the cut changes at most\n\n{}",
      scene, plain.ice, 1e3 * plain.spacing, 1e3 * plain.force_window, table_of(rows));
  out << "\n" << report;
  write_text(plan.out / "economies.md", report);
  write_text(plan.out / "economies.csv", csv_of(rows));
  return std::all_of(rows.begin(), rows.end(), [](auto& row) { return row.run.finished; });
}

}  // namespace nilas::cases
