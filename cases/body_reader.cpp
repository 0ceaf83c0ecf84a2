// Reads [[body]] and [impact]: shape, mass, motion, placement.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "cases/scene_parts.hpp"
#include "cases/scene_words.hpp"

namespace nilas::cases {

namespace {

using rigid::Motion;

enum class ShapeWord { hcc, sphere, box, cylinder, capsule, cone };
constexpr Word<ShapeWord> shape_words[] = {{"hcc", ShapeWord::hcc},           {"sphere", ShapeWord::sphere},
                                           {"box", ShapeWord::box},           {"plate", ShapeWord::box},
                                           {"cylinder", ShapeWord::cylinder}, {"capsule", ShapeWord::capsule},
                                           {"cone", ShapeWord::cone}};

std::string read_name(TomlTable& table, const std::vector<rigid::BodySpec>& others) {
  const std::string usual = others.empty() ? "body" : "body-" + std::to_string(others.size() + 1);
  const std::string name = table.text("name", usual);
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), plain))
    table.fail("name", "allowed: letters, digits, - and _");
  for (const auto& other : others)
    if (other.name == name) table.fail("name", "allowed: a name that no other body has; \"" + name + "\" is taken");
  return name;
}

rigid::Shape read_shape(TomlTable& table) {
  const auto word = table.choice<ShapeWord>("shape", shape_words);
  const std::string reason = "does not belong to shape = \"" + table.text("shape") + "\"";
  if (word == ShapeWord::sphere || word == ShapeWord::box) table.refuse("length_m", reason);
  if (word != ShapeWord::hcc) table.refuse("nose_length_m", reason);
  if (word == ShapeWord::box) {
    table.refuse("diameter_m", reason);
    return rigid::Box{table.vector("size_m", positive)};
  }
  table.refuse("size_m", reason);
  const double diameter = table.number("diameter_m", positive);
  if (word == ShapeWord::sphere) return rigid::Sphere{diameter};
  if (word == ShapeWord::capsule) return rigid::Capsule{table.number("length_m", {.low = diameter}), diameter};
  const double length = table.number("length_m", positive);
  if (word == ShapeWord::cone) return rigid::Cone{length, diameter};
  if (word == ShapeWord::cylinder) return rigid::Cylinder{length, diameter};
  const Range nose{.low = 0, .high = length, .low_excluded = true};
  return rigid::Hcc{length, diameter, table.number("nose_length_m", nose)};
}

/// The stated centre of mass, in the geometry frame; the homogeneous body's if none is stated.
Vec3 read_centre_of_mass(TomlTable& table, const rigid::Shape& shape, const Vec3& homogeneous) {
  if (const auto* hcc = std::get_if<rigid::Hcc>(&shape)) {
    table.refuse("centre_of_mass_m", "an hcc states centre_of_mass_from_tip_m instead");
    if (!table.has("centre_of_mass_from_tip_m")) return homogeneous;
    return {0, 0, -table.number("centre_of_mass_from_tip_m", {.low = 0, .high = hcc->length})};
  }
  table.refuse("centre_of_mass_from_tip_m", "allowed for an hcc only; other shapes state centre_of_mass_m");
  const Vec3 centre = table.vector("centre_of_mass_m", any_number, homogeneous);
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(centre[axis]) > rigid::support_point(shape, Vec3::Unit(axis))[axis])
      table.fail("centre_of_mass_m", "allowed: a point inside the body, relative to its centre");
  return centre;
}

rigid::MassProperties read_mass(TomlTable& table, const rigid::Shape& shape, Motion motion) {
  // Of two statements the one on the command line counts: --set body.0.mass_kg=50 replaces the file's density.
  const bool both = table.has("mass_kg") && table.has("density_kg_m3");
  const bool density_set = both && table.where("density_kg_m3") == "--set";
  const bool mass_set = both && table.where("mass_kg") == "--set";
  if (both && density_set == mass_set)
    table.fail("density_kg_m3", "allowed: either density_kg_m3 or mass_kg, not both");
  const bool stated = table.has("mass_kg") && !density_set;
  if (!stated) {
    for (const char* key : {"centre_of_mass_from_tip_m", "centre_of_mass_m", "inertia_kg_m2"})
      if (density_set)
        table.has(key);  // known, and replaced by the density
      else
        table.refuse(key, "allowed only together with mass_kg");
    if (table.has("density_kg_m3")) return rigid::from_density(shape, table.number("density_kg_m3", positive));
    if (motion == Motion::free || motion == Motion::translation_only)
      table.fail("mass_kg", "needed, or density_kg_m3; allowed: a finite number > 0");
    return unstated_mass(shape);
  }
  auto mass = rigid::from_mass(shape, table.number("mass_kg", positive));
  table.has("density_kg_m3");  // a known key, should another one be mistyped
  mass.centre_of_mass = read_centre_of_mass(table, shape, mass.centre_of_mass);
  if (!table.has("inertia_kg_m2")) return mass;
  if (!table.holds_text("inertia_kg_m2"))
    mass.inertia = table.vector("inertia_kg_m2", positive);
  else if (table.text("inertia_kg_m2") != "from geometry")
    table.fail("inertia_kg_m2", "allowed: \"from geometry\" or an array of 3 finite numbers > 0");
  return mass;
}

