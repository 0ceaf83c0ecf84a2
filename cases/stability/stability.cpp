#include "cases/stability/stability.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>

#include "cases/number_text.hpp"
#include "cases/plot_script.hpp"
#include "cases/run.hpp"

namespace nilas::cases {

namespace {

namespace fs = std::filesystem;

struct Ended {
  pid_t child;
  int status;
  rusage usage;
};

Ended wait_for_one() {
  Ended ended{};
  while ((ended.child = wait4(-1, &ended.status, 0, &ended.usage)) == -1)
    if (errno != EINTR) throw IoError(std::string("waiting for a row: ") + std::strerror(errno));
  return ended;
}

std::string cell(const std::optional<double>& value) { return value ? number_text(*value) : ""; }

/// Quoted where the text needs it (RFC 4180).
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

void write_table(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw IoError("cannot write " + file.string());
}

void print(const StabilityRow& row, const StabilityResult& result, std::ostream& log) {
  const auto figure = [](const std::optional<double>& value) { return value ? fmt::format("{:.3g}", *value) : "-"; };
  log << fmt::format("{:<8}{} = {}: energy {}, residual {}, penetration {} m, step {} s, {:.1f} s\n        {}\n",
                     name(result.outcome), row.case_name, row.value, figure(result.energy_growth),
                     figure(result.ledger_residual), figure(result.penetration), figure(result.step),
                     result.cpu_seconds, result.message)
      << std::flush;
}

void print_total(const std::vector<StabilityResult>& results, std::ostream& log) {
  std::map<StabilityOutcome, int> count;
  double seconds = 0;
  for (const StabilityResult& r : results) ++count[r.outcome], seconds += r.cpu_seconds;
  using enum StabilityOutcome;
  log << fmt::format("{} rows: {} held, {} refused, {} stopped, {} failed; {:.0f} s of computing\n", results.size(),
                     count[held], count[refused], count[stopped], count[failed], seconds);
}

void draw(const fs::path& directory, std::ostream& log) {
  std::string reason;
  try {
    if (run_plot_script("stability.py", {directory.string()}) == 0) return;
    reason = "the plot script failed";
  } catch (const IoError& error) {
    reason = error.what();
  }
  log << "no picture: " << reason << "\n";
}

/// The same for readers: Markdown.
std::string stability_table(const std::vector<StabilityRow>& rows, const std::vector<StabilityResult>& results) {
  const auto figure = [](const std::optional<double>& value) { return value ? fmt::format("{:.2g}", *value) : ""; };
  std::string text =
      "| case | value | outcome | energy growth | ledger residual | penetration m | step s | message |\n"
      "|---|---|---|---:|---:|---:|---:|---|\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const StabilityResult& r = results[k];
    std::string message = r.message;
    std::replace(message.begin(), message.end(), '|', '/');
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", rows[k].case_name, rows[k].value, name(r.outcome),
                    figure(r.energy_growth), figure(r.ledger_residual), figure(r.penetration), figure(r.step), message);
  }
  return text;
}

}  // namespace

std::string stability_csv(const std::vector<StabilityRow>& rows, const std::vector<StabilityResult>& results) {
  std::string text = "case,value,outcome,energy_growth,ledger_residual,penetration_m,message\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const StabilityResult& r = results[k];
    text += cell(rows[k].case_name) + "," + cell(rows[k].value) + "," + name(r.outcome) + "," + cell(r.energy_growth) +
            "," + cell(r.ledger_residual) + "," + cell(r.penetration) + "," + cell(r.message) + "\n";
  }
  return text;
}

std::size_t run_stability(const std::vector<StabilityRow>& rows, const StabilityOptions& options, std::ostream& log) {
  StabilityResult not_run;
  not_run.message = "not run";
  std::vector<StabilityResult> results(rows.size(), not_run);
  std::map<pid_t, std::size_t> running;
  std::size_t next = 0;
  while (next < rows.size() || !running.empty()) {
    while (next < rows.size() && running.size() < static_cast<std::size_t>(options.jobs)) {
      running[start_row(options.program, rows[next], options.out)] = next;
      ++next;
    }
    const Ended ended = wait_for_one();
    const auto found = running.find(ended.child);
    if (found == running.end()) continue;
    const std::size_t k = found->second;
    running.erase(found);
    results[k] = judge_row(rows[k], options.out, ended.status, ended.usage);
    print(rows[k], results[k], log);
    write_table(options.out / "stability.csv", stability_csv(rows, results));
  }
  write_table(options.out / "stability.md", stability_table(rows, results));
  print_total(results, log);
  log << "table: " << (options.out / "stability.csv").string() << std::endl;
  draw(options.out, log);
  return static_cast<std::size_t>(std::count_if(
      results.begin(), results.end(), [](const StabilityResult& r) { return r.outcome == StabilityOutcome::failed; }));
}

}  // namespace nilas::cases
