#include "rigid/hcc.hpp"

#include <algorithm>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "rigid/dimension.hpp"
#include "rigid/spheroid_cap.hpp"

namespace nilas::rigid::geometry {
namespace {

using std::numbers::pi;

SpheroidCap nose(const Hcc& hcc) { return {0.5 * hcc.diameter, hcc.nose_length}; }
double wall_length(const Hcc& hcc) { return hcc.length - hcc.nose_length; }
double nose_volume(const Hcc& hcc) { return pi / 6 * hcc.diameter * hcc.diameter * hcc.nose_length; }
double wall_volume(const Hcc& hcc) { return pi / 4 * hcc.diameter * hcc.diameter * wall_length(hcc); }

bool contains(const Hcc& hcc, const Vec2& p) {
  const double across = p.x() / (0.5 * hcc.diameter);
  const double above = std::max(0.0, (p.y() + hcc.nose_length) / hcc.nose_length);  // the nose's base, relative
  return p.y() >= -hcc.length && std::hypot(across, above) <= 1;
}

/// A point of the meridian, its outward normal, and how far it is from the query point.
struct Candidate {
  Vec2 point, normal;
  double distance;
};

/// Nearest of nose, wall and tail. Inside a blunt or short body each of them can win.
Candidate nearest_on_meridian(const Hcc& hcc, const Vec2& p) {
  const double radius = 0.5 * hcc.diameter;
  const Vec2 base(0, -hcc.nose_length);
  const Vec2 on_nose = nearest_point(nose(hcc), p - base);
  const Vec2 on_wall(radius, std::clamp(p.y(), -hcc.length, -hcc.nose_length));
  const Vec2 on_tail(std::min(p.x(), radius), -hcc.length);
  Candidate best{on_nose + base, normal_at(nose(hcc), on_nose), (p - base - on_nose).stableNorm()};
  if (const double d = (p - on_wall).stableNorm(); d < best.distance) best = {on_wall, {1, 0}, d};
  if (const double d = (p - on_tail).stableNorm(); d < best.distance) best = {on_tail, {0, -1}, d};
  if (p.y() < -hcc.length) best.normal = (p - on_tail).stableNormalized();  // the rim has no normal of its own
  return best;
}

/// Distance of the farthest point of the meridian from (-rho, z).
double farthest_distance(const Hcc& hcc, const Vec2& point) {
  const Vec2 base(0, -hcc.nose_length);
  const Vec2 mirrored(-point.x(), point.y());
  const Vec2 on_nose = farthest_point(nose(hcc), point - base) + base;
  const Vec2 rim(0.5 * hcc.diameter, -hcc.length);
  return std::max((on_nose - mirrored).norm(), (rim - mirrored).norm());
}

}  // namespace

void validate(const Hcc& hcc) {
  require_positive("hcc", "length", hcc.length);
  require_positive("hcc", "diameter", hcc.diameter);
  require_positive("hcc", "nose length", hcc.nose_length);
  if (hcc.nose_length <= hcc.length) return;
  std::ostringstream message;
  message << "hcc: nose length = " << hcc.nose_length << " m, must be at most the length, " << hcc.length << " m";
  throw std::invalid_argument(message.str());
}

Closest closest_point(const Hcc& hcc, const Vec3& point) {
  const Vec2 p = meridian(point);
  const Vec3 radial = radial_direction(point);
  const Candidate nearest = nearest_on_meridian(hcc, p);
  return {lift(nearest.point, radial), lift(nearest.normal, radial),
          contains(hcc, p) ? -nearest.distance : nearest.distance};
}

std::vector<SurfacePoint> surface_points(const Hcc& hcc, double spacing) {
  const double radius = 0.5 * hcc.diameter;
  std::vector<SurfacePoint> points;
  append_cap(points, nose(hcc), -hcc.nose_length, false, spacing);
  append_wall(points, radius, -hcc.length, -hcc.nose_length, spacing);
  append_disc(points, radius, -hcc.length, -1, spacing);
  return points;
}

double volume(const Hcc& hcc) { return nose_volume(hcc) + wall_volume(hcc); }

double surface_area(const Hcc& hcc) {
  return curved_area(nose(hcc)) + pi * hcc.diameter * (wall_length(hcc) + 0.25 * hcc.diameter);
}

Vec3 centroid(const Hcc& hcc) {
  const double nose_z = -0.625 * hcc.nose_length;  // 3/8 of its height above its base
  const double wall_z = -0.5 * (hcc.length + hcc.nose_length);
  return {0, 0, (nose_volume(hcc) * nose_z + wall_volume(hcc) * wall_z) / volume(hcc)};
}

Vec3 inertia_per_mass(const Hcc& hcc) {
  const double r2 = 0.25 * hcc.diameter * hcc.diameter;
  const double a = hcc.nose_length, b = wall_length(hcc);
  const double in_nose = nose_volume(hcc) / volume(hcc), in_wall = wall_volume(hcc) / volume(hcc);
  const double base_to_centroid = centroid(hcc).z() + a;
  // Both parts about a line across the axis in the nose's base, then moved to the centroid.
  const double about_base = in_nose * (r2 + a * a) / 5 + in_wall * (r2 / 4 + b * b / 3);
  const double across = about_base - base_to_centroid * base_to_centroid;
  return {across, across, (0.4 * in_nose + 0.5 * in_wall) * r2};
}

double enclosing_radius(const Hcc& hcc, const Vec3& centre) { return farthest_distance(hcc, meridian(centre)); }

Vec3 enclosing_radii(const Hcc& hcc, const Vec3& centre) {
  // Seen along x or y the body is its meridian section.
  return {farthest_distance(hcc, {std::abs(centre.y()), centre.z()}),
          farthest_distance(hcc, {std::abs(centre.x()), centre.z()}), meridian(centre).x() + 0.5 * hcc.diameter};
}

std::vector<Vec3> outline(const Hcc& hcc) {
  std::vector<Vec2> meridian = meridian_points(nose(hcc), 33);
  for (Vec2& p : meridian) p.y() -= hcc.nose_length;
  meridian.emplace_back(0.5 * hcc.diameter, -hcc.length);
  return closed_outline(meridian);
}

Vec3 support_point(const Hcc& hcc, const Vec3& direction) {
  const Vec2 d = meridian(direction);
  const Vec3 radial = radial_direction(direction);
  if (d.y() >= 0) return lift(point_with_normal(nose(hcc), d) - Vec2(0, hcc.nose_length), radial);
  return lift({d.x() > 0 ? 0.5 * hcc.diameter : 0.0, -hcc.length}, radial);
}

}  // namespace nilas::rigid::geometry