/// The mass, checked: what matter cannot have is refused, what this shape cannot have is noted.
void read_checked_mass(TomlTable& table, rigid::BodySpec& body, std::vector<std::string>& notes) {
  const char* blamed = "shape";  // of a size that overflows
  try {
    body.mass = read_mass(table, body.shape, body.motion);
    blamed = table.has("inertia_kg_m2") ? "inertia_kg_m2" : table.has("mass_kg") ? "mass_kg" : "density_kg_m3";
    for (const auto& warning : rigid::check(body.mass, body.shape))
      notes.push_back("body " + body.name + ": " + warning);
  } catch (const std::invalid_argument& error) {
    table.fail(blamed, error.what());
  }
}

rigid::Quat read_orientation(TomlTable& table) {
  if (table.has("orientation_wxyz")) {
    table.refuse("axis", "allowed: either axis or orientation_wxyz, not both");
    const auto q = table.numbers("orientation_wxyz", 4, any_number);
    const rigid::Quat orientation(q[0], q[1], q[2], q[3]);
    if (std::abs(orientation.norm() - 1) > 1e-9)
      table.fail("orientation_wxyz", "allowed: a quaternion [w, x, y, z] of length 1");
    return orientation;  // as written, to the last bit
  }
  const Vec3 axis = table.vector("axis", any_number, Vec3::UnitZ());
  if (!(axis.cwiseAbs().maxCoeff() > 0)) table.fail("axis", "allowed: a direction, not the zero vector");
  return rigid::orientation_along((axis / axis.cwiseAbs().maxCoeff()).normalized());
}

/// Where the file says.
void place_by_position(TomlTable& table, rigid::BodySpec& body) {
  body.position = table.vector("position_m", any_number);
  body.orientation = read_orientation(table);
  if (body.motion == Motion::fixed)
    table.refuse("velocity_m_s", "allowed: none, a fixed body is at rest");
  else
    body.velocity = table.vector("velocity_m_s", any_number, Vec3(Vec3::Zero()));
}

struct Sheet {
  double bottom;  // m
  double x, y;    // m, middle
};

Sheet sheet_of(const sph::IceSpec& ice) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (const auto& piece : ice.pieces) {
    const bool disc = piece.shape == sph::IceShape::disc;
    const Vec3 size = disc ? Vec3(piece.diameter, piece.diameter, piece.thickness) : piece.size;
    low = low.cwiseMin(piece.centre - size / 2);
    high = high.cwiseMax(piece.centre + size / 2);
  }
  return {low.z(), (low.x() + high.x()) / 2, (low.y() + high.y()) / 2};
}

/// Below the sheet: axis along the velocity, tip under the middle, `gap` between highest point and bottom face.
void place_by_impact(TomlTable impact, const sph::IceSpec& ice, rigid::BodySpec& body) {
  const double speed = impact.number("speed_m_s", positive);
  const double angle =
      impact.number("angle_deg", {.low = 0, .high = 90, .low_excluded = true}) * std::numbers::pi / 180;
  const double gap = impact.number("gap_m", not_negative);
  impact.refuse_unknown_keys();
  const Vec3 direction(0, angle < std::numbers::pi / 2 ? -std::cos(angle) : 0, std::sin(angle));
  body.velocity = speed * direction;
  body.orientation = rigid::orientation_along(direction);

  const auto from_centre_of_mass = [&](const Vec3& point) {
    return Vec3(body.orientation * (point - body.mass.centre_of_mass));
  };
  const Vec3 up_body = body.orientation.conjugate() * Vec3::UnitZ();
  const Vec3 top = from_centre_of_mass(rigid::support_point(body.shape, up_body));
  const Vec3 tip = from_centre_of_mass({0, 0, rigid::support_point(body.shape, Vec3::UnitZ()).z()});
  const Sheet sheet = sheet_of(ice);
  body.position = {sheet.x - tip.x(), sheet.y - tip.y(), sheet.bottom - gap - top.z()};
}

void read_spin(TomlTable& table, rigid::BodySpec& body) {
  if (body.motion == Motion::free || body.motion == Motion::fixed_path)
    body.angular_velocity = table.vector("angular_velocity_rad_s", any_number, Vec3(Vec3::Zero()));
  else
    table.refuse("angular_velocity_rad_s", "allowed with motion = \"free\" or \"fixed-path\" only");
}

void check_impact(TomlTable& root, const sph::IceSpec& ice) {
  for (const auto& piece : ice.pieces)
    if (piece.shape == sph::IceShape::sphere) root.fail("impact", "allowed under a disc or block of ice only");
}

}  // namespace

std::vector<rigid::BodySpec> read_bodies(TomlTable& root, const sph::IceSpec& ice, std::vector<std::string>& notes) {
  std::vector<rigid::BodySpec> bodies;
  bool impact_waits = root.has("impact");
  if (impact_waits) check_impact(root, ice);
  for (auto& table : root.tables("body")) {
    rigid::BodySpec body;
    body.name = read_name(table, bodies);
    body.shape = read_shape(table);
    body.boundary_spacing = table.number("spacing_m", positive, 0.75 * ice.spacing);
    body.motion = table.choice("motion", words::motion, std::optional(Motion::free));
    read_checked_mass(table, body, notes);
    if (impact_waits && body.motion != Motion::fixed) {
      for (const char* key : {"position_m", "axis", "orientation_wxyz", "velocity_m_s"})
        table.refuse(key, "[impact] places this body; allowed: one of the two");
      place_by_impact(root.table("impact"), ice, body);
      impact_waits = false;
    } else {
      place_by_position(table, body);
    }
    read_spin(table, body);
    table.refuse_unknown_keys();
    bodies.push_back(std::move(body));
  }
  if (impact_waits) root.fail("impact", "needs a [[body]] whose motion is not \"fixed\"");
  return bodies;
}

}  // namespace nilas::cases
