// Finds scenes: files by path, shipped scenes by name.
#include <algorithm>

#include "cases/data_files.hpp"
#include "cases/nearest.hpp"
#include "cases/scene.hpp"
#include "cases/toml_table.hpp"

namespace nilas::cases {

namespace {

std::vector<std::filesystem::path> scene_paths() {
  std::vector<std::filesystem::path> paths;
  if (!std::filesystem::is_directory(scene_directory())) return paths;
  for (const auto& entry : std::filesystem::directory_iterator(scene_directory()))
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace

std::filesystem::path find_scene(const std::string& name_or_path) {
  if (std::filesystem::is_regular_file(name_or_path)) return name_or_path;
  std::vector<std::string> names;
  for (const auto& path : scene_paths()) {
    names.push_back(path.stem().string());
    if (names.back() == name_or_path) return path;
  }
  const std::string wanted = std::filesystem::path(name_or_path).stem().string();
  const std::string near = nearest(wanted, names);
  throw SceneError(name_or_path + ": no such file or shipped scene" +
                   (near.empty() ? "" : "; the nearest shipped scene is " + near));
}

std::vector<ShippedScene> shipped_scenes() {
  std::vector<ShippedScene> scenes;
  for (const auto& path : scene_paths())
    scenes.push_back({path.stem().string(), TomlTable::open(path, {}).text("title", "")});
  return scenes;
}

}  // namespace nilas::cases
