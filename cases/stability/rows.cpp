#include "cases/stability/rows.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "cases/scene.hpp"
#include "cases/stability/row_list.hpp"

namespace nilas::cases {

std::string StabilityRow::name() const {
  std::string text;
  for (const char c : case_name + " " + value) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) || c == '.')
      text += static_cast<char>(std::tolower(letter));
    else if (!text.empty() && text.back() != '-')
      text += '-';
  }
  while (text.ends_with('-')) text.pop_back();
  return text;
}

bool StabilityRow::fits(const std::string& wanted) const {
  const std::string own = name();
  return own == wanted || own.starts_with(wanted + "-");
}

std::vector<StabilityRow> stability_rows() {
  RowList list;
  add_body_rows(list);
  add_impact_rows(list);
  add_ice_rows(list);
  add_numerics_rows(list);
  add_input_rows(list);
  return std::move(list).rows();
}

std::vector<StabilityRow> chosen_rows(const std::vector<std::string>& names, bool quick) {
  std::vector<StabilityRow> rows = stability_rows();
  if (names.empty()) {
    if (quick) std::erase_if(rows, [](const StabilityRow& row) { return !row.quick; });
    return rows;
  }
  for (const std::string& name : names) {
    const auto fits = [&](const StabilityRow& row) { return row.fits(name); };
    if (std::none_of(rows.begin(), rows.end(), fits))
      throw SceneError("stability row " + name + ": allowed: the name of a row or case, as " + rows.front().name());
  }
  std::erase_if(rows, [&](const StabilityRow& row) {
    return std::none_of(names.begin(), names.end(), [&](const std::string& name) { return row.fits(name); });
  });
  return rows;
}

}  // namespace nilas::cases
