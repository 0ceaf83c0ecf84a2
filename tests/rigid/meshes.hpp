// Meshes with known properties, and points on any mesh.
#pragma once

#include <numbers>
#include <vector>

#include "rigid/shape.hpp"

namespace nilas::rigid::test {

/// Twelve triangles between two corners.
inline void append_box(std::vector<Vec3>& vertices, std::vector<Mesh::Triangle>& triangles, const Vec3& low,
                       const Vec3& high, bool outward = true) {
  const int first = static_cast<int>(vertices.size());
  for (int n = 0; n < 8; ++n)
    vertices.emplace_back(n & 1 ? high.x() : low.x(), n & 2 ? high.y() : low.y(), n & 4 ? high.z() : low.z());
  for (const Mesh::Triangle& t : {Mesh::Triangle{0, 2, 1},
                                  {1, 2, 3},
                                  {4, 5, 6},
                                  {5, 7, 6},
                                  {0, 1, 4},
                                  {1, 5, 4},
                                  {2, 6, 3},
                                  {3, 6, 7},
                                  {0, 4, 2},
                                  {2, 4, 6},
                                  {1, 3, 5},
                                  {3, 7, 5}})
    triangles.push_back(outward ? Mesh::Triangle{first + t[0], first + t[1], first + t[2]}
                                : Mesh::Triangle{first + t[0], first + t[2], first + t[1]});
}

inline Mesh box_mesh(const Vec3& size, const Vec3& centre) {
  std::vector<Vec3> vertices;
  std::vector<Mesh::Triangle> triangles;
  append_box(vertices, triangles, centre - 0.5 * size, centre + 0.5 * size);
  return Mesh(vertices, triangles);
}

inline Mesh box_with_cavity() {
  std::vector<Vec3> vertices;
  std::vector<Mesh::Triangle> triangles;
  append_box(vertices, triangles, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  append_box(vertices, triangles, {-0.2, -0.1, -0.3}, {0.4, 0.3, 0.1}, false);
  return Mesh(vertices, triangles);
}

/// A prism along y over a polygon of the x-z plane that is seen counter-clockwise from -y, fanned from its first corner
/// (which must see all of it).
inline Mesh prism_mesh(const std::vector<Eigen::Vector2d>& polygon, double width) {
  const int n = static_cast<int>(polygon.size());
  std::vector<Vec3> vertices;
  for (const double y : {-0.5 * width, 0.5 * width})
    for (const auto& p : polygon) vertices.emplace_back(p.x(), y, p.y());
  std::vector<Mesh::Triangle> triangles;
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    triangles.push_back({i, next, n + next});
    triangles.push_back({i, n + next, n + i});
    if (i == 0 || next == 0) continue;
    triangles.push_back({0, next, i});
    triangles.push_back({n, n + i, n + next});
  }
  return Mesh(vertices, triangles);
}

/// An L with a reflex edge; its axes are not principal.
inline Mesh angle_mesh() { return prism_mesh({{0, 0}, {0.6, 0}, {0.6, 0.2}, {0.2, 0.2}, {0.2, 0.5}, {0, 0.5}}, 0.3); }

/// A star of sharp teeth: edges and corners of angles from acute to reflex.
inline Mesh spiked_mesh() {
  return prism_mesh({{0, 0}, {1, 0.05}, {0.3, 0.06}, {0.9, 0.3}, {0.25, 0.15}, {0.5, 0.9}, {0.12, 0.3}, {0.1, 1}}, 0.4);
}

/// Axis z; `around` sections of `sides` corners.
inline Mesh torus_mesh(double radius, double tube_radius, int around, int sides) {
  std::vector<Vec3> vertices;
  std::vector<Mesh::Triangle> triangles;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < sides; ++j) {
      const double phi = 2 * std::numbers::pi * i / around, theta = 2 * std::numbers::pi * j / sides;
      const double rho = radius + tube_radius * std::cos(theta);
      vertices.emplace_back(rho * std::cos(phi), rho * std::sin(phi), tube_radius * std::sin(theta));
      const int a = i * sides + j, b = (i + 1) % around * sides + j;
      const int c = (i + 1) % around * sides + (j + 1) % sides, d = i * sides + (j + 1) % sides;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return Mesh(vertices, triangles);
}

/// Points of every triangle, corners included, so that no point of the surface is farther than `spacing` from one.
inline std::vector<Vec3> lattice_on_triangles(const Mesh& mesh, double spacing) {
  std::vector<Vec3> points;
  for (const Mesh::Triangle& t : mesh.triangles()) {
    const Vec3 a = mesh.vertices()[t[0]], u = mesh.vertices()[t[1]] - a, v = mesh.vertices()[t[2]] - a;
    const int n = std::max(1, static_cast<int>(std::ceil(std::max({u.norm(), v.norm(), (u - v).norm()}) / spacing)));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) points.push_back(a + double(i) / n * u + double(j) / n * v);
  }
  return points;
}

}  // namespace nilas::rigid::test
