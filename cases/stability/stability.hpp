// `nilas stability`: which stiff and extreme scenes hold, which are refused, which stop, and what they say.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "cases/stability/row_process.hpp"

namespace nilas::cases {

struct StabilityOptions {
  std::filesystem::path out;      // stability.csv, stability.png, runs/<row>
  std::filesystem::path program;  // nilas itself
  int jobs = 2;                   // rows at a time, one thread each
};

/// Runs the rows, prints one line for each as it ends, and writes `out`/stability.csv after each: an end that comes
/// early loses none. Draws the picture beside it; without matplotlib the table is all there is, and a line says so.
/// Returns the number of rows that failed. Throws IoError.
std::size_t run_stability(const std::vector<StabilityRow>& rows, const StabilityOptions& options, std::ostream& log);

/// The table: case,value,outcome,energy_growth,ledger_residual,penetration_m,message. What a row did not get to is
/// empty.
std::string stability_csv(const std::vector<StabilityRow>& rows, const std::vector<StabilityResult>& results);

}  // namespace nilas::cases
