// Closed triangle meshes and hulls of points. Oracles: solid angles for inside and outside, the nearest of dense
// samples for the distance, formulas and sums of boxes for the integrals.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <stdexcept>

#include "rigid/convex_hull.hpp"
#include "tests/rigid/meshes.hpp"

namespace nilas::rigid {
namespace {

using std::numbers::pi;

struct MeshCase {
  std::string name;
  Mesh mesh;
};
std::ostream& operator<<(std::ostream& out, const MeshCase& c) { return out << c.name; }

std::vector<MeshCase> meshes() {
  return {{"box", test::box_mesh({0.3, 0.5, 0.7}, {0.1, -0.2, 0.4})},
          {"plate", test::box_mesh({2, 1, 0.02}, Vec3::Zero())},
          {"angle", test::angle_mesh()},
          {"box_with_cavity", test::box_with_cavity()},
          {"torus", test::torus_mesh(0.4, 0.15, 24, 16)},
          {"spiked", test::spiked_mesh()},
          {"far_off", test::box_mesh({0.3, 0.5, 0.7}, {400, -300, 100})}};
}

double size_of(const Mesh& mesh) { return enclosing_radius(mesh, centroid(mesh)); }

/// Solid angle of the surface seen from a point, over 4 pi: one inside, zero outside (van Oosterom and Strackee 1983).
double winding_number(const Mesh& mesh, const Vec3& p) {
  double sum = 0;
  for (const Mesh::Triangle& t : mesh.triangles()) {
    const Vec3 a = mesh.vertices()[t[0]] - p, b = mesh.vertices()[t[1]] - p, c = mesh.vertices()[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * pi);
}

/// Evenly over the bounding box, enlarged about its middle.
std::vector<Vec3> random_points(const Mesh& mesh, int count, double enlarged) {
  Vec3 low = mesh.vertices().front(), high = low;
  for (const Vec3& v : mesh.vertices()) low = low.cwiseMin(v), high = high.cwiseMax(v);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.5 * enlarged, 0.5 * enlarged);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const Vec3 at(uniform(random), uniform(random), uniform(random));
    points.push_back(0.5 * (low + high) + (high - low).cwiseProduct(at));
  }
  return points;
}

class EveryMesh : public testing::TestWithParam<MeshCase> {
 protected:
  const Mesh& mesh() const { return GetParam().mesh; }
};
INSTANTIATE_TEST_SUITE_P(Meshes, EveryMesh, testing::ValuesIn(meshes()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(EveryMesh, ClosestPointIsTheNearestOfDenseSamples) {
  const double spacing = size_of(mesh()) / 60;
  const std::vector<Vec3> cloud = test::lattice_on_triangles(mesh(), spacing);
  for (const Vec3& p : random_points(mesh(), 200, 2)) {
    const Closest closest = closest_point(mesh(), p);
    double least = INFINITY;
    for (const Vec3& s : cloud) least = std::min(least, (p - s).squaredNorm());
    least = std::sqrt(least);
    EXPECT_LE(std::abs(closest.distance), least + 1e-12 * size_of(mesh()));
    EXPECT_GE(std::abs(closest.distance), least - spacing);
    const double round_off = 1e-14 * (size_of(mesh()) + p.norm());
    EXPECT_NEAR(closest.normal.norm(), 1, 1e-14);
    EXPECT_LT((p - closest.point - closest.distance * closest.normal).norm(), round_off) << p.transpose();
    EXPECT_NEAR(closest_point(mesh(), closest.point).distance, 0, round_off);
  }
}

TEST_P(EveryMesh, DistanceIsNegativeWhereTheSurfaceSurroundsThePoint) {
  int inside = 0;
  for (const Vec3& p : random_points(mesh(), 2000, 1.2)) {
    const double winding = winding_number(mesh(), p);
    const double distance = closest_point(mesh(), p).distance;
    if (std::abs(distance) < 1e-9) continue;
    EXPECT_EQ(distance<0, winding> 0.5) << p.transpose();
    inside += distance < 0;
  }
  EXPECT_GT(inside, 100);
}

TEST_P(EveryMesh, VerticesAndEdgesSeenFromOutsideHaveNormalsTowardsThePoint) {
  for (const Vec3& vertex : mesh().vertices()) {
    const Closest on = closest_point(mesh(), vertex);
    EXPECT_NEAR(on.distance, 0, 1e-15 * (size_of(mesh()) + vertex.norm()));
    EXPECT_NEAR(on.normal.norm(), 1, 1e-14);
    const Vec3 p = vertex + 0.01 * size_of(mesh()) * on.normal;
    const Closest beside = closest_point(mesh(), p);
    EXPECT_LT((beside.point + beside.distance * beside.normal - p).norm(), 1e-14 * (1 + p.norm()));
    // A saddle's normal may point into the body; at a convex corner it does not.
    if (winding_number(mesh(), p) < 0.5) {
      EXPECT_GT(beside.distance, 0);
    }
  }
}

TEST_P(EveryMesh, VeryDistantPointsGetAFiniteDistanceAndAUnitNormal) {
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0.6, 0, 0.8), Vec3(0, -0.6, -0.8)}) {
    for (const double r : {1e7, 1e9, 1e13, 1e160}) {
      const Closest closest = closest_point(mesh(), centroid(mesh()) + r * direction);
      const double expected = r - direction.dot(support_point(mesh(), direction) - centroid(mesh()));
      // Beyond a corner off the line of sight the distance is longer by up to size^2 / (2 r).
      EXPECT_NEAR(closest.distance, expected, 4 * (size_of(mesh()) * size_of(mesh()) / r + 1e-15 * r));
      EXPECT_NEAR(closest.normal.norm(), 1, 1e-14);
    }
  }
}

