#include "cases/accuracy/accuracy_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "cases/accuracy/front.hpp"
#include "cases/number_text.hpp"
#include "cases/run.hpp"

namespace nilas::cases {

namespace {

template <class Value>
std::string text_or_empty(const std::optional<Value>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "";
}

std::string verdict(const AccuracyRow& row) {
  if (!row.pass) return row.remark;
  return (*row.pass ? "yes" : "**no**") + (row.remark.empty() ? "" : ", " + row.remark);
}

}  // namespace

void print_accuracy_table(const std::vector<AccuracyRow>& rows, bool all_schemes, std::ostream& out) {
  out << fmt::format("| {:<44} | {:<20} | {:>10} | {:>9} | {:>8} | {:>8} | {:>9} | {:>5} | {:>9} | {}\n", "case",
                     "option", "spacing mm", "particles", "steps", "CPU s", "error", "order", "tolerance", "pass |");
  out << "|---|---|---:|---:|---:|---:|---:|---:|---:|---|\n";
  for (const AccuracyRow& row : rows) {
    if (!all_schemes && row.scheme != rows.front().scheme) continue;
    out << fmt::format("| {:<44} | {:<20} | {:>10} | {:>9} | {:>8} | {:>8.2f} | {:>9} | {:>5} | {:>9} | {} |\n",
                       row.problem, row.scheme, row.spacing > 0 ? fmt::format("{:.4g}", 1e3 * row.spacing) : "",
                       row.particles, row.steps, row.cpu_time,
                       std::isfinite(row.error) ? fmt::format("{:.2e}", row.error) : "failed",
                       text_or_empty(row.order, "{:.2f}"), text_or_empty(row.tolerance, "{:g}"), verdict(row));
  }
}

void print_scheme_comparison(const std::vector<AccuracyRow>& rows, std::ostream& out) {
  const auto front = pareto_front(rows);
  if (front.empty()) return;
  out << "\nOn the front of error against CPU time (no other option's run is both cheaper and more accurate):\n\n"
      << "| option | metrics on the front | of |\n|---|---:|---:|\n";
  for (const FrontCount& count : front)
    out << fmt::format("| {} | {} | {} |\n", count.scheme, count.on_front, count.metrics);
  out << fmt::format(
      "\nAgainst {} at the same spacing (medians over metrics and resolutions); CPU time to bring a metric down to its "
      "tolerance, by interpolation:\n\n"
      "| option | error ratio | CPU ratio | better by > 10 % | worse | failed | tolerances reached | CPU to tolerance "
      "|\n|---|---:|---:|---:|---:|---:|---:|---:|\n",
      rows.front().scheme);
  for (const Ablation& a : ablation(rows))
    out << fmt::format("| {} | {:.2f} | {:.2f} | {} | {} | {} | {} | {:.2f} |\n", a.scheme, a.error_ratio, a.time_ratio,
                       a.better, a.worse, a.failed, a.reached, a.time_to_tolerance_ratio);
}

void write_accuracy_csv(const std::vector<AccuracyRow>& rows, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "case,option,spacing_m,particles,steps,cpu_time_s,error,order,tolerance,pass\n";
  for (const AccuracyRow& row : rows)
    out << fmt::format("\"{}\",\"{}\",{},{},{},{:.4f},{},{},{},{}\n", row.problem, row.scheme,
                       row.spacing > 0 ? number_text(row.spacing) : "", row.particles, row.steps, row.cpu_time,
                       std::isfinite(row.error) ? number_text(row.error) : "failed",
                       row.order ? number_text(*row.order) : "", row.tolerance ? number_text(*row.tolerance) : "",
                       row.pass ? (*row.pass ? "yes" : "no") : "");
  if (!out.flush()) throw IoError("cannot write " + file.string());
}

}  // namespace nilas::cases
