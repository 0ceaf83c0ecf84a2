#include "rigid/box.hpp"

#include "rigid/dimension.hpp"
#include "rigid/revolution.hpp"

namespace nilas::rigid::geometry {
namespace {

double sign(double x) { return x < 0 ? -1 : 1; }

/// The two faces normal to an axis, cell by cell.
void append_faces(std::vector<SurfacePoint>& points, const Vec3& size, int axis, double spacing) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int count_u = intervals(size[u], spacing), count_v = intervals(size[v], spacing);
  const double area = size[u] / count_u * (size[v] / count_v);
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < count_u; ++i) {
      for (int j = 0; j < count_v; ++j) {
        Vec3 position;
        position[axis] = side * 0.5 * size[axis];
        position[u] = size[u] * (2 * i + 1 - count_u) / (2 * count_u);
        position[v] = size[v] * (2 * j + 1 - count_v) / (2 * count_v);
        points.push_back({position, side * Vec3::Unit(axis), area});
      }
    }
  }
}

}  // namespace

void validate(const Box& box) {
  require_positive("box", "size x", box.size.x());
  require_positive("box", "size y", box.size.y());
  require_positive("box", "size z", box.size.z());
}

Closest closest_point(const Box& box, const Vec3& point) {
  const Vec3 half = 0.5 * box.size;
  const Vec3 excess = point.cwiseAbs() - half;  // how far beyond each pair of faces
  const Vec3 side = point.unaryExpr(&sign);
  int axis;
  const double largest = excess.maxCoeff(&axis);
  if (largest <= 0) {
    Vec3 nearest = point;
    nearest[axis] = side[axis] * half[axis];
    return {nearest, side[axis] * Vec3::Unit(axis), largest};
  }
  const Vec3 outward = side.cwiseProduct(excess.cwiseMax(0.0));
  return {point.cwiseMin(half).cwiseMax(-half), outward.stableNormalized(), outward.stableNorm()};
}

std::vector<SurfacePoint> surface_points(const Box& box, double spacing) {
  std::vector<SurfacePoint> points;
  for (int axis = 0; axis < 3; ++axis) append_faces(points, box.size, axis, spacing);
  return points;
}

double volume(const Box& box) { return box.size.prod(); }

double surface_area(const Box& box) {
  const Vec3& s = box.size;
  return 2 * (s.x() * s.y() + s.y() * s.z() + s.z() * s.x());
}

Vec3 centroid(const Box&) { return Vec3::Zero(); }

Vec3 inertia_per_mass(const Box& box) {
  const Vec3 squared = box.size.cwiseAbs2();
  return (Vec3::Constant(squared.sum()) - squared) / 12;
}

double enclosing_radius(const Box& box, const Vec3& centre) { return (centre.cwiseAbs() + 0.5 * box.size).norm(); }

Vec3 enclosing_radii(const Box& box, const Vec3& centre) {
  const Vec3 reach = centre.cwiseAbs() + 0.5 * box.size;
  return {std::hypot(reach.y(), reach.z()), std::hypot(reach.z(), reach.x()), std::hypot(reach.x(), reach.y())};
}

std::vector<Vec3> outline(const Box& box) {
  const double y = 0.5 * box.size.y(), z = 0.5 * box.size.z();
  return {{0, y, z}, {0, y, -z}, {0, -y, -z}, {0, -y, z}, {0, y, z}};
}

Vec3 support_point(const Box& box, const Vec3& direction) {
  const auto side = [](double d) { return d > 0 ? 1.0 : d < 0 ? -1.0 : 0.0; };
  return 0.5 * box.size.cwiseProduct(Vec3(direction.unaryExpr(side)));
}

}  // namespace nilas::rigid::geometry
