#include "rigid/triangle_tree.hpp"

#include <algorithm>
#include <limits>

namespace nilas::rigid::geometry {
namespace {

constexpr int entries_per_leaf = 4;

double squared_distance_to_box(const Vec3& low, const Vec3& high, const Vec3& p) {
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

Vec3 middle(const Corners& c) { return (c[0] + c[1] + c[2]) / 3; }

/// Beside the triangle's prism the nearest point is on an edge that the point lies beyond.
NearestOnTriangle nearest_on(const Corners& corners, const Vec3& normal, const Vec3& p) {
  NearestOnTriangle best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  bool beside = false;
  for (unsigned k = 0; k < 3; ++k) {
    const unsigned next = (k + 1) % 3;
    const Vec3& a = corners[k];
    const Vec3 edge = corners[next] - a;
    if ((p - a).dot(edge.cross(normal)) <= 0) continue;
    beside = true;
    const double t = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const Vec3 q = t == 1 ? corners[next] : Vec3(a + t * edge);
    const double d2 = (p - q).squaredNorm();
    if (d2 >= best.squared_distance) continue;
    best.point = q;
    best.squared_distance = d2;
    best.corners = (t < 1 ? 1u << k : 0u) | (t > 0 ? 1u << next : 0u);
  }
  if (beside) return best;
  const double height = normal.dot(p - corners[0]);
  best.point = p - height * normal;
  best.squared_distance = height * height;
  return best;
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<Corners>& triangles, const std::vector<Vec3>& normals) {
  for (std::size_t t = 0; t < triangles.size(); ++t)
    entries_.push_back({triangles[t], normals[t], static_cast<int>(t)});
  build(0, static_cast<int>(entries_.size()));
}

void TriangleTree::build(int begin, int end) {
  Node node{Vec3::Constant(INFINITY), Vec3::Constant(-INFINITY), begin, end};
  for (int i = begin; i < end; ++i) {
    for (const Vec3& corner : entries_[i].corners) {
      node.low = node.low.cwiseMin(corner);
      node.high = node.high.cwiseMax(corner);
    }
  }
  const std::size_t here = nodes_.size();
  nodes_.push_back(node);
  if (end - begin <= entries_per_leaf) return;
  int axis;
  (node.high - node.low).maxCoeff(&axis);
  const int half = begin + (end - begin) / 2;
  std::nth_element(
      entries_.begin() + begin, entries_.begin() + half, entries_.begin() + end,
      [axis](const Entry& a, const Entry& b) { return middle(a.corners)[axis] < middle(b.corners)[axis]; });
  build(begin, half);
  nodes_[here].right = static_cast<int>(nodes_.size());
  build(half, end);
}

void TriangleTree::search(int index, const Vec3& point, NearestOnTriangle& best) const {
  const Node& node = nodes_[index];
  if (node.right == 0) {
    for (int i = node.begin; i < node.end; ++i) {
      NearestOnTriangle found = nearest_on(entries_[i].corners, entries_[i].normal, point);
      if (found.squared_distance >= best.squared_distance) continue;
      best = found;
      best.triangle = entries_[i].index;
    }
    return;
  }
  const auto distance = [&](int child) {
    return squared_distance_to_box(nodes_[child].low, nodes_[child].high, point);
  };
  int near = index + 1, far = node.right;
  if (distance(far) < distance(near)) std::swap(near, far);
  if (distance(near) < best.squared_distance) search(near, point, best);
  if (distance(far) < best.squared_distance) search(far, point, best);
}

NearestOnTriangle TriangleTree::nearest(const Vec3& point) const {
  NearestOnTriangle best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  search(0, point, best);
  return best;
}

}  // namespace nilas::rigid::geometry
