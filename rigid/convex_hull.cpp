#include "rigid/convex_hull.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

namespace nilas::rigid {
namespace {

constexpr int grid_bits = 24;
/// Differences of grid points have 25 bits, their cross products 51, the volume of a tetrahedron 78.
using Whole3 = Eigen::Matrix<std::int64_t, 3, 1>;
__extension__ using Wide = __int128;

struct Face {
  Mesh::Triangle corners;
  Whole3 normal;
};

class Hull {
 public:
  /// Points of whole coordinates, exact in double.
  explicit Hull(std::vector<Vec3> points) : points_(std::move(points)) {
    start_with_tetrahedron();
    for (int p = 0; p < static_cast<int>(points_.size()); ++p) add(p);
  }
  const std::vector<Face>& faces() const { return faces_; }

 private:
  Whole3 between(int from, int to) const { return (points_[to] - points_[from]).cast<std::int64_t>(); }
  Face face(int a, int b, int c) const { return {{a, b, c}, between(a, b).cross(between(a, c))}; }
  /// Positive outside the face's plane, zero in it.
  Wide height(const Face& f, int p) const {
    const Whole3 r = between(f.corners[0], p);
    return Wide(f.normal.x()) * r.x() + Wide(f.normal.y()) * r.y() + Wide(f.normal.z()) * r.z();
  }

  template <class Measure>
  int farthest(const Measure& measure) const {
    int best = 0;
    for (int p = 1; p < static_cast<int>(points_.size()); ++p)
      if (measure(p) > measure(best)) best = p;
    return best;
  }

  /// Each corner is the point farthest from the point, line or plane of those before it.
  void start_with_tetrahedron() {
    const int a = 0;
    const int b = farthest([&](int p) { return between(a, p).squaredNorm(); });
    const int c = farthest([&](int p) { return face(a, b, p).normal.cast<double>().squaredNorm(); });
    const Face base = face(a, b, c);
    const auto above = [&](int p) { return height(base, p) < 0 ? -height(base, p) : height(base, p); };
    const int d = farthest(above);
    if (above(d) == 0) {
      std::ostringstream message;
      message << "convex hull: the " << points_.size() << " points lie in a plane, must span a volume";
      throw std::invalid_argument(message.str());
    }
    const bool up = height(base, d) > 0;
    const int first = up ? b : a, second = up ? a : b;  // the base seen from outside
    faces_ = {face(first, second, c), face(second, first, d), face(c, second, d), face(first, c, d)};
  }

  /// Replaces the faces that the point is outside of by a fan from it to their rim.
  void add(int p) {
    const auto unseen_end =
        std::partition(faces_.begin(), faces_.end(), [&](const Face& f) { return height(f, p) <= 0; });
    std::set<std::pair<int, int>> edges;  // of the seen faces
    for (auto f = unseen_end; f != faces_.end(); ++f)
      for (int k = 0; k < 3; ++k) edges.emplace(f->corners[k], f->corners[(k + 1) % 3]);
    faces_.erase(unseen_end, faces_.end());
    for (const auto& [from, to] : edges)
      if (!edges.contains({to, from})) faces_.push_back(face(from, to, p));
  }

  std::vector<Vec3> points_;
  std::vector<Face> faces_;
};

/// The length of the grid's step [m], a power of two.
double grid_step(const std::vector<Vec3>& points) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : points) {
    if (!p.allFinite()) throw std::invalid_argument("convex hull: a point is not finite");
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double extent = points.empty() ? 0 : (high - low).maxCoeff();
  if (!(extent > 0) || !std::isfinite(extent))
    throw std::invalid_argument("convex hull: the points have no extent, must span a volume");
  return std::ldexp(1.0, std::ilogb(extent) + 1 - grid_bits);
}

}  // namespace

Mesh convex_hull(const std::vector<Vec3>& points) {
  const double step = grid_step(points);
  std::vector<Vec3> on_grid;
  for (const Vec3& p : points) on_grid.push_back((p / step).array().round());
  const Hull hull(on_grid);
  std::vector<Vec3> vertices;
  std::vector<int> vertex_of(points.size(), -1);
  std::vector<Mesh::Triangle> triangles;
  for (const Face& face : hull.faces()) {
    Mesh::Triangle triangle = face.corners;
    for (int& corner : triangle) {
      int& vertex = vertex_of[corner];
      if (vertex < 0) {
        vertex = static_cast<int>(vertices.size());
        vertices.push_back(step * on_grid[corner]);
      }
      corner = vertex;
    }
    triangles.push_back(triangle);
  }
  return Mesh(std::move(vertices), std::move(triangles));
}

}  // namespace nilas::rigid
