#include "rigid/mesh_surface.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

namespace nilas::rigid::geometry {
namespace {

constexpr double round_off = std::numeric_limits<double>::epsilon();
constexpr double far_away = 1e8;  // sizes of the mesh; from there its nearest point changes by 1e-8 sizes at most

template <class... Words>
[[noreturn]] void refuse(const Words&... words) {
  std::ostringstream message;
  message << "mesh: ";
  (message << ... << words);
  throw std::invalid_argument(message.str());
}

std::string at(const Vec3& p) {
  std::ostringstream text;
  text << '(' << p.x() << ", " << p.y() << ", " << p.z() << ") m";
  return text.str();
}

Corners corners_of(const std::vector<Vec3>& vertices, const Mesh::Triangle& t) {
  return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
}

std::vector<Vec3> checked(std::vector<Vec3> vertices) {
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (!vertices[v].allFinite()) refuse("vertex ", v, " is not finite");
  return vertices;
}

Vec3 twice_area(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]); }

void require_area(const Corners& c, std::size_t index) {
  const double longest2 =
      std::max({(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()});
  if (!(twice_area(c).norm() > 4 * round_off * longest2)) refuse("triangle ", index, " at ", at(c[0]), " has no area");
}

std::vector<Mesh::Triangle> checked(std::vector<Mesh::Triangle> triangles, const std::vector<Vec3>& vertices) {
  if (triangles.empty()) refuse("has no triangles");
  const int count = static_cast<int>(vertices.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const int v : triangles[t])
      if (v < 0 || v >= count) refuse("triangle ", t, " has vertex ", v, ", allowed: 0 to ", count - 1);
    require_area(corners_of(vertices, triangles[t]), t);
  }
  return triangles;
}

/// Every directed edge must be one triangle's, and its opposite another's.
std::vector<std::array<int, 3>> joined(const std::vector<Mesh::Triangle>& triangles,
                                       const std::vector<Vec3>& vertices) {
  const auto key = [](int from, int to) { return std::uint64_t(from) << 32 | std::uint64_t(to); };
  std::unordered_map<std::uint64_t, int> owner;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      if (!owner.emplace(key(from, to), static_cast<int>(t)).second)
        refuse("at the edge from ", at(vertices[from]), " to ", at(vertices[to]),
               " two triangles are turned opposite ways, or more than two meet");
    }
  }
  std::vector<std::array<int, 3>> beyond(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      const auto other = owner.find(key(to, from));
      if (other == owner.end())
        refuse("is open: only one triangle has the edge from ", at(vertices[from]), " to ", at(vertices[to]));
      beyond[t][k] = other->second;
    }
  }
  return beyond;
}

/// Whether the triangles enclose a positive volume, six times of which is the sum over the tetrahedra to one point.
bool encloses_positive_volume(const std::vector<Corners>& triangles) {
  const Vec3 apex = triangles.front()[0];
  double sum = 0, magnitude = 0;
  for (const Corners& c : triangles) {
    const double term = (c[0] - apex).dot((c[1] - apex).cross(c[2] - apex));
    sum += term;
    magnitude += std::abs(term);
  }
  if (std::abs(sum) <= 64 * round_off * magnitude) refuse("encloses no volume");
  return sum > 0;
}

double angle_at(const Corners& c, int k) {
  const Vec3 a = c[(k + 1) % 3] - c[k], b = c[(k + 2) % 3] - c[k];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Vec3 pseudo_normal(const MeshSurface& mesh, const NearestOnTriangle& nearest) {
  const int t = nearest.triangle;
  for (int k = 0; k < 3; ++k) {
    if (nearest.corners == 1u << k) return mesh.vertex_normals[mesh.triangles[t][k]];
    if (nearest.corners == (1u << k | 1u << (k + 1) % 3)) return mesh.normals[t] + mesh.normals[mesh.beyond[t][k]];
  }
  return mesh.normals[t];
}

}  // namespace

MeshSurface::MeshSurface(std::vector<Vec3> vertices_in, std::vector<Mesh::Triangle> triangles_in)
    : vertices(checked(std::move(vertices_in))),
      triangles(checked(std::move(triangles_in), vertices)),
      beyond(joined(triangles, vertices)),
      vertex_normals(vertices.size(), Vec3::Zero()) {
  std::vector<Corners> corners;
  for (const Mesh::Triangle& t : triangles) corners.push_back(corners_of(vertices, t));
  if (!encloses_positive_volume(corners)) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      std::swap(triangles[t][1], triangles[t][2]);
      std::swap(corners[t][1], corners[t][2]);
      std::swap(beyond[t][0], beyond[t][2]);
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    normals.push_back(twice_area(corners[t]).normalized());
    areas.push_back(0.5 * twice_area(corners[t]).norm());
    for (int k = 0; k < 3; ++k) {
      vertex_normals[triangles[t][k]] += angle_at(corners[t], k) * normals[t];
      low = low.cwiseMin(corners[t][k]);
      high = high.cwiseMax(corners[t][k]);
    }
  }
  tree = TriangleTree(corners, normals);
}

Corners MeshSurface::corners(std::size_t triangle) const { return corners_of(vertices, triangles[triangle]); }

Closest nearest_point(const MeshSurface& mesh, const Vec3& point) {
  const Vec3 middle = 0.5 * (mesh.low + mesh.high);
  const double size = (mesh.high - mesh.low).norm(), reach = (point - middle).stableNorm();
  const Vec3 query = reach > far_away * size ? Vec3(middle + far_away * size * ((point - middle) / reach)) : point;
  const NearestOnTriangle nearest = mesh.tree.nearest(query);
  const Vec3& face = mesh.normals[nearest.triangle];
  if (nearest.corners == 7) {
    const double height = face.dot(point - mesh.vertices[mesh.triangles[nearest.triangle][0]]);
    return {nearest.point, face, height};
  }
  const Vec3 outward = pseudo_normal(mesh, nearest).normalized();
  const Vec3 offset = point - nearest.point;
  const double distance = offset.stableNorm();
  if (distance <= 8 * round_off * size) return {nearest.point, outward, distance};  // its direction is round-off
  const double side = outward.dot(offset / distance) < 0 ? -1 : 1;
  return {nearest.point, side / distance * offset, side * distance};
}

}  // namespace nilas::rigid::geometry
