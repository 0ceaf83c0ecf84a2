#include "cases/stability/row_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cases/run.hpp"

namespace nilas::cases {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr rlim_t kMostCpuSeconds = 400;  // of one row: longer is a hang
constexpr double kEnergyBound = 0.05;    // a run's own default bound

fs::path run_directory(const StabilityRow& row, const fs::path& directory) { return directory / "runs" / row.name(); }
fs::path stderr_file(const StabilityRow& row, const fs::path& directory) {
  return directory / "runs" / (row.name() + ".stderr");
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// In the child: replaces it by the program, or leaves with 127.
[[noreturn]] void become(const std::vector<char*>& words, const char* err) {
  const int null = open("/dev/null", O_RDWR);
  const int log = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(null, STDIN_FILENO);
  dup2(null, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  const rlimit cpu{kMostCpuSeconds, kMostCpuSeconds + 5};
  setrlimit(RLIMIT_CPU, &cpu);
  execv(words[0], words.data());
  _exit(127);
}

/// The first written file with a number that is not finite; empty if there is none.
std::string non_finite_file(const fs::path& run) {
  for (const char* file : {"history.csv", "summary.json", "dump.txt"}) {
    std::string text = read_text(run / file);
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    // As numbers are written: "nan" and "inf" also occur in words, "null" is what JSON makes of either.
    for (const char* token : {",nan", ",-nan", ",inf", ",-inf", " nan", " -nan", " inf,", " inf ", " -inf", " null"})
      if (text.find(token) != std::string::npos) return file;
  }
  return {};
}

void take_figures(const fs::path& run, StabilityResult& result, std::string& facts) {
  const Json summary = Json::parse(read_text(run / "summary.json"), nullptr, false);
  if (summary.is_discarded()) return;
  const auto number = [&](const char* key) { return summary.value(key, 0.0); };
  result.energy_growth = number("energy_growth");
  result.ledger_residual =
      std::max({number("momentum_residual"), number("angular_momentum_residual"), number("energy_residual")});
  result.penetration = number("max_penetration_m");
  result.step = number("last_step_s");
  facts = fmt::format("{:.0f} steps limited by {}", number("steps"), summary.value("limited_by", ""));
  if (number("coupling_stability_number") > 0)
    facts += fmt::format(", coupling-stability number {:.3g}", number("coupling_stability_number"));
  if (summary.contains("peak_force_N")) facts += fmt::format(", peak {:.4g} kN", number("peak_force_N") / 1e3);
  for (const Json& warning : summary.value("warnings", Json::array())) {
    const auto text = warning.get<std::string>();
    if (text.find("coupling-stability number") == std::string::npos) facts += "; " + text;  // that one is named above
  }
}

/// Why a run that ended well did not hold; empty if it did.
std::string broken_promise(const StabilityResult& result) {
  if (!result.energy_growth) return "no summary was written";
  if (*result.energy_growth > 1 + kEnergyBound) return "it ended well, but energy was made on the way";
  return {};
}

}  // namespace

const char* name(StabilityOutcome outcome) {
  switch (outcome) {
    case StabilityOutcome::held:
      return "held";
    case StabilityOutcome::refused:
      return "refused";
    case StabilityOutcome::stopped:
      return "stopped";
    case StabilityOutcome::failed:
      return "failed";
  }
  return "";
}

pid_t start_row(const fs::path& program, const StabilityRow& row, const fs::path& directory) {
  std::error_code error;
  fs::remove_all(run_directory(row, directory), error);
  fs::create_directories(directory / "runs", error);
  if (error) throw IoError("cannot create " + (directory / "runs").string() + ": " + error.message());
  std::vector<std::string> words{
      program.string(), "run", row.scene, "--threads", "1", "--out", run_directory(row, directory).string()};
  for (const std::string& o : row.overrides) words.insert(words.end(), {"--set", o});
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string err = stderr_file(row, directory).string();
  const pid_t child = fork();
  if (child == -1) throw IoError("cannot start " + program.string() + ": " + std::strerror(errno));
  if (child == 0) become(pointers, err.c_str());
  return child;
}

StabilityResult judge_row(const StabilityRow& row, const fs::path& directory, int status, const rusage& usage) {
  const fs::path run = run_directory(row, directory);
  StabilityResult result;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  std::string said = read_text(stderr_file(row, directory)), facts;
  std::replace(said.begin(), said.end(), '\n', ' ');
  if (said.starts_with("nilas: ")) said.erase(0, 7);
  while (said.ends_with(' ')) said.pop_back();
  take_figures(run, result, facts);

  const auto fail = [&](const std::string& why) {
    result.outcome = StabilityOutcome::failed;
    result.message = said.empty() ? why : why + ": " + said;
  };
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (WIFSIGNALED(status)) {
    const bool slow = WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL;
    fail(slow ? fmt::format("not done after {} s of computing", kMostCpuSeconds)
              : fmt::format("ended by signal {}", WTERMSIG(status)));
  } else if (code == 2 && !fs::exists(run)) {
    result.outcome = StabilityOutcome::refused;
    result.message = said;
  } else if (code == 3 && fs::exists(run / "dump.txt")) {
    result.outcome = StabilityOutcome::stopped;
    result.message = said;
  } else if (code == 0) {
    result.outcome = StabilityOutcome::held;
    result.message = facts;
    const std::string broken = broken_promise(result);
    if (!broken.empty()) fail(broken);
  } else {
    fail(fmt::format("exit code {}", code));
  }
  const std::string spoiled = non_finite_file(run);
  if (!spoiled.empty()) fail(spoiled + " holds a number that is not finite");
  if (row.must_hold && result.outcome != StabilityOutcome::held) fail("the remedy does not hold");
  return result;
}

}  // namespace nilas::cases
