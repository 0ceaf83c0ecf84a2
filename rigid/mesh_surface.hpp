// A closed triangle surface made ready for queries: orientation, normals of faces, edges and corners, search tree.
#pragma once

#include "rigid/shape.hpp"
#include "rigid/triangle_tree.hpp"

namespace nilas::rigid::geometry {

struct MeshSurface {
  /// Checks and turns as the constructor of Mesh says.
  MeshSurface(std::vector<Vec3> vertices, std::vector<Mesh::Triangle> triangles);

  std::vector<Vec3> vertices;              // m
  std::vector<Mesh::Triangle> triangles;   // counter-clockwise seen from outside
  std::vector<Vec3> normals;               // unit, of the triangles
  std::vector<double> areas;               // m2, of the triangles
  std::vector<std::array<int, 3>> beyond;  // the triangle on the other side of the edge from corner k to the next
  std::vector<Vec3> vertex_normals;        // sum of the normals about a vertex, weighted by their angles
  Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);  // m, bounding box
  TriangleTree tree;

  Corners corners(std::size_t triangle) const;
};

/// Nearest point with the signed distance: the side is that of the pseudo-normal of the nearest face, edge or corner
/// (Baerentzen and Aanaes, IEEE Trans. Vis. Comput. Graph. 11, 243, 2005).
Closest nearest_point(const MeshSurface& mesh, const Vec3& point);

}  // namespace nilas::rigid::geometry
