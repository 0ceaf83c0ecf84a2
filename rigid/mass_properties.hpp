// Mass, centre of mass and inertia of a rigid body, from geometry or stated, and whether matter can have them.
#pragma once

#include <string>
#include <vector>

#include "rigid/shape.hpp"

#pragma GCC visibility push(default)

namespace nilas::rigid {

struct MassProperties {
  double mass = 0;                     // kg
  Vec3 centre_of_mass = Vec3::Zero();  // m, geometry frame of the shape
  Vec3 inertia = Vec3::Zero();         // kg m2, principal, about the centre of mass, along the geometry axes
};

/// Homogeneous body of the shape. Throws std::invalid_argument if the shape is invalid, its geometry axes are not
/// principal (a mesh or compound), or the density not positive and finite.
MassProperties from_density(const Shape& shape, double density_kg_m3);
/// Homogeneous body of the shape, scaled to the mass. Throws as from_density.
MassProperties from_mass(const Shape& shape, double mass_kg);

/// Throws std::invalid_argument with the rule and the numbers if mass or a moment is not positive and finite, the
/// centre of mass is not finite, or the moments violate the triangle inequality I_i + I_j >= I_k (relative tolerance
/// 1e-12). Returns a warning for a centre of mass outside the shape, and one per moment that exceeds m R_i^2 of the
/// enclosing shape: no distribution of that mass inside the shape can have it.
std::vector<std::string> check(const MassProperties& mass, const Shape& shape);

}  // namespace nilas::rigid

#pragma GCC visibility pop
