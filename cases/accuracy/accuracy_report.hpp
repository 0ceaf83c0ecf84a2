// Writes what `nilas accuracy` measured: the table, accuracy.csv, and the settings on the front.
#pragma once

#include <filesystem>
#include <ostream>

#include "cases/accuracy/study.hpp"

namespace nilas::cases {

/// The table as Markdown: one line per metric and resolution, of the first scheme only or of all.
void print_accuracy_table(const std::vector<AccuracyRow>& rows, bool all_schemes, std::ostream& out);

/// Fronts and ablation as Markdown; nothing if only one scheme ran.
void print_scheme_comparison(const std::vector<AccuracyRow>& rows, std::ostream& out);

/// Columns case, option, spacing_m, particles, steps, cpu_time_s, error, order, tolerance, pass. What does not apply is
/// empty; an error that is not finite is "failed". Throws IoError.
void write_accuracy_csv(const std::vector<AccuracyRow>& rows, const std::filesystem::path& file);

}  // namespace nilas::cases