TEST_P(EveryMesh, SamplesCoverTheAreaCloseTheSurfaceAndEncloseTheVolume) {
  for (const double spacing : {1.0, 0.05, 0.013}) {
    double area = 0, flux = 0;
    Vec3 closure = Vec3::Zero();
    for (const SurfacePoint& p : surface_points(mesh(), spacing)) {
      EXPECT_NEAR(p.normal.norm(), 1, 1e-15);
      EXPECT_GT(p.area, 0);
      EXPECT_LT(p.area, 1.5 * spacing * spacing);
      area += p.area;
      closure += p.area * p.normal;
      flux += p.area * p.normal.dot(p.position - centroid(mesh()));
    }
    EXPECT_NEAR(area, surface_area(mesh()), 1e-12 * area);
    EXPECT_LT(closure.norm(), 1e-12 * area);
    EXPECT_NEAR(flux / 3, volume(mesh()), 1e-11 * size_of(mesh()) * area);
  }
}

TEST_P(EveryMesh, SamplesLieOnTheSurfaceAndTheirNormalsPointOutward) {
  for (const SurfacePoint& p : surface_points(mesh(), size_of(mesh()) / 10)) {
    const Closest closest = closest_point(mesh(), p.position);
    EXPECT_NEAR(closest.distance, 0, 1e-14 * (size_of(mesh()) + p.position.norm()));
    EXPECT_LT((closest.normal - p.normal).norm(), 1e-12);
    EXPECT_GT(winding_number(mesh(), p.position - 1e-6 * p.normal), 0.5);
    EXPECT_LT(winding_number(mesh(), p.position + 1e-6 * p.normal), 0.5);
  }
}

TEST_P(EveryMesh, SupportPointAndRadiiAreThoseOfTheVertices) {
  const Vec3 centre = centroid(mesh()) + Vec3(0.1, -0.2, 0.3);
  Vec3 radii = Vec3::Zero();
  for (const Vec3& v : mesh().vertices()) {
    const Vec3 r = v - centre;
    for (int k = 0; k < 3; ++k) radii[k] = std::max(radii[k], (r - r[k] * Vec3::Unit(k)).norm());
    EXPECT_LE((v - centre).norm(), enclosing_radius(mesh(), centre));
    for (const Vec3& d : {Vec3(1, 0, 0), Vec3(0, 0.6, -0.8)}) EXPECT_LE(d.dot(v), d.dot(support_point(mesh(), d)));
  }
  EXPECT_LT((enclosing_radii(mesh(), centre) - radii).norm(), 1e-14 * radii.norm());
}

TEST_P(EveryMesh, OutlineIsTheConvexOneOfTheProjectionAlongX) {
  const std::vector<Vec3> curve = outline(mesh());
  EXPECT_EQ(curve.front(), curve.back());
  double low = INFINITY, high = -INFINITY;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_EQ(curve[i].x(), 0);
    low = std::min(low, curve[i].z());
    high = std::max(high, curve[i].z());
    if (i + 2 >= curve.size()) continue;
    const Vec3 turn = (curve[i + 1] - curve[i]).cross(curve[i + 2] - curve[i + 1]);
    EXPECT_GT(turn.x(), -1e-12);
  }
  EXPECT_NEAR(high, support_point(mesh(), Vec3::UnitZ()).z(), 1e-12);
  EXPECT_NEAR(low, support_point(mesh(), -Vec3::UnitZ()).z(), 1e-12);
}

