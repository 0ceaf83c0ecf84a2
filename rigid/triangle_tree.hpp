// Nearest of many triangles to a point: a binary tree of bounding boxes.
#pragma once

#include <array>
#include <vector>

#include "rigid/vector.hpp"

namespace nilas::rigid::geometry {

using Corners = std::array<Vec3, 3>;

/// The nearest point of a triangle, and on which part of it: bit k of `corners` is set if corner k belongs to the
/// smallest face, edge or corner that holds the point (7: inside the face).
struct NearestOnTriangle {
  int triangle = -1;
  unsigned corners = 7;
  Vec3 point;
  double squared_distance;  // m2
};

class TriangleTree {
 public:
  TriangleTree() = default;
  /// At least one triangle; normals: unit.
  TriangleTree(const std::vector<Corners>& triangles, const std::vector<Vec3>& normals);
  /// `triangle` is the index in the constructor's list. For points within 1e8 times the size of the set.
  NearestOnTriangle nearest(const Vec3& point) const;

 private:
  struct Entry {
    Corners corners;
    Vec3 normal;
    int index;
  };
  struct Node {
    Vec3 low, high;
    int begin, end;  // entries
    int right = 0;   // second child, 0 for a leaf; the first is the next node
  };
  void build(int begin, int end);
  void search(int node, const Vec3& point, NearestOnTriangle& best) const;

  std::vector<Entry> entries_;
  std::vector<Node> nodes_;
};

}  // namespace nilas::rigid::geometry
