#include "rigid/revolution.hpp"

#include <algorithm>
#include <numbers>

namespace nilas::rigid::geometry {

using std::numbers::pi;

Vec3 radial_direction(const Vec3& point) {
  const double rho = std::hypot(point.x(), point.y());
  return rho > 0 ? Vec3(point.x() / rho, point.y() / rho, 0) : Vec3(1, 0, 0);
}

int intervals(double length, double spacing) { return std::max(1, static_cast<int>(std::lround(length / spacing))); }

void append_ring(std::vector<SurfacePoint>& points, const Ring& ring, double spacing) {
  const int per_quadrant = intervals(pi / 2 * ring.position.x(), spacing);
  const double area = ring.area / (4 * per_quadrant);
  for (int i = 0; i < per_quadrant; ++i) {
    const double angle = (i + 0.5) / per_quadrant * pi / 2;
    // Mirror images of one quadrant, not four evaluations: the symmetry is exact, and so is that of the loads.
    for (const double x : {std::cos(angle), -std::cos(angle)}) {
      for (const double y : {std::sin(angle), -std::sin(angle)}) {
        const Vec3 radial(x, y, 0);
        points.push_back({lift(ring.position, radial), lift(ring.normal, radial), area});
      }
    }
  }
}

void append_wall(std::vector<SurfacePoint>& points, double radius, double z_low, double z_high, double spacing) {
  const double length = z_high - z_low;
  if (length <= 0) return;
  const int count = intervals(length, spacing);
  for (int i = 0; i < count; ++i) {
    const double z = 0.5 * (z_low + z_high) + length * (2 * i + 1 - count) / (2 * count);
    append_ring(points, {{radius, z}, {1, 0}, 2 * pi * radius * length / count}, spacing);
  }
}

void append_cone(std::vector<SurfacePoint>& points, double radius, double z_base, double z_tip, const Vec2& normal,
                 double spacing) {
  const double slant = std::hypot(radius, z_tip - z_base);
  const int count = intervals(slant, spacing);
  for (int i = 0; i < count; ++i) {
    const double inner = radius * i / count;
    const double outer = radius * (i + 1) / count;
    // The root-mean-square radius keeps the second moments of the area about the axis.
    const double rho = std::sqrt(0.5 * (inner * inner + outer * outer));
    const double area = pi * (outer - inner) * (outer + inner) * (slant / radius);
    append_ring(points, {{rho, z_base + (z_tip - z_base) * (1 - rho / radius)}, normal, area}, spacing);
  }
}

void append_disc(std::vector<SurfacePoint>& points, double radius, double z, double normal_z, double spacing) {
  append_cone(points, radius, z, z, {0, normal_z}, spacing);
}

std::vector<Vec3> closed_outline(const std::vector<Vec2>& meridian) {
  std::vector<Vec3> outline;
  for (const Vec2& p : meridian) outline.emplace_back(0, p.x(), p.y());
  for (auto p = meridian.rbegin(); p != meridian.rend(); ++p) {
    if (p->x() > 0) outline.emplace_back(0, -p->x(), p->y());
  }
  outline.push_back(outline.front());
  return outline;
}

}  // namespace nilas::rigid::geometry
