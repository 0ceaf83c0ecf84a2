#include "rigid/mesh.hpp"

#include <algorithm>
#include <numbers>

#include "rigid/mesh_surface.hpp"
#include "rigid/support_sweep.hpp"

namespace nilas::rigid {

Mesh::Mesh(std::vector<Vec3> vertices, std::vector<Triangle> triangles)
    : surface_(std::make_shared<geometry::MeshSurface>(std::move(vertices), std::move(triangles))) {}

const std::vector<Vec3>& Mesh::vertices() const { return surface_->vertices; }
const std::vector<Mesh::Triangle>& Mesh::triangles() const { return surface_->triangles; }

namespace geometry {
namespace {

Vec3 middle(const Mesh& mesh) { return 0.5 * (mesh.surface().low + mesh.surface().high); }

/// Moments of the enclosed matter of unit density about the middle of the bounding box.
struct Moments {
  double volume = 0;           // m3
  Vec3 first = Vec3::Zero();   // m4, int x dV
  Mat3 second = Mat3::Zero();  // m5, int x x^T dV
};

/// Sum over the tetrahedra between the triangles and the middle, exact: a tetrahedron with corners 0, a, b, c has
/// int x dV = V (a + b + c) / 4 and int x x^T dV = V (a a^T + b b^T + c c^T + s s^T) / 20, s = a + b + c.
Moments moments(const Mesh& mesh) {
  Moments sum;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    Corners r = mesh.surface().corners(t);
    for (Vec3& corner : r) corner -= middle(mesh);
    const double v = r[0].dot(r[1].cross(r[2])) / 6;
    const Vec3 s = r[0] + r[1] + r[2];
    sum.volume += v;
    sum.first += v / 4 * s;
    sum.second += v / 20 * (s * s.transpose());
    for (const Vec3& corner : r) sum.second += v / 20 * (corner * corner.transpose());
  }
  return sum;
}

/// The centroids of a triangle's parts, halved across the longest edge. The limits are a factor of two on the area, the
/// geometric mean of which is spacing^2, and the longest edge of the right isosceles triangle of the upper one.
void append_triangle(std::vector<SurfacePoint>& points, const Corners& c, const Vec3& normal, double area,
                     double spacing) {
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if ((c[(i + 1) % 3] - c[i]).squaredNorm() > (c[(k + 1) % 3] - c[k]).squaredNorm()) k = i;
  const Vec3 &a = c[k], &b = c[(k + 1) % 3], &apex = c[(k + 2) % 3];
  const double largest_area = std::numbers::sqrt2 * spacing * spacing;
  if (area <= largest_area && (b - a).squaredNorm() <= 4 * largest_area) {
    points.push_back({(a + b + apex) / 3, normal, area});
    return;
  }
  const Vec3 half = 0.5 * (a + b);
  append_triangle(points, {a, half, apex}, normal, 0.5 * area, spacing);
  append_triangle(points, {half, b, apex}, normal, 0.5 * area, spacing);
}

}  // namespace

Closest closest_point(const Mesh& mesh, const Vec3& point) { return nearest_point(mesh.surface(), point); }

std::vector<SurfacePoint> surface_points(const Mesh& mesh, double spacing) {
  const MeshSurface& surface = mesh.surface();
  std::vector<SurfacePoint> points;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    append_triangle(points, surface.corners(t), surface.normals[t], surface.areas[t], spacing);
  return points;
}

double volume(const Mesh& mesh) { return moments(mesh).volume; }

double surface_area(const Mesh& mesh) {
  double sum = 0;
  for (const double area : mesh.surface().areas) sum += area;
  return sum;
}

Vec3 centroid(const Mesh& mesh) {
  const Moments m = moments(mesh);
  return middle(mesh) + m.first / m.volume;
}

Mat3 inertia_tensor_per_mass(const Mesh& mesh) {
  const Moments m = moments(mesh);
  const Vec3 off_middle = m.first / m.volume;
  const Mat3 spread = m.second / m.volume - off_middle * off_middle.transpose();
  return spread.trace() * Mat3::Identity() - spread;
}

double enclosing_radius(const Mesh& mesh, const Vec3& centre) {
  double radius = 0;
  for (const Vec3& v : mesh.vertices()) radius = std::max(radius, (v - centre).norm());
  return radius;
}

Vec3 enclosing_radii(const Mesh& mesh, const Vec3& centre) {
  Vec3 radii = Vec3::Zero();
  for (const Vec3& v : mesh.vertices()) {
    const Vec3 r = v - centre;
    radii = radii.cwiseMax(Vec3(std::hypot(r.y(), r.z()), std::hypot(r.z(), r.x()), std::hypot(r.x(), r.y())));
  }
  return radii;
}

std::vector<Vec3> outline(const Mesh& mesh) {
  return projected_outline([&](const Vec3& d) { return support_point(mesh, d); });
}

Vec3 support_point(const Mesh& mesh, const Vec3& direction) {
  const auto& vertices = mesh.vertices();
  return *std::max_element(vertices.begin(), vertices.end(),
                           [&](const Vec3& a, const Vec3& b) { return direction.dot(a) < direction.dot(b); });
}

}  // namespace geometry
}  // namespace nilas::rigid
