// NILAS_SCENE_DIR and NILAS_PLOT_DIR: the directories of the source tree, defined by the build.
#include "cases/data_files.hpp"

namespace nilas::cases {

namespace {

std::filesystem::path installed_or(const char* name, const char* source_tree) {
  std::error_code unreadable;  // without /proc there is only the source tree
  const auto executable = std::filesystem::read_symlink("/proc/self/exe", unreadable);
  const auto installed = executable.parent_path().parent_path() / "share" / "nilas" / name;
  if (!unreadable && std::filesystem::is_directory(installed)) return installed;
  return source_tree;
}

}  // namespace

std::filesystem::path scene_directory() { return installed_or("scenes", NILAS_SCENE_DIR); }

std::filesystem::path plot_directory() { return installed_or("plots", NILAS_PLOT_DIR); }

}  // namespace nilas::cases
