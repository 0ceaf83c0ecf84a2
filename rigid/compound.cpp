#include "rigid/compound.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "rigid/support_sweep.hpp"

namespace nilas::rigid::geometry {
namespace {

constexpr double touching = 1e-6;  // of the size: what is this near to another part's surface is taken to lie on it
constexpr double unit_tolerance = 1e-9;

Vec3 to_part(const Part& part, const Vec3& point) { return part.orientation.conjugate() * (point - part.position); }
Vec3 from_part(const Part& part, const Vec3& point) { return part.orientation * point + part.position; }

Closest closest_on(const Part& part, const Vec3& point) {
  const Closest c = rigid::closest_point(part.shape, to_part(part, point));
  return {from_part(part, c.point), part.orientation * c.normal, c.distance};
}

/// Whether a sample of part `own` is no part of the union's surface: inside another part, between two that touch, or on
/// a face that an earlier part shares.
bool is_covered(const Compound& compound, std::size_t own, const SurfacePoint& sample, double tolerance) {
  for (std::size_t k = 0; k < compound.parts.size(); ++k) {
    if (k == own) continue;
    const Closest c = closest_on(compound.parts[k], sample.position);
    if (c.distance > tolerance) continue;
    const double alike = c.normal.dot(sample.normal);
    if (c.distance < -tolerance || alike < touching - 1 || (k < own && alike > 1 - touching)) return true;
  }
  return false;
}

void validate(const Part& part) {
  if (!part.position.allFinite()) throw std::invalid_argument("position is not finite");
  if (!(std::abs(part.orientation.norm() - 1) <= unit_tolerance))
    throw std::invalid_argument("orientation is no unit quaternion");
  rigid::validate(part.shape);
}

}  // namespace

void validate(const Compound& compound) {
  if (compound.parts.empty()) throw std::invalid_argument("compound: has no parts, must have at least one");
  for (std::size_t k = 0; k < compound.parts.size(); ++k) {
    try {
      validate(compound.parts[k]);
    } catch (const std::invalid_argument& error) {
      std::ostringstream message;
      message << "compound: part " << k << ": " << error.what();
      throw std::invalid_argument(message.str());
    }
  }
}

Closest closest_point(const Compound& compound, const Vec3& point) {
  Closest nearest{Vec3::Zero(), Vec3::Zero(), std::numeric_limits<double>::infinity()};
  for (const Part& part : compound.parts) {
    const Closest c = closest_on(part, point);
    if (c.distance < nearest.distance) nearest = c;
  }
  return nearest;
}

std::vector<SurfacePoint> surface_points(const Compound& compound, double spacing) {
  const double tolerance = touching * enclosing_radius(compound, centroid(compound));
  std::vector<SurfacePoint> points;
  for (std::size_t k = 0; k < compound.parts.size(); ++k) {
    const Part& part = compound.parts[k];
    for (SurfacePoint sample : rigid::surface_points(part.shape, spacing)) {
      sample.position = from_part(part, sample.position);
      sample.normal = part.orientation * sample.normal;
      if (!is_covered(compound, k, sample, tolerance)) points.push_back(sample);
    }
  }
  return points;
}

double volume(const Compound& compound) {
  double sum = 0;
  for (const Part& part : compound.parts) sum += rigid::volume(part.shape);
  return sum;
}

double surface_area(const Compound& compound) {
  double sum = 0;
  for (const Part& part : compound.parts) sum += rigid::surface_area(part.shape);
  return sum;
}

Vec3 centroid(const Compound& compound) {
  Vec3 sum = Vec3::Zero();
  for (const Part& part : compound.parts)
    sum += rigid::volume(part.shape) * from_part(part, rigid::centroid(part.shape));
  return sum / volume(compound);
}

Mat3 inertia_tensor_per_mass(const Compound& compound) {
  const Vec3 centre = centroid(compound);
  Mat3 sum = Mat3::Zero();
  for (const Part& part : compound.parts) {
    const Mat3 turn = part.orientation.toRotationMatrix();
    const Vec3 r = from_part(part, rigid::centroid(part.shape)) - centre;
    const Mat3 own = turn * rigid::inertia_tensor_per_mass(part.shape) * turn.transpose();
    sum += rigid::volume(part.shape) * (own + r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  return sum / volume(compound);
}

double enclosing_radius(const Compound& compound, const Vec3& centre) {
  double radius = 0;
  for (const Part& part : compound.parts)
    radius = std::max(radius, rigid::enclosing_radius(part.shape, to_part(part, centre)));
  return radius;
}

Vec3 enclosing_radii(const Compound& compound, const Vec3& centre) {
  const auto support = [&](const Vec3& d) { return support_point(compound, d); };
  return {farthest_from_axis(support, 0, centre), farthest_from_axis(support, 1, centre),
          farthest_from_axis(support, 2, centre)};
}

std::vector<Vec3> outline(const Compound& compound) {
  return projected_outline([&](const Vec3& d) { return support_point(compound, d); });
}

Vec3 support_point(const Compound& compound, const Vec3& direction) {
  Vec3 farthest = Vec3::Zero();
  double reach = -std::numeric_limits<double>::infinity();
  for (const Part& part : compound.parts) {
    const Vec3 point = from_part(part, rigid::support_point(part.shape, part.orientation.conjugate() * direction));
    if (direction.dot(point) <= reach) continue;
    farthest = point;
    reach = direction.dot(point);
  }
  return farthest;
}

}  // namespace nilas::rigid::geometry
