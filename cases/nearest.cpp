#include "cases/nearest.hpp"

#include <algorithm>
#include <numeric>

namespace nilas::cases {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);  // distances of the first i characters of a to every start of b
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  const auto distance = [&](const std::string& candidate) {
    const std::size_t edits = edit_distance(word, candidate);
    return candidate.starts_with(word) ? std::min<std::size_t>(edits, 1) : edits;
  };
  const auto less = [&](const std::string& a, const std::string& b) { return distance(a) < distance(b); };
  const auto best = std::min_element(candidates.begin(), candidates.end(), less);
  return best == candidates.end() ? std::string() : *best;
}

}  // namespace nilas::cases
