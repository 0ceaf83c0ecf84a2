// Where the shipped scenes and the plotting scripts lie.
#pragma once

#include <filesystem>

namespace nilas::cases {

/// share/nilas/scenes beside the executable's directory if it exists (an installation), else the source tree's.
std::filesystem::path scene_directory();
/// As above for share/nilas/plots.
std::filesystem::path plot_directory();

}  // namespace nilas::cases
