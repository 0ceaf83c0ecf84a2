// Runs the plotting scripts.
#pragma once

#include <string>
#include <vector>

namespace nilas::cases {

/// Runs a script of the plot directory with the system's Python, arguments passed on unchanged, and returns its exit
/// code (128 + signal if a signal ended it). Throws IoError if the script, the interpreter or one of its modules is
/// missing; names the Debian packages to install.
int run_plot_script(const std::string& script, const std::vector<std::string>& arguments);

}  // namespace nilas::cases
