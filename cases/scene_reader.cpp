// Reads a scene: numerics, contact, run and output here; ice and bodies in their own files.
#include <algorithm>
#include <cmath>

#include "cases/material_presets.hpp"
#include "cases/scene.hpp"
#include "cases/scene_parts.hpp"
#include "cases/scene_words.hpp"
#include "cases/scheme.hpp"
#include "cases/toml_table.hpp"

namespace nilas::cases {

namespace {

constexpr Word<Scheme (*)()> presets[] = {
    {"nilas", nilas_scheme}, {"cai-2025", cai_2025_scheme}, {"cai-2025-alpha1", cai_2025_alpha1_scheme}};

/// A whole number of steps, 0 or more.
int read_count(TomlTable& table, const std::string& key, int usual) {
  const double value = table.number(key, {.low = 0, .high = 1e9}, usual);
  if (value != std::floor(value)) table.fail(key, "allowed: a whole number");
  return static_cast<int>(value);
}

void read_numerics(TomlTable table, sph::NumericsSpec& numerics) {
  numerics.smoothing_ratio = table.number("smoothing_ratio", {.low = 1, .high = 3}, numerics.smoothing_ratio);
  numerics.gradient_correction = table.flag("gradient_correction", numerics.gradient_correction);
  numerics.viscosity_alpha = table.number("viscosity_alpha", not_negative, numerics.viscosity_alpha);
  numerics.viscosity_beta = table.number("viscosity_beta", not_negative, numerics.viscosity_beta);
  numerics.artificial_stress = table.number("artificial_stress", not_negative, numerics.artificial_stress);
  numerics.artificial_stress_exponent =
      table.number("artificial_stress_exponent", positive, numerics.artificial_stress_exponent);
  numerics.density_diffusion = table.number("density_diffusion", not_negative, numerics.density_diffusion);
  numerics.density_reinitialisation = read_count(table, "density_reinitialisation", numerics.density_reinitialisation);
  numerics.shifting = table.number("shifting", {.low = 0, .high = 1}, numerics.shifting);
  numerics.hourglass_control = table.number("hourglass_control", not_negative, numerics.hourglass_control);
  if (numerics.hourglass_control > 0 && !numerics.gradient_correction)
    table.fail("hourglass_control", "allowed: 0 unless gradient_correction = true");
  numerics.cfl = table.number("cfl", {.low = 0, .high = 10, .low_excluded = true}, numerics.cfl);
  numerics.cfl_sound_speed =
      table.choice("cfl_sound_speed", words::sound_speed, std::optional(numerics.cfl_sound_speed));
  numerics.max_step = table.number("max_step_s", not_negative, numerics.max_step);
  numerics.max_coupling_number = table.number("max_coupling_number", not_negative, numerics.max_coupling_number);
  numerics.quiet_speed = table.number("quiet_speed_m_s", not_negative, numerics.quiet_speed);
  numerics.skin_ratio = table.number("skin_ratio", {.low = 0, .high = 1}, numerics.skin_ratio);
  numerics.precision = table.choice("precision", words::precision, std::optional(numerics.precision));
  numerics.sound_speed_scale =
      table.number("sound_speed_scale", {.low = 0, .high = 1, .low_excluded = true}, numerics.sound_speed_scale);
  table.refuse_unknown_keys();
}

void read_contact(TomlTable table, sph::ContactSpec& contact) {
  contact.stiffness = table.number("stiffness", positive, contact.stiffness);
  contact.damping = table.number("damping", not_negative, contact.damping);
  contact.tangential_damping = table.number("tangential_damping", positive, contact.tangential_damping);
  contact.friction_coefficient = table.number("friction_coefficient", not_negative, contact.friction_coefficient);
  contact.stick = table.flag("stick", contact.stick);
  table.refuse_unknown_keys();
}

// A force in single precision is a sum over some twenty packs, each addition rounded by 2^-24: 1e-6 if every rounding
// had the same sign.
constexpr double kSinglePrecisionMomentumBound = 1e-6;

RunSpec read_run(TomlTable table, Vec3& gravity, sph::Precision precision) {
  RunSpec run;
  if (precision == sph::Precision::single) run.momentum_bound = kSinglePrecisionMomentumBound;
  gravity = table.vector("gravity_m_s2", any_number, gravity);
  run.end_time = table.number("end_time_s", positive);
  run.bullet_step = table.number("bullet_step_s", positive, run.bullet_step);
  run.momentum_bound = table.number("momentum_bound", positive, run.momentum_bound);
  run.angular_momentum_bound = table.number("angular_momentum_bound", positive, run.angular_momentum_bound);
  run.energy_bound = table.number("energy_bound", positive, run.energy_bound);
  table.refuse_unknown_keys();
  return run;
}

OutputSpec read_output(TomlTable table) {
  OutputSpec output;
  output.interval = table.number("interval_s", positive, output.interval);
  output.history_interval = table.number("history_interval_s", not_negative, output.history_interval);
  output.loads_interval = table.number("loads_interval_s", not_negative, output.loads_interval);
  output.force_window = table.number("force_window_s", not_negative, output.force_window);
  table.refuse_unknown_keys();
  return output;
}

/// What the ice has of fitted constants, unless the scene says so itself.
void note_calibrations(Scene& scene) {
  for (const Calibration& fitted : calibrations(scene.ice.material))
    if (std::none_of(scene.calibrated.begin(), scene.calibrated.end(),
                     [&](const std::string& text) { return text.starts_with(fitted.key); }))
      scene.calibrated.push_back(fitted.text);
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  TomlTable root = TomlTable::open(file, overrides);
  for (const char* key : {"title", "calibrated", "ice", "body", "impact", "contact", "numerics", "run", "output"})
    root.has(key);
  root.refuse_unknown_keys();  // first: a mistyped section would make others look wrong
  Scene scene;
  scene.title = root.text("title", file.stem().string());
  scene.calibrated = root.texts("calibrated");
  TomlTable numerics = root.table("numerics");
  const Scheme preset = numerics.choice("preset", presets, std::optional(&nilas_scheme))();
  scene.ice.numerics = preset.numerics;
  scene.ice.contact = preset.contact;
  read_numerics(numerics, scene.ice.numerics);
  read_contact(root.table("contact"), scene.ice.contact);
  read_ice(root, scene.ice);
  note_calibrations(scene);
  scene.spacing_source = root.table_or_tables("ice").front().where("spacing_m");
  scene.bodies = read_bodies(root, scene.ice, scene.notes);
  for (const auto& body : root.tables("body")) scene.body_sources.push_back(body.where("position_m"));
  scene.run = read_run(root.table("run"), scene.ice.gravity, scene.ice.numerics.precision);
  scene.output = read_output(root.table("output"));
  read_domain(root, scene);
  return scene;
}

}  // namespace nilas::cases