TEST_P(EveryMesh, InsideOutIsTurned) {
  std::vector<Mesh::Triangle> inverted = mesh().triangles();
  for (Mesh::Triangle& t : inverted) std::swap(t[0], t[1]);
  const Mesh turned(mesh().vertices(), inverted);
  EXPECT_NEAR(volume(turned), volume(mesh()), 1e-13 * volume(mesh()));
  for (const Vec3& p : random_points(mesh(), 100, 2))
    EXPECT_NEAR(closest_point(turned, p).distance, closest_point(mesh(), p).distance, 1e-13 * (1 + p.norm()));
}

// Means over random points; the bounds are five standard deviations of them, of which R and R^2 are upper bounds.
TEST_P(EveryMesh, VolumeCentroidAndInertiaAreThoseOfRandomPointsInside) {
  constexpr int count = 4000;
  const double R = size_of(mesh());
  Vec3 low = mesh().vertices().front(), high = low;
  for (const Vec3& v : mesh().vertices()) low = low.cwiseMin(v), high = high.cwiseMax(v);
  const double box_volume = (1.1 * (high - low)).prod();
  int inside = 0;
  Vec3 sum = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const Vec3& p : random_points(mesh(), count, 1.1)) {
    if (winding_number(mesh(), p) < 0.5) continue;
    const Vec3 r = p - centroid(mesh());
    ++inside;
    sum += r;
    second += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
  }
  const double fraction = double(inside) / count;
  EXPECT_NEAR(fraction * box_volume, volume(mesh()), 5 * box_volume * std::sqrt(fraction * (1 - fraction) / count));
  EXPECT_LT((sum / inside).cwiseAbs().maxCoeff(), 5 * R / std::sqrt(inside));
  EXPECT_LT((second / inside - inertia_tensor_per_mass(mesh())).cwiseAbs().maxCoeff(), 5 * R * R / std::sqrt(inside));
}

TEST(Mesh, OfABoxHasItsIntegrals) {
  const Box box{{0.3, 0.5, 0.7}};
  for (const Vec3& centre : {Vec3(0, 0, 0), Vec3(0.1, -0.2, 0.4), Vec3(400, -300, 100)}) {
    const Mesh mesh = test::box_mesh(box.size, centre);
    const double round_off = 1e-15 * (1 + centre.norm());
    EXPECT_NEAR(volume(mesh), volume(box), 10 * round_off);
    EXPECT_NEAR(surface_area(mesh), surface_area(box), 10 * round_off);
    EXPECT_LT((centroid(mesh) - centre).norm(), 10 * round_off);
    EXPECT_LT((inertia_per_mass(mesh) - inertia_per_mass(box)).norm(), 10 * round_off);
  }
}

TEST(Mesh, OfATorusConvergesToItsTextbookIntegralsAtSecondOrder) {
  const double R = 0.4, r = 0.15;
  const double exact = 2 * pi * pi * R * r * r;
  const Vec3 moments(R * R / 2 + 5 * r * r / 8, R * R / 2 + 5 * r * r / 8, R * R + 0.75 * r * r);
  const auto errors = [&](int n) {
    const Mesh mesh = test::torus_mesh(R, r, 2 * n, n);
    return std::pair(volume(mesh) / exact - 1, (inertia_per_mass(mesh) - moments).norm() / moments.norm());
  };
  const auto coarse = errors(24), fine = errors(96);
  EXPECT_NEAR(std::log(coarse.first / fine.first) / std::log(4.0), 2, 0.05);
  EXPECT_NEAR(std::log(coarse.second / fine.second) / std::log(4.0), 2, 0.05);
}

TEST(Mesh, WhoseAxesAreNotPrincipalHasATensorButNoPrincipalMoments) {
  const Mesh angle = test::angle_mesh();
  EXPECT_GT(std::abs(inertia_tensor_per_mass(angle)(0, 2)), 1e-3);
  try {
    inertia_per_mass(angle);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("mesh: product of inertia zx is 0.")) << error.what();
  }
}

