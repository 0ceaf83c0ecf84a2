#include "sph/terms.hpp"

#include <algorithm>

namespace nilas::sph {

std::vector<std::string> terms_left_out(const IceSpec& spec, bool has_bodies) {
  std::vector<std::string> out;
  const auto add = [&](bool unused, const char* term) {
    if (unused) out.emplace_back(term);
  };
  const auto has_fixed_part = [](const PieceSpec& piece) {
    const auto& faces = piece.fixed.faces;
    return piece.fixed.rim || std::any_of(faces.begin(), faces.end(), [](bool face) { return face; });
  };
  // Models are alternatives; listed are the terms that a model has and this ice does not use.
  const MaterialSpec& material = spec.material;
  const bool drucker_prager = material.model == Model::drucker_prager;
  const bool friction = spec.contact.stick || spec.contact.friction_coefficient > 0;
  add(!spec.numerics.gradient_correction, "kernel-gradient correction (matrices, moment sums)");
  add(spec.numerics.viscosity_alpha == 0 && spec.numerics.viscosity_beta == 0, "artificial viscosity");
  add(spec.numerics.artificial_stress == 0, "artificial stress");
  add(spec.numerics.density_diffusion == 0, "density diffusion");
  add(spec.numerics.density_reinitialisation == 0, "density re-initialisation");
  add(spec.numerics.shifting == 0, "particle shifting");
  add(spec.numerics.hourglass_control == 0, "hourglass control");
  add(spec.numerics.precision == Precision::double_, "single-precision mirrors");
  add(spec.numerics.quiet_speed == 0, "sleep of quiet ice");
  add(spec.gravity == Vec3::Zero(), "gravity");
  add(!drucker_prager && material.model != Model::rate_dependent, "plasticity (plastic strain, failure, return map)");
  add(drucker_prager && material.pressure != PressureLaw::density, "bulking field (pressure from density)");
  add(drucker_prager && material.hardening_modulus == 0, "hardening");
  add(material.model == Model::neo_hookean && material.kelvin_voigt == 0, "Kelvin-Voigt damping");
  add(std::none_of(spec.periodic.begin(), spec.periodic.end(), [](bool axis) { return axis; }), "periodic images");
  add(!has_bodies, "contact");
  add(has_bodies && !friction, "friction");
  add(std::none_of(spec.pieces.begin(), spec.pieces.end(), has_fixed_part), "fixed parts");
  const bool disc = spec.pieces.size() == 1 && spec.pieces[0].shape == IceShape::disc;  // others cannot have one
  add(disc && !spec.pieces[0].absorbing_rim, "absorbing rim");
  return out;
}

}  // namespace nilas::sph
