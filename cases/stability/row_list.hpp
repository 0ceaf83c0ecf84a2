// How the rows of `nilas stability` are written down.
#pragma once

#include "cases/stability/rows.hpp"

namespace nilas::cases {

using Overrides = std::vector<std::string>;

class RowList {
 public:
  /// The rows that follow: their case, their scene, and what all of them override.
  void begin(const std::string& case_name, const std::string& scene, const Overrides& common);
  void add(const std::string& value, const Overrides& overrides);
  /// As add, left out of --quick.
  void add_long(const std::string& value, const Overrides& overrides);
  /// The last plain row again, with the options that its message names; must hold.
  void remedy(const Overrides& options);
  std::vector<StabilityRow> rows() && { return std::move(rows_); }

 private:
  std::string case_name_, scene_;
  Overrides common_;
  std::vector<StabilityRow> rows_;
};

// By what is extreme in them.
void add_body_rows(RowList& list);      // mass, inertia, spin
void add_impact_rows(RowList& list);    // speed, angle, overlap, the contact between body and ice
void add_ice_rows(RowList& list);       // stiffness, compressibility, strength, layers, disorder
void add_numerics_rows(RowList& list);  // step, long runs at rest, far away and in a fast frame
void add_input_rows(RowList& list);     // what no scene can mean

/// The HCC under a coarse small sheet with a row of particles above its axis: some seconds of computing.
inline const Overrides kCoarseSheet{"numerics.preset=nilas", "ice.diameter_m=0.8625", "ice.spacing_m=0.0375",
                                    "run.end_time_s=0.0015", "output.interval_s=5e-4"};

/// `common` and then `more`; later overrides win.
inline Overrides with(Overrides common, const Overrides& more) {
  common.insert(common.end(), more.begin(), more.end());
  return common;
}

}  // namespace nilas::cases
