// One row of `nilas stability`, run as a user would: a process `nilas run SCENE --set ...`, so that its outcome is what
// the user would see and a crash ends no other row.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>

#include "cases/stability/rows.hpp"

namespace nilas::cases {

/// held     ran to its end with closed books: nothing non-finite written, no energy made, no ice leaked into a body
/// refused  one line that says what is allowed, nothing written (exit code 2)
/// stopped  a diagnosis in dump.txt and on stderr, nothing non-finite written (exit code 3)
/// failed   anything else, and a remedy that does not hold: an error of nilas
enum class StabilityOutcome { held, refused, stopped, failed };
const char* name(StabilityOutcome outcome);

struct StabilityResult {
  StabilityOutcome outcome = StabilityOutcome::failed;
  std::string message;  // one line
  double cpu_seconds = 0;
  // From the run's summary; none where no run took place.
  std::optional<double> energy_growth;    // largest energy over what was put in
  std::optional<double> ledger_residual;  // the largest of the three relative residuals at the end
  std::optional<double> penetration;      // m
  std::optional<double> step;             // s, the last
};

/// Starts the row with one thread in `directory`/runs/<name of the row>, which is emptied. Throws IoError.
pid_t start_row(const std::filesystem::path& program, const StabilityRow& row, const std::filesystem::path& directory);

/// What the ended process left. `status`, `usage`: from wait4.
StabilityResult judge_row(const StabilityRow& row, const std::filesystem::path& directory, int status,
                          const rusage& usage);

}  // namespace nilas::cases
