// Reads [ice]: pieces, their material, periodic axes.
#include <algorithm>
#include <cmath>

#include "cases/domain.hpp"
#include "cases/number_text.hpp"
#include "cases/scene_parts.hpp"
#include "cases/scene_words.hpp"
#include "sph/kernel.hpp"

namespace nilas::cases {

namespace {

sph::FixedParts read_fixed(TomlTable& table, sph::IceShape shape) {
  sph::FixedParts fixed;
  for (const auto& word : table.texts("fixed")) {
    const auto face = std::find(std::begin(words::face), std::end(words::face), word == "bottom" ? "z-" : word);
    if (face != std::end(words::face))
      fixed.faces[static_cast<std::size_t>(face - std::begin(words::face))] = true;
    else if (word == "rim" && shape == sph::IceShape::disc)
      fixed.rim = true;
    else if (word != "none" || !table.holds_text("fixed"))
      table.fail("fixed",
                 "allowed: \"none\", \"rim\" (of a disc), \"bottom\", or an array of \"x-\", \"x+\", \"y-\", \"y+\", "
                 "\"z-\", \"z+\"");
  }
  return fixed;
}

sph::PieceSpec read_piece(TomlTable& table) {
  using sph::IceShape;
  sph::PieceSpec piece;
  piece.shape = table.choice<IceShape>("shape", words::ice_shape);
  const std::string belongs =
      " does not belong to shape = \"" + std::string(words::word_of(words::ice_shape, piece.shape)) + "\"";
  if (piece.shape == IceShape::block)
    table.refuse("diameter_m", "a diameter" + belongs);
  else
    piece.diameter = table.number("diameter_m", positive);
  if (piece.shape == IceShape::disc)
    piece.thickness = table.number("thickness_m", positive);
  else
    table.refuse("thickness_m", "a thickness" + belongs);
  if (piece.shape == IceShape::block)
    piece.size = table.vector("size_m", positive);
  else
    table.refuse("size_m", "a size" + belongs);
  if (piece.shape == IceShape::disc)
    piece.inner_diameter =
        table.number("inner_diameter_m", {.low = 0, .high = piece.diameter, .high_excluded = true}, 0);
  else
    table.refuse("inner_diameter_m", "a hole" + belongs);
  piece.centre = table.vector("centre_m", any_number, piece.centre);
  piece.velocity = table.vector("velocity_m_s", any_number, piece.velocity);
  piece.fixed = read_fixed(table, piece.shape);
  return piece;
}

double smallest_dimension(const sph::PieceSpec& piece) {
  if (piece.shape == sph::IceShape::block) return piece.size.minCoeff();
  return piece.shape == sph::IceShape::disc ? std::min(piece.diameter, piece.thickness) : piece.diameter;
}

/// Spacing and material are those of the first piece; later pieces may repeat them.
void read_common(TomlTable& table, bool first, sph::IceSpec& ice) {
  if (first) {
    ice.spacing = table.number("spacing_m", positive);
    ice.jitter = table.number("jitter", {.low = 0, .high = 0.5}, ice.jitter);
    ice.material = read_material(table.table("material"));
    return;
  }
  if (table.number("spacing_m", positive, ice.spacing) != ice.spacing)
    table.fail("spacing_m", "allowed: the spacing of the first piece, " + number_text(ice.spacing));
  if (table.number("jitter", {.low = 0, .high = 0.5}, ice.jitter) != ice.jitter)
    table.fail("jitter", "allowed: that of the first piece, " + number_text(ice.jitter));
  if (table.has("material") && read_material(table.table("material")) != ice.material)
    table.fail("material", "allowed: the material of the first piece");
}

void read_periodic(TomlTable& table, bool single, sph::IceSpec& ice) {
  const auto names = table.texts("periodic");
  if (names.empty()) return;
  const sph::PieceSpec& piece = ice.pieces.front();
  if (!single || piece.shape != sph::IceShape::block) table.fail("periodic", "allowed: on a single block only");
  // Two particles must not see each other both directly and across the boundary, listed neighbours included.
  const sph::WendlandC2 kernel(ice.numerics.smoothing_ratio * ice.spacing);
  const double least = 2 * kernel.support_radius() * (1 + ice.numerics.skin_ratio);
  for (const auto& name : names) {
    const auto* found = std::find(std::begin(words::axis), std::end(words::axis), name);
    if (found == std::end(words::axis)) table.fail("periodic", "allowed: an array of \"x\", \"y\", \"z\"");
    const auto axis = found - std::begin(words::axis);
    const double size = piece.size[axis];
    const double cells = size / ice.spacing;
    if (size < least || std::abs(cells - std::round(cells)) > 1e-6)
      table.fail("size_m", "allowed along the periodic axis " + name +
                               ": a whole number of spacings (spacing_m = " + number_text(ice.spacing) +
                               "), at least two kernel radii with skin, " + number_text(least));
    ice.periodic[static_cast<std::size_t>(axis)] = true;
  }
}

}  // namespace

void read_ice(TomlTable& root, sph::IceSpec& ice) {
  auto tables = root.table_or_tables("ice");
  if (tables.empty()) root.fail("ice", "needed; allowed: a table [ice] or several [[ice]]");
  for (auto& table : tables) {
    ice.pieces.push_back(read_piece(table));
    read_common(table, ice.pieces.size() == 1, ice);
    const double smallest = smallest_dimension(ice.pieces.back());
    if (ice.spacing > smallest)
      table.fail("spacing_m", "allowed: at most the smallest dimension of the ice, " + number_text(smallest));
    read_periodic(table, tables.size() == 1, ice);
    for (const char* key : {"domain", "domain_diameter_m"}) table.has(key);  // read_domain, once the bodies are known
    table.refuse_unknown_keys();
  }
}

void read_domain(TomlTable& root, Scene& scene) {
  auto tables = root.table_or_tables("ice");
  for (auto& table : tables) {
    if (!table.choice("domain", words::domain, std::optional(false))) {
      table.refuse("domain_diameter_m", "belongs to domain = \"auto\"");
      continue;
    }
    const sph::PieceSpec& sheet = scene.ice.pieces.front();
    const bool other_part_held =
        std::any_of(sheet.fixed.faces.begin(), sheet.fixed.faces.end(), [](bool face) { return face; });
    if (tables.size() > 1 || sheet.shape != sph::IceShape::disc || sheet.inner_diameter > 0 || other_part_held ||
        sheet.velocity != Vec3::Zero() || scene.ice.gravity != Vec3::Zero())
      table.fail("domain",
                 "allowed: for a single solid disc at rest without gravity, fixed = \"rim\" or \"none\"; \"full\" for "
                 "other ice");
    const double reached = passage(sheet, scene.bodies, scene.run.end_time).reach;
    if (!(reached > 0))
      table.fail("domain", "allowed: if a body enters the sheet before run.end_time_s; else \"full\"");
    const Range beyond_the_rim{.low = 2 * (reached + rim_depth(scene.ice)), .low_excluded = true};
    scene = cut(scene, table.number("domain_diameter_m", beyond_the_rim, domain_diameter(scene)));
  }
}

}  // namespace nilas::cases
