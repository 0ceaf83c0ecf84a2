// Writes a scene with every default filled in. Doubles are written so that they read back to the last bit.
#include <array>
#include <sstream>

#include "cases/number_text.hpp"
#include "cases/scene.hpp"
#include "cases/scene_parts.hpp"
#include "cases/scene_words.hpp"

namespace nilas::cases {

namespace {

/// A TOML float: with a point or an exponent, so that it is not taken for an integer of 64 bits.
std::string toml_number(double value) {
  const std::string text = number_text(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

class Writer {
 public:
  void section(std::string_view header) { out_ << "\n" << header << "\n"; }
  void raw(std::string_view key, std::string_view value) { out_ << key << " = " << value << "\n"; }
  void number(std::string_view key, double value) { raw(key, toml_number(value)); }
  void flag(std::string_view key, bool value) { raw(key, value ? "true" : "false"); }
  void text(std::string_view key, std::string_view value) { raw(key, toml_string(value)); }
  template <class Numbers>
  void numbers(std::string_view key, const Numbers& values) {
    std::string list;
    for (const double value : values) list += (list.empty() ? "" : ", ") + toml_number(value);
    raw(key, "[" + list + "]");
  }
  void texts(std::string_view key, const std::vector<std::string>& values) {
    std::string list;
    for (const auto& value : values) list += (list.empty() ? "" : ", ") + toml_string(value);
    raw(key, "[" + list + "]");
  }
  std::string str() const { return out_.str(); }

 private:
  std::ostringstream out_;
};

void write_fixed(Writer& out, const sph::FixedParts& fixed) {
  std::vector<std::string> parts;
  if (fixed.rim) parts.push_back("rim");
  for (std::size_t i = 0; i < fixed.faces.size(); ++i)
    if (fixed.faces[i]) parts.emplace_back(words::face[i]);
  if (parts.size() > 1)
    out.texts("fixed", parts);
  else
    out.text("fixed", parts.empty() ? "none" : parts.front());
}

void write_piece(Writer& out, const sph::PieceSpec& piece) {
  out.text("shape", words::word_of(words::ice_shape, piece.shape));
  if (piece.shape != sph::IceShape::block) out.number("diameter_m", piece.diameter);
  if (piece.shape == sph::IceShape::disc) out.number("thickness_m", piece.thickness);
  if (piece.shape == sph::IceShape::block) out.numbers("size_m", piece.size);
  if (piece.shape == sph::IceShape::disc) out.number("inner_diameter_m", piece.inner_diameter);
  out.numbers("centre_m", piece.centre);
  out.numbers("velocity_m_s", piece.velocity);
  write_fixed(out, piece.fixed);
}

void write_pressure(Writer& out, const sph::MaterialSpec& material) {
  out.text("pressure", words::word_of(words::pressure, material.pressure));
}

void write_plasticity(Writer& out, const sph::MaterialSpec& material) {
  using sph::AfterFailure;
  out.number("cohesion_Pa", material.cohesion);
  out.number("friction_angle_deg", material.friction_angle_deg);
  out.number("dilation_angle_deg", material.dilation_angle_deg);
  out.text("after_failure", words::word_of(words::after_failure, material.after_failure));
  if (material.after_failure == AfterFailure::plastic) out.number("hardening_modulus_Pa", material.hardening_modulus);
  if (material.after_failure != AfterFailure::softening) return;
  out.number("residual_strength", material.residual_strength);
  out.number("softening_strain", material.softening_strain);
}

void write_rate_dependence(Writer& out, const sph::RateDependentSpec& ice) {
  out.number("strength_at_unit_rate_Pa", ice.strength_at_unit_rate);
  out.number("rate_exponent", ice.rate_exponent);
  out.number("tensile_strength_Pa", ice.tensile_strength);
  out.number("fracture_energy_J_m2", ice.fracture_energy);
  out.number("fracture_toughness_Pa_sqrt_m", ice.fracture_toughness);
  out.number("softening_slip_m", ice.softening_slip);
  out.number("residual_friction_angle_deg", ice.residual_friction_angle_deg);
  out.number("largest_bulking", ice.largest_bulking);
}

void write_material(Writer& out, const sph::MaterialSpec& material) {
  out.section("[ice.material]");
  out.text("model", words::word_of(words::model, material.model));
  out.number("density_kg_m3", material.density);
  out.number("young_modulus_Pa", material.young_modulus);
  out.number("poisson_ratio", material.poisson_ratio);
  switch (material.model) {
    case sph::Model::elastic:
      return write_pressure(out, material);
    case sph::Model::neo_hookean:
      return out.number("kelvin_voigt", material.kelvin_voigt);
    case sph::Model::drucker_prager:
      write_pressure(out, material);
      return write_plasticity(out, material);
    case sph::Model::rate_dependent:
      return write_rate_dependence(out, material.rate_dependent);
  }
}

void write_ice(Writer& out, const Scene& scene) {
  const sph::IceSpec& ice = scene.ice;
  for (std::size_t i = 0; i < ice.pieces.size(); ++i) {
    out.section(ice.pieces.size() == 1 ? "[ice]" : "[[ice]]");
    write_piece(out, scene.whole_sheet ? *scene.whole_sheet : ice.pieces[i]);
    if (i > 0) continue;  // spacing and material are those of the first piece
    out.text("domain", words::word_of(words::domain, scene.whole_sheet.has_value()));
    if (scene.whole_sheet) out.number("domain_diameter_m", ice.pieces[i].diameter);
    out.number("spacing_m", ice.spacing);
    out.number("jitter", ice.jitter);
    std::vector<std::string> periodic;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (ice.periodic[axis]) periodic.emplace_back(words::axis[axis]);
    out.texts("periodic", periodic);
    write_material(out, ice.material);
  }
}

/// A mesh or compound has no words in a scene: no reader makes one.
void write_shape(Writer& out, const rigid::Shape& shape) {
  out.text("shape", rigid::name(shape));
  const auto write_long = [&](const auto& s) {
    out.number("length_m", s.length);
    out.number("diameter_m", s.diameter);
  };
  if (const auto* hcc = std::get_if<rigid::Hcc>(&shape)) {
    write_long(*hcc);
    out.number("nose_length_m", hcc->nose_length);
  } else if (const auto* sphere = std::get_if<rigid::Sphere>(&shape)) {
    out.number("diameter_m", sphere->diameter);
  } else if (const auto* box = std::get_if<rigid::Box>(&shape)) {
    out.numbers("size_m", box->size);
  } else if (const auto* cylinder = std::get_if<rigid::Cylinder>(&shape)) {
    write_long(*cylinder);
  } else if (const auto* capsule = std::get_if<rigid::Capsule>(&shape)) {
    write_long(*capsule);
  } else if (const auto* cone = std::get_if<rigid::Cone>(&shape)) {
    write_long(*cone);
  }
}

/// Whether the body's mass is the one that the reader fills in, which nobody should take for a statement.
bool mass_is_unstated(const rigid::BodySpec& body) {
  if (body.motion != rigid::Motion::fixed && body.motion != rigid::Motion::fixed_path) return false;
  const auto unstated = unstated_mass(body.shape);
  return body.mass.mass == unstated.mass && body.mass.centre_of_mass == unstated.centre_of_mass &&
         body.mass.inertia == unstated.inertia;
}

void write_mass(Writer& out, const rigid::BodySpec& body) {
  if (mass_is_unstated(body)) return;
  out.number("mass_kg", body.mass.mass);
  if (std::holds_alternative<rigid::Hcc>(body.shape))
    out.number("centre_of_mass_from_tip_m", -body.mass.centre_of_mass.z());
  else
    out.numbers("centre_of_mass_m", body.mass.centre_of_mass);
  out.numbers("inertia_kg_m2", body.mass.inertia);
}

void write_body(Writer& out, const rigid::BodySpec& body) {
  using rigid::Motion;
  out.section("[[body]]");
  out.text("name", body.name);
  write_shape(out, body.shape);
  out.number("spacing_m", body.boundary_spacing);
  out.text("motion", words::word_of(words::motion, body.motion));
  write_mass(out, body);
  out.numbers("position_m", body.position);
  const auto& q = body.orientation;
  out.numbers("orientation_wxyz", std::array{q.w(), q.x(), q.y(), q.z()});
  if (body.motion != Motion::fixed) out.numbers("velocity_m_s", body.velocity);
  if (body.motion == Motion::free || body.motion == Motion::fixed_path)
    out.numbers("angular_velocity_rad_s", body.angular_velocity);
}

void write_numerics(Writer& out, const sph::NumericsSpec& numerics) {
  out.section("[numerics]");
  out.number("smoothing_ratio", numerics.smoothing_ratio);
  out.flag("gradient_correction", numerics.gradient_correction);
  out.number("viscosity_alpha", numerics.viscosity_alpha);
  out.number("viscosity_beta", numerics.viscosity_beta);
  out.number("artificial_stress", numerics.artificial_stress);
  out.number("artificial_stress_exponent", numerics.artificial_stress_exponent);
  out.number("density_diffusion", numerics.density_diffusion);
  out.number("density_reinitialisation", numerics.density_reinitialisation);
  out.number("shifting", numerics.shifting);
  out.number("hourglass_control", numerics.hourglass_control);
  out.number("cfl", numerics.cfl);
  out.text("cfl_sound_speed", words::word_of(words::sound_speed, numerics.cfl_sound_speed));
  out.number("max_step_s", numerics.max_step);
  out.number("max_coupling_number", numerics.max_coupling_number);
  out.number("quiet_speed_m_s", numerics.quiet_speed);
  out.number("skin_ratio", numerics.skin_ratio);
  out.text("precision", words::word_of(words::precision, numerics.precision));
  out.number("sound_speed_scale", numerics.sound_speed_scale);
}

void write_contact(Writer& out, const sph::ContactSpec& contact) {
  out.section("[contact]");
  out.number("stiffness", contact.stiffness);
  out.number("damping", contact.damping);
  out.number("tangential_damping", contact.tangential_damping);
  out.number("friction_coefficient", contact.friction_coefficient);
  out.flag("stick", contact.stick);
}

void write_run(Writer& out, const Vec3& gravity, const RunSpec& run, const OutputSpec& output) {
  out.section("[run]");
  out.numbers("gravity_m_s2", gravity);
  out.number("end_time_s", run.end_time);
  out.number("bullet_step_s", run.bullet_step);
  out.number("momentum_bound", run.momentum_bound);
  out.number("angular_momentum_bound", run.angular_momentum_bound);
  out.number("energy_bound", run.energy_bound);
  out.section("[output]");
  out.number("interval_s", output.interval);
  out.number("history_interval_s", output.history_interval);
  out.number("loads_interval_s", output.loads_interval);
  out.number("force_window_s", output.force_window);
}

}  // namespace

std::string write_scene(const Scene& scene) {
  Writer out;
  out.text("title", scene.title);
  out.texts("calibrated", scene.calibrated);
  write_ice(out, scene);
  for (const auto& body : scene.bodies) write_body(out, body);
  write_numerics(out, scene.ice.numerics);
  write_contact(out, scene.ice.contact);
  write_run(out, scene.ice.gravity, scene.run, scene.output);
  return out.str();
}

}  // namespace nilas::cases
