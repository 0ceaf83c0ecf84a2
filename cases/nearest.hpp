// The known word nearest to a mistyped one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nilas::cases {

/// Levenshtein distance: insertions, deletions and substitutions of single characters.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate of least edit distance, the first of several; empty without candidates. A candidate that only goes on
/// where the word ends has distance 1: a unit is easily forgotten (density for density_kg_m3).
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace nilas::cases
