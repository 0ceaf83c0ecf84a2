// The two shipped ices on the two impacts that have something to be compared with: ice ball and HCC, over the spacing.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

namespace nilas::cases {

struct IceTablePlan {
  bool quick = false;         // the two coarser spacings only
  std::filesystem::path out;  // run directories and ices.csv go here
  std::function<bool()> interrupted;
};

/// Runs ice-ball-on-plate and hcc-90 with the ices cai-2025 and real-ice, and prints peaks in fixed windows, impulse
/// ratios and convergence as Markdown. The table names what was calibrated on which number. Throws SceneError, IoError.
void run_ice_table(const IceTablePlan& plan, std::ostream& out);

}  // namespace nilas::cases
