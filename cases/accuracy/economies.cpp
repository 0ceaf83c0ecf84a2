#include "cases/accuracy/economies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include "cases/accuracy/measured_run.hpp"
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
};
const Variant variants[] = {
    {"plain", "plain", {}},
    {"sound speed x 0.7", "scale-0.7", {"numerics.sound_speed_scale=0.7"}},
    {"sound speed x 0.5", "scale-0.5", {"numerics.sound_speed_scale=0.5"}},
    {"sound speed x 0.35", "scale-0.35", {"numerics.sound_speed_scale=0.35"}},
    {"sound speed x 0.25", "scale-0.25", {"numerics.sound_speed_scale=0.25"}},
    {"single precision", "single", {"numerics.precision=single"}},
    {"domain auto", "domain", {"ice.domain=auto"}},
    {"single precision, sound speed x 0.5",
     "single-scale-0.5",
     {"numerics.precision=single", "numerics.sound_speed_scale=0.5"}},
    {"all three", "all", {"ice.domain=auto", "numerics.precision=single", "numerics.sound_speed_scale=0.5"}},
};

struct Quantity {
  const char* name;  // of the column of the table, with unit
  const char* key;   // of the CSV
  double (*value)(const MeasuredRun&);
  double scale;  // SI to the unit of the table
  const char* format;
};
const Quantity quantities[] = {
    {"particles", "particles", [](auto& r) { return static_cast<double>(r.particles); }, 1, "{:.0f}"},
    {"steps", "steps", [](auto& r) { return static_cast<double>(r.steps); }, 1, "{:.0f}"},
    {"CPU s", "cpu_time_s", [](auto& r) { return r.cpu_time; }, 1, "{:.1f}"},
    {"peak, filtered kN", "peak_force_filtered_N", [](auto& r) { return r.peak_force; }, 1e-3, "{:.1f}"},
    {"raw kN", "peak_force_N", [](auto& r) { return r.raw_peak_force; }, 1e-3, "{:.1f}"},
    {"impulse N s", "impulse_N_s", [](auto& r) { return r.impulse; }, 1, "{:.1f}"},
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

std::string table_of(const std::vector<MeasuredRun>& runs) {
  std::string table = "| variant |";
  for (const Quantity& q : quantities) table += fmt::format(" {} |", q.name);
  table += " final speed m/s |\n|---|";
  for (std::size_t n = 0; n <= std::size(quantities); ++n) table += "---:|";
  table += "\n";
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const MeasuredRun &run = runs[k], &plain = runs.front();
    table += fmt::format("| {} |", variants[k].name);
    for (const Quantity& q : quantities)
      table += fmt::format(" {}{} |", fmt::format(fmt::runtime(q.format), q.scale * q.value(run)),
                           k > 0 ? percent(" ({:+.1f} %)", difference(q, run, plain)) : "");
    table += fmt::format(" {:.2f}{} |{}\n", run.final_velocity.norm(),
                         k > 0 ? percent(" ({:.2f} %)", velocity_difference(run, plain)) : "",
                         run.finished ? "" : " stopped: " + run.stopped_by);
  }
  return table;
}

std::string csv_of(const std::vector<MeasuredRun>& runs) {
  std::string csv = "variant,overrides";
  for (const Quantity& q : quantities) csv += fmt::format(",{0},{0}_difference", q.key);
  csv += ",final_velocity_x_m_s,final_velocity_y_m_s,final_velocity_z_m_s,final_velocity_difference,ice,stopped_by\n";
  const auto text = [](const std::optional<double>& value) { return value ? number_text(*value) : ""; };
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const MeasuredRun &run = runs[k], &plain = runs.front();
    csv += fmt::format("\"{}\",\"{}\"", variants[k].name, fmt::join(variants[k].overrides, " "));
    for (const Quantity& q : quantities)
      csv += fmt::format(",{},{}", number_text(q.value(run)), text(difference(q, run, plain)));
    for (const double v : run.final_velocity) csv += fmt::format(",{}", number_text(v));
    csv += fmt::format(",{},\"{}\",\"{}\"\n", text(velocity_difference(run, plain)), run.ice, run.stopped_by);
  }
  return csv;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw IoError("cannot write " + file.string());
}

}  // namespace

bool run_economies(const EconomiesPlan& plan, std::ostream& out) {
  const auto file = find_scene(plan.scene);
  std::vector<Scene> scenes;  // all of them before the first runs: a refusal comes at once
  for (const Variant& variant : variants) {
    auto overrides = plan.overrides;
    overrides.insert(overrides.end(), variant.overrides.begin(), variant.overrides.end());
    scenes.push_back(read_scene(file, overrides));
  }
  std::vector<MeasuredRun> runs;
  for (std::size_t k = 0; k < scenes.size() && !(plan.interrupted && plan.interrupted()); ++k) {
    runs.push_back(measure_run(scenes[k], file.stem().string(), plan.out / variants[k].directory, 1, plan.interrupted));
    out << fmt::format("{}, {}: {} particles, {} steps, {:.0f} CPU s, {}", plan.scene, variants[k].name,
                       runs.back().particles, runs.back().steps, runs.back().cpu_time, runs.back().stopped_by)
        << std::endl;
  }
  if (runs.empty()) return true;
  const MeasuredRun& plain = runs.front();
  const std::string report = fmt::format(
      "{}, ice {}, {:g} mm, peak force over {:g} ms, one thread; in brackets the difference from the plain "
      "run, of the final velocity the length of the difference\n\n{}",
      plan.scene, plain.ice, 1e3 * plain.spacing, 1e3 * plain.force_window, table_of(runs));
  out << "\n" << report;
  write_text(plan.out / "economies.md", report);
  write_text(plan.out / "economies.csv", csv_of(runs));
  return std::all_of(runs.begin(), runs.end(), [](auto& run) { return run.finished; });
}

}  // namespace nilas::cases