std::string refusal(const std::vector<Vec3>& vertices, const std::vector<Mesh::Triangle>& triangles) {
  try {
    Mesh(vertices, triangles);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Mesh, ThatIsNoClosedSurfaceIsRefusedByWhatIsWrong) {
  const std::vector<Vec3> v = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  const std::vector<Mesh::Triangle> good = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_EQ(refusal(v, good), "");
  EXPECT_EQ(refusal(v, {}), "mesh: has no triangles");
  EXPECT_EQ(refusal(v, {good[0], good[1], good[2]}),
            "mesh: is open: only one triangle has the edge from (0, 0, 0) m to (0, 1, 0) m");
  EXPECT_EQ(
      refusal(v, {{0, 1, 2}, good[1], good[2], good[3]}),
      "mesh: at the edge from (0, 0, 0) m to (1, 0, 0) m two triangles are turned opposite ways, or more than two "
      "meet");
  EXPECT_EQ(refusal(v, {good[0], good[1], good[2], {2, 0, 7}}), "mesh: triangle 3 has vertex 7, allowed: 0 to 4");
  EXPECT_EQ(refusal(v, {good[0], {0, 3, 4}}), "mesh: triangle 1 at (0, 0, 0) m has no area");
  EXPECT_EQ(refusal(v, {{0, 1, 2}, {0, 2, 1}}), "mesh: encloses no volume");
  EXPECT_EQ(refusal({{0, 0, NAN}, v[1], v[2], v[3]}, good), "mesh: vertex 0 is not finite");
}

TEST(Mesh, CopiesShareTheirTriangles) {
  const Mesh one = test::angle_mesh();
  const Shape copy = one;
  EXPECT_EQ(&std::get<Mesh>(copy).vertices(), &one.vertices());
}

TEST(ConvexHull, OfABoxFullOfPointsIsTheBox) {
  std::vector<Vec3> points;
  for (const double x : {-0.5, 0.0, 0.25, 0.5})
    for (const double y : {-1.0, 0.1, 1.0})
      for (const double z : {0.0, 0.3, 2.0}) points.emplace_back(x, y, z);  // many in a line or a plane
  const Mesh hull = convex_hull(points);
  EXPECT_NEAR(volume(hull), 1 * 2 * 2, 1e-15 * 4);
  EXPECT_NEAR(surface_area(hull), 2 * (2 + 4 + 2), 1e-15 * 16);
}

/// Every vertex of the hull is one of the points and every point lies in it, to the grid's precision.
void expect_hull(const Mesh& hull, const std::vector<Vec3>& points, double tolerance) {
  for (const Vec3& v : hull.vertices()) {
    double nearest = INFINITY;
    for (const Vec3& p : points) nearest = std::min(nearest, (v - p).norm());
    EXPECT_LT(nearest, tolerance);
  }
  for (const Vec3& p : points) {
    for (const Mesh::Triangle& t : hull.triangles()) {
      const Vec3 &a = hull.vertices()[t[0]], &b = hull.vertices()[t[1]], &c = hull.vertices()[t[2]];
      EXPECT_LT((p - a).dot((b - a).cross(c - a).normalized()), tolerance);
    }
  }
}

TEST(ConvexHull, HoldsEveryPointAndHasNoOtherCorners) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Vec3> ball, turned_grid, twice;
  for (int i = 0; i < 200; ++i) ball.push_back(Vec3(normal(random), normal(random), normal(random)).normalized());
  const Quat turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      for (int k = 0; k < 5; ++k) turned_grid.push_back(turn * Vec3(0.1 * i, 0.2 * j, 0.3 * k) + Vec3(7, 8, 9));
  twice = ball;
  twice.insert(twice.end(), ball.begin(), ball.end());
  for (const auto& points : {ball, turned_grid, twice}) expect_hull(convex_hull(points), points, std::ldexp(2, -22));
  EXPECT_EQ(convex_hull(ball).vertices().size(), ball.size());
  EXPECT_EQ(convex_hull(twice).triangles().size(), 2 * ball.size() - 4);  // Euler
}

TEST(ConvexHull, OfPointsInAPlaneIsRefused) {
  const auto refused = [](const std::vector<Vec3>& points) -> std::string {
    try {
      convex_hull(points);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refused({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}),
            "convex hull: the 4 points lie in a plane, must span a volume");
  EXPECT_EQ(refused({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}), "convex hull: the 3 points lie in a plane, must span a volume");
  EXPECT_EQ(refused({{1, 2, 3}, {1, 2, 3}}), "convex hull: the points have no extent, must span a volume");
  EXPECT_EQ(refused({}), "convex hull: the points have no extent, must span a volume");
  EXPECT_EQ(refused({{1, 2, INFINITY}}), "convex hull: a point is not finite");
}

}  // namespace
}  // namespace nilas::rigid
