#include "rigid/mass_properties.hpp"

#include <sstream>
#include <stdexcept>

namespace nilas::rigid {
namespace {

constexpr double tolerance = 1e-12;  // relative: round-off of stated or computed moments
constexpr const char* axis_name[] = {"x", "y", "z"};

void require_positive(const char* quantity, double value, const char* unit) {
  if (std::isfinite(value) && value > 0) return;
  std::ostringstream message;
  if (std::isfinite(value))
    message << quantity << " = " << value << ' ' << unit << ", must be positive and finite";
  else
    message << quantity << " is not finite, must be positive and finite";
  throw std::invalid_argument(message.str());
}

/// I_i + I_j - I_k is twice an integral of a square over the matter.
void require_triangle_inequality(const Vec3& inertia) {
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    if (inertia[i] + inertia[j] >= inertia[k] * (1 - tolerance)) continue;
    std::ostringstream message;
    message << "inertia about " << axis_name[k] << " = " << inertia[k]
            << " kg m2, must not exceed the sum of the others, " << inertia[i] << " + " << inertia[j]
            << " kg m2 (triangle inequality: no matter has such moments)";
    throw std::invalid_argument(message.str());
  }
}

}  // namespace

MassProperties from_density(const Shape& shape, double density_kg_m3) {
  validate(shape);
  require_positive("density", density_kg_m3, "kg/m3");
  return from_mass(shape, density_kg_m3 * volume(shape));
}

MassProperties from_mass(const Shape& shape, double mass_kg) {
  validate(shape);
  require_positive("mass", mass_kg, "kg");
  return {mass_kg, centroid(shape), mass_kg * inertia_per_mass(shape)};
}

std::vector<std::string> check(const MassProperties& mass, const Shape& shape) {
  validate(shape);
  require_positive("mass", mass.mass, "kg");
  for (int i = 0; i < 3; ++i) {
    require_positive((std::string("inertia about ") + axis_name[i]).c_str(), mass.inertia[i], "kg m2");
  }
  if (!mass.centre_of_mass.allFinite()) throw std::invalid_argument("centre of mass is not finite");
  require_triangle_inequality(mass.inertia);

  std::vector<std::string> warnings;
  const double outside = closest_point(shape, mass.centre_of_mass).distance;
  if (outside > tolerance * enclosing_radius(shape, centroid(shape))) {
    std::ostringstream message;
    message << "centre of mass (" << mass.centre_of_mass.transpose() << ") m lies " << outside << " m outside the "
            << name(shape) << ": no distribution of mass inside it can have it";
    warnings.push_back(message.str());
  }
  const Vec3 radii = enclosing_radii(shape, mass.centre_of_mass);
  for (int i = 0; i < 3; ++i) {
    const double bound = mass.mass * radii[i] * radii[i];
    if (mass.inertia[i] <= bound * (1 + tolerance)) continue;
    std::ostringstream message;
    message << "inertia about " << axis_name[i] << " = " << mass.inertia[i] << " kg m2 exceeds m R^2 = " << bound
            << " kg m2 (m = " << mass.mass << " kg, R = " << radii[i] << " m): no distribution of that mass inside the "
            << name(shape) << " can have it";
    warnings.push_back(message.str());
  }
  return warnings;
}

}  // namespace nilas::rigid
