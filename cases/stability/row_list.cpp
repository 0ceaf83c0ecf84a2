#include "cases/stability/row_list.hpp"

namespace nilas::cases {

void RowList::begin(const std::string& case_name, const std::string& scene, const Overrides& common) {
  case_name_ = case_name;
  scene_ = scene;
  common_ = common;
}

void RowList::add(const std::string& value, const Overrides& overrides) {
  rows_.push_back({case_name_, value, scene_, with(common_, overrides)});
}

void RowList::add_long(const std::string& value, const Overrides& overrides) {
  add(value, overrides);
  rows_.back().quick = false;
}

void RowList::remedy(const Overrides& options) {
  StabilityRow row = rows_.back();
  for (const std::string& option : options) row.value += ", " + option;
  row.overrides = with(row.overrides, options);
  row.must_hold = true;
  rows_.push_back(row);
}

}  // namespace nilas::cases
