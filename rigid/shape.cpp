#include "rigid/shape.hpp"

#include <sstream>
#include <stdexcept>

#include "rigid/box.hpp"
#include "rigid/capsule.hpp"
#include "rigid/compound.hpp"
#include "rigid/cone.hpp"
#include "rigid/cylinder.hpp"
#include "rigid/hcc.hpp"
#include "rigid/mesh.hpp"
#include "rigid/sphere.hpp"

namespace nilas::rigid {
namespace {

constexpr double max_samples = 1e8;           // some 6 GB: a slip in the unit of the spacing, not a wish
constexpr double principal_tolerance = 1e-6;  // of the largest moment; vertices in single precision leave some 1e-7

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

Mat3 inertia_tensor_per_mass(const Shape& shape) {
  return std::visit(
      [](const auto& s) -> Mat3 {
        if constexpr (requires { geometry::inertia_per_mass(s); })
          return geometry::inertia_per_mass(s).asDiagonal();
        else
          return geometry::inertia_tensor_per_mass(s);
      },
      shape);
}

Vec3 inertia_per_mass(const Shape& shape) {
  const Mat3 inertia = inertia_tensor_per_mass(shape);
  const Vec3 products(inertia(1, 2), inertia(2, 0), inertia(0, 1));
  int axis;
  const double ratio = products.cwiseAbs().maxCoeff(&axis) / inertia.diagonal().maxCoeff();
  if (ratio <= principal_tolerance) return inertia.diagonal();
  constexpr const char* pair[] = {"yz", "zx", "xy"};
  std::ostringstream message;
  message << name(shape) << ": product of inertia " << pair[axis] << " is " << ratio
          << " of the largest moment, must be at most " << principal_tolerance
          << ": the geometry axes must be principal (turn the shape, or state the moments)";
  throw std::invalid_argument(message.str());
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
