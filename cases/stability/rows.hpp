// What `nilas stability` tries: stiff and extreme scenes, each a shipped scene with the overrides that a user could
// type.
#pragma once

#include <string>
#include <vector>

namespace nilas::cases {

struct StabilityRow {
  std::string case_name;               // "body mass"
  std::string value;                   // "1 g"
  std::string scene;                   // a shipped scene
  std::vector<std::string> overrides;  // as after --set
  bool quick = true;                   // part of --quick
  bool must_hold = false;              // a remedy: the options that the messages of its plain row name

  /// "body-mass-1-g": letters and digits of case and value, the rest as single hyphens. Names its run directory.
  std::string name() const;
  /// Whether `wanted` is its name or the beginning of it up to a hyphen: "body-mass" fits all of that case.
  bool fits(const std::string& wanted) const;
};

/// Every row, a remedy right after the row that it is for.
std::vector<StabilityRow> stability_rows();

/// The rows that fit any of `names`, long ones included; without names all, or those of --quick. Throws SceneError for
/// a name that fits none.
std::vector<StabilityRow> chosen_rows(const std::vector<std::string>& names, bool quick);

}  // namespace nilas::cases
