#include "rigid/shape.hpp"

#include <sstream>
#include <stdexcept>

#include "rigid/box.hpp"
#include "rigid/cylinder.hpp"
#include "rigid/hcc.hpp"
#include "rigid/sphere.hpp"

namespace nilas::rigid {
namespace {

constexpr double max_samples = 1e8;  // some 6 GB: a slip in the unit of the spacing, not a wish

void require_usable(double spacing, const Shape& shape) {
  const double samples = surface_area(shape) / (spacing * spacing);
  if (std::isfinite(spacing) && spacing > 0 && samples <= max_samples) return;
  std::ostringstream message;
  message << name(shape) << ": surface spacing = " << spacing << " m, must be positive, finite and at least "
          << std::sqrt(surface_area(shape) / max_samples) << " m";
  throw std::invalid_argument(message.str());
}

}  // namespace

void validate(const Shape& shape) {
  std::visit([](const auto& s) { geometry::validate(s); }, shape);
}

Closest closest_point(const Shape& shape, const Vec3& point) {
  return std::visit([&](const auto& s) { return geometry::closest_point(s, point); }, shape);
}

std::vector<SurfacePoint> surface_points(const Shape& shape, double spacing) {
  validate(shape);
  require_usable(spacing, shape);
  return std::visit([&](const auto& s) { return geometry::surface_points(s, spacing); }, shape);
}

double volume(const Shape& shape) {
  return std::visit([](const auto& s) { return geometry::volume(s); }, shape);
}

double surface_area(const Shape& shape) {
  return std::visit([](const auto& s) { return geometry::surface_area(s); }, shape);
}

Vec3 centroid(const Shape& shape) {
  return std::visit([](const auto& s) { return geometry::centroid(s); }, shape);
}

Vec3 inertia_per_mass(const Shape& shape) {
  return std::visit([](const auto& s) { return geometry::inertia_per_mass(s); }, shape);
}

double enclosing_radius(const Shape& shape, const Vec3& centre) {
  return std::visit([&](const auto& s) { return geometry::enclosing_radius(s, centre); }, shape);
}

Vec3 enclosing_radii(const Shape& shape, const Vec3& centre) {
  return std::visit([&](const auto& s) { return geometry::enclosing_radii(s, centre); }, shape);
}

std::vector<Vec3> outline(const Shape& shape) {
  return std::visit([](const auto& s) { return geometry::outline(s); }, shape);
}

std::string name(const Shape& shape) {
  return std::visit([](const auto& s) { return std::string(geometry::name(s)); }, shape);
}

Vec3 support_point(const Shape& shape, const Vec3& direction) {
  return std::visit([&](const auto& s) { return geometry::support_point(s, direction); }, shape);
}

}  // namespace nilas::rigid
