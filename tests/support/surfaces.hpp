// Surfaces of simple bodies for contact tests, sampled by boundary particles.
#pragma once

#include <cmath>
#include <numbers>

#include "sph/boundary.hpp"

namespace nilas::sph::test {

/// A square of n x n boundary particles about `centre`; u and v span it, its normal is u x v.
inline void add_square(Surface& surface, const Vec3& centre, const Vec3& u, const Vec3& v, int n, double spacing) {
  surface.spacing = spacing;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 x = centre + spacing * ((i - 0.5 * (n - 1)) * u + (j - 0.5 * (n - 1)) * v);
      surface.particles.push_back({x, Vec3::Zero(), u.cross(v), spacing * spacing, Vec3::Zero()});
    }
}

/// A horizontal square facing up.
inline Surface plane(double z, int n, double spacing) {
  Surface s;
  add_square(s, {0, 0, z}, Vec3::UnitX(), Vec3::UnitY(), n, spacing);
  return s;
}

/// A square plate's two faces, without rims.
inline Surface plate(double thickness, int n, double spacing) {
  Surface s = plane(thickness / 2, n, spacing);
  add_square(s, {0, 0, -thickness / 2}, Vec3::UnitY(), Vec3::UnitX(), n, spacing);
  return s;
}

/// A sphere, sampled along a spiral of equal areas (Saff and Kuijlaars 1997).
inline Surface sphere(const Vec3& centre, double radius, double spacing) {
  Surface s;
  s.spacing = spacing;
  s.reference = centre;
  const double total = 4 * std::numbers::pi * radius * radius;
  const int n = static_cast<int>(std::ceil(total / (spacing * spacing)));
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, rho = std::sqrt(1 - z * z);
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const Vec3 normal(rho * std::cos(angle), rho * std::sin(angle), z);
    s.particles.push_back({centre + radius * normal, Vec3::Zero(), normal, total / n, Vec3::Zero()});
  }
  return s;
}

inline void set_velocity(Surface& surface, const Vec3& velocity) {
  for (BoundaryParticle& b : surface.particles) b.velocity = velocity;
}
inline void move(Surface& surface, const Vec3& displacement) {
  for (BoundaryParticle& b : surface.particles) b.position += displacement;
  surface.reference += displacement;
}

}  // namespace nilas::sph::test
