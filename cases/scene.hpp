// A scene: the modules' own Specs composed, as read from a TOML file. Nothing is derived here but the cut of a sheet.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "rigid/spec.hpp"
#include "sph/spec.hpp"

namespace nilas::cases {

struct RunSpec {
  double end_time = 0;        // s
  double bullet_step = 1e-4;  // s, step of the Bullet world that hosts free bodies
  // Relative residuals; a run fails when one is exceeded over 50 steps on end.
  double momentum_bound = 1e-10;         // relative; a scene in single precision that states none has 1e-6
  double angular_momentum_bound = 0.01;  // relative
  double energy_bound = 0.05;            // relative
};

struct OutputSpec {
  double interval = 2e-4;       // s, between particle frames in result.h5
  double history_interval = 0;  // s, between rows of history.csv; 0: every step
  double loads_interval = 0;    // s, between rows of loads.csv; 0: every step
  double force_window = 0;      // s, of the moving average; 0: 2.5 spacings / impact speed
};

struct Scene {
  std::string title;  // one line
  sph::IceSpec ice;
  // [ice] domain = "auto" only: the sheet as stated, of which `ice` holds the part that is simulated
  // (cases/domain.hpp).
  std::optional<sph::PieceSpec> whole_sheet;
  std::vector<rigid::BodySpec> bodies;
  RunSpec run;
  OutputSpec output;
  std::vector<std::string> calibrated;  // what in this scene was fitted, and to what; goes into log and summary
  std::vector<std::string> notes;       // warnings found while reading (an infeasible moment of inertia, ...)
  // "file:line", for what shows only once the lattice is there.
  std::string spacing_source;             // of ice.spacing_m
  std::vector<std::string> body_sources;  // of each body's position_m, or of its table
};

/// A mistake in a scene, a --set or the command line. what() is one line: file, line, key, value, what is allowed.
class SceneError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads, completes and checks a scene. `overrides` are "dotted.key=value" with the value in TOML syntax (a bare word
/// that is no TOML value is taken as a string); array elements by index (`body.0.mass_kg=50`).
/// Throws SceneError at the first mistake. Reads only.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// The scene as TOML with every default filled in; reading it gives the same scene to the last bit.
std::string write_scene(const Scene& scene);

/// Path of a scene given by file name or by the name of a shipped scene ("hcc-oblique"). Throws SceneError if neither
/// exists (names the nearest shipped scene).
std::filesystem::path find_scene(const std::string& name_or_path);

struct ShippedScene {
  std::string name;
  std::string title;
};
/// All shipped scenes by name, from the scene directory (installed or source tree).
std::vector<ShippedScene> shipped_scenes();

}  // namespace nilas::cases
