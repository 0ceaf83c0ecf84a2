// Unions of placed shapes. Oracle: membership is that of any part; the nearest of the parts' samples that are in no
// other part; textbook sums.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <random>
#include <stdexcept>

#include "rigid/mass_properties.hpp"
#include "tests/rigid/meshes.hpp"
#include "tests/rigid/shape_oracle.hpp"

namespace nilas::rigid {
namespace {

Quat turned(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

Vec3 into(const Part& part, const Vec3& p) { return part.orientation.conjugate() * (p - part.position); }

/// Parts of closed form, overlapping, turned.
Compound hammer() {
  return Compound{{{Cylinder{0.8, 0.1}, {0, 0, 0}, Quat::Identity()},
                   {Box{{0.2, 0.5, 0.2}}, {0.02, 0, 0.4}, turned(0.3, {1, 2, 3})},
                   {Sphere{0.18}, {0, 0.01, -0.4}, Quat::Identity()},
                   {Cone{0.3, 0.2}, {0, 0.3, 0.4}, turned(-1.4, {1, 0, 0.1})}}};
}

TEST(Compound, ContainsAPointIfOneOfItsPartsDoes) {
  const Compound shape = hammer();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p(uniform(random), uniform(random), uniform(random));
    const bool within = std::any_of(shape.parts.begin(), shape.parts.end(),
                                    [&](const Part& part) { return oracle::level(part.shape, into(part, p)) < 0; });
    EXPECT_EQ(closest_point(shape, p).distance < 0, within);
    inside += within;
  }
  EXPECT_GT(inside, 50);
}

/// Points of the parts' surfaces that lie in no other part.
std::vector<Vec3> exposed_cloud(const Compound& shape, double& gap) {
  std::vector<Vec3> points;
  for (const Part& own : shape.parts) {
    const oracle::Cloud cloud = oracle::cloud(own.shape);
    gap = std::max(gap, cloud.gap);
    for (const Vec3& s : cloud.points) {
      const Vec3 p = own.orientation * s + own.position;
      const bool covered = std::any_of(shape.parts.begin(), shape.parts.end(), [&](const Part& part) {
        return &part != &own && oracle::level(part.shape, into(part, p)) < 0;
      });
      if (!covered) points.push_back(p);
    }
  }
  return points;
}

TEST(Compound, ClosestPointIsTheNearestOfTheUnionOutsideAndNoFartherInside) {
  const Compound shape = hammer();
  double gap = 0;
  const std::vector<Vec3> cloud = exposed_cloud(shape, gap);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-0.7, 0.7);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p(uniform(random), uniform(random), uniform(random));
    const Closest closest = closest_point(shape, p);
    double least = INFINITY;
    for (const Vec3& s : cloud) least = std::min(least, (s - p).norm());
    EXPECT_LE(std::abs(closest.distance), least + 1e-12);
    EXPECT_LT((closest.point + closest.distance * closest.normal - p).norm(), 1e-14);
    EXPECT_NEAR(closest.normal.norm(), 1, 1e-14);
    // Near the cut between two parts the cloud ends up to a gap short of it.
    if (closest.distance > 0) {
      EXPECT_GE(closest.distance, least - 2 * gap);
    }
  }
}

TEST(Compound, OfOnePlacedPartIsThatPart) {
  const Part part{Cone{0.3, 0.2}, {1, 2, 3}, turned(0.7, {1, -1, 2})};
  const Shape shape = Compound{{part}};
  for (const Vec3& local : {Vec3(0, 0, 0.3), Vec3(0.2, 0.1, 0), Vec3(0.01, 0, -0.1)}) {
    const Closest here = closest_point(shape, part.orientation * local + part.position);
    const Closest there = closest_point(part.shape, local);
    EXPECT_NEAR(here.distance, there.distance, 1e-15);
    EXPECT_LT((here.normal - part.orientation * there.normal).norm(), 1e-14);
  }
  EXPECT_EQ(volume(shape), volume(part.shape));
  EXPECT_EQ(surface_area(shape), surface_area(part.shape));
  EXPECT_LT((centroid(shape) - (part.orientation * centroid(part.shape) + part.position)).norm(), 1e-15);
  const Vec3 d = Vec3(1, 2, -1).normalized();
  EXPECT_LT(
      (support_point(shape, part.orientation * d) - part.orientation * support_point(part.shape, d) - part.position)
          .norm(),
      1e-15);
  EXPECT_NEAR(enclosing_radius(shape, part.position), enclosing_radius(part.shape, Vec3::Zero()), 1e-15);
  EXPECT_EQ(surface_points(shape, 0.02).size(), surface_points(part.shape, 0.02).size());
}

// A dumb-bell in pieces: its capsule is the same body as a cylinder and two balls only without overlap, so balls apart.
TEST(Compound, OfPartsApartHasTheSumsOfTheirIntegrals) {
  const double r = 0.1, a = 0.5, density = 1000;
  const Shape two_balls = Compound{{{Sphere{2 * r}, {0, 0, a}}, {Sphere{2 * r}, {0, 0, -a}}}};
  const double ball = 4.0 / 3 * std::numbers::pi * r * r * r;
  EXPECT_NEAR(volume(two_balls), 2 * ball, 1e-16);
  EXPECT_LT(centroid(two_balls).norm(), 1e-16);
  const MassProperties mass = from_density(two_balls, density);
  EXPECT_NEAR(mass.inertia.x(), 2 * density * ball * (0.4 * r * r + a * a), 1e-12);
  EXPECT_NEAR(mass.inertia.z(), 2 * density * ball * 0.4 * r * r, 1e-14);
  EXPECT_TRUE(check(mass, two_balls).size() == 1u);  // the centre of mass lies between the balls
}

TEST(Compound, OfBoxesThatTouchIsTheWholeBox) {
  const Box whole{{0.4, 0.6, 1.0}};
  const Shape halves = Compound{{{Box{{0.4, 0.6, 0.3}}, {0, 0, -0.35}},
                                 {Box{{0.4, 0.7, 0.6}}, {0, 0, 0.15}, turned(std::numbers::pi / 2, {1, 0, 0})}}};
  EXPECT_NEAR(volume(halves), volume(whole), 1e-15);
  EXPECT_LT((inertia_per_mass(halves) - inertia_per_mass(whole)).norm(), 1e-15);
  double area = 0;
  Vec3 closure = Vec3::Zero();
  for (const SurfacePoint& p : surface_points(halves, 0.02)) {
    area += p.area;
    closure += p.area * p.normal;
    EXPECT_NEAR(closest_point(whole, p.position).distance, 0, 1e-15);
    EXPECT_LT((closest_point(whole, p.position).normal - p.normal).norm(), 1e-14);
  }
  EXPECT_NEAR(area, surface_area(whole), 1e-12);
  EXPECT_LT(closure.norm(), 1e-12);
}

TEST(Compound, FacesThatTwoPartsShareAreSampledOnce) {
  const Box whole{{0.4, 0.6, 1.0}};
  // They overlap from z = -0.1 to 0.1, flush on four sides.
  const Shape overlapping = Compound{{{Box{{0.4, 0.6, 0.6}}, {0, 0, -0.2}}, {Box{{0.4, 0.6, 0.6}}, {0, 0, 0.2}}}};
  double area = 0;
  for (const SurfacePoint& p : surface_points(overlapping, 0.02)) area += p.area;
  EXPECT_NEAR(area, surface_area(whole), 1e-12);  // the cells end at the overlap's ends
}

TEST(Compound, SamplesLieOnTheUnionAndItsAreaAndClosureConvergeWithTheSpacing) {
  // Two unit balls, centres one radius apart: each loses a cap of height r/2, so the area is 2 (4 pi r^2 - pi r^2).
  const double r = 0.5;
  const Shape balls = Compound{{{Sphere{2 * r}, {0, -r / 2, 0}}, {Sphere{2 * r}, {0, r / 2, 0}}}};
  const double exact = 6 * std::numbers::pi * r * r;
  const double cut = 2 * std::numbers::pi * r * std::sqrt(0.75);
  for (const double spacing : {0.1, 0.03, 0.01}) {
    double area = 0;
    Vec3 closure = Vec3::Zero();
    for (const SurfacePoint& p : surface_points(balls, spacing)) {
      area += p.area;
      closure += p.area * p.normal;
      EXPECT_NEAR(closest_point(balls, p.position).distance, 0, 1e-14);
    }
    EXPECT_NEAR(area, exact, cut * spacing);
    EXPECT_LT(closure.norm(), cut * spacing);
  }
}

TEST(Compound, MayHoldCompoundsAndMeshes) {
  const Mesh angle = test::angle_mesh();
  const Compound inner{{{angle, {0.1, 0, 0}, turned(0.4, {0, 1, 0})}}};
  const Shape outer = Compound{{{inner, {0, 0.2, 0}, turned(-0.3, {1, 0, 0})}}};
  const Quat turn = turned(-0.3, {1, 0, 0}) * turned(0.4, {0, 1, 0});
  const Vec3 move = Vec3(0, 0.2, 0) + turned(-0.3, {1, 0, 0}) * Vec3(0.1, 0, 0);
  EXPECT_NEAR(volume(outer), volume(angle), 1e-16);
  EXPECT_LT((centroid(outer) - (turn * centroid(angle) + move)).norm(), 1e-15);
  const Mat3 R = turn.toRotationMatrix();
  EXPECT_LT((inertia_tensor_per_mass(outer) - R * inertia_tensor_per_mass(angle) * R.transpose()).norm(), 1e-15);
  const Vec3 p(0.3, 0.1, -0.2);
  EXPECT_NEAR(closest_point(outer, turn * p + move).distance, closest_point(angle, p).distance, 1e-15);
  EXPECT_NO_THROW(validate(outer));
}

TEST(Compound, TurnedToItsPrincipalAxesHasPrincipalMoments) {
  const Mesh angle = test::angle_mesh();
  EXPECT_THROW(from_density(angle, 1000), std::invalid_argument);
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(inertia_tensor_per_mass(angle));
  Mat3 axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  const Shape turned_angle = Compound{{{angle, Vec3::Zero(), Quat(Mat3(axes.transpose()))}}};
  EXPECT_LT((inertia_per_mass(turned_angle) - principal.eigenvalues()).norm(), 1e-15);
  EXPECT_TRUE(check(from_density(turned_angle, 1000), turned_angle).empty());
}

TEST(Compound, EnclosingRadiiAreThoseOfTheFarthestMatter) {
  const Compound shape = hammer();
  double gap = 0;
  const std::vector<Vec3> cloud = exposed_cloud(shape, gap);
  for (const Vec3& c : {Vec3(0, 0, 0), Vec3(0.3, -0.2, 1), centroid(shape)}) {
    double about_point = 0;
    Vec3 about_axes = Vec3::Zero();
    for (const Vec3& s : cloud) {
      const Vec3 r = s - c;
      about_point = std::max(about_point, r.norm());
      for (int k = 0; k < 3; ++k) about_axes[k] = std::max(about_axes[k], (r - r[k] * Vec3::Unit(k)).norm());
    }
    EXPECT_GE(enclosing_radius(shape, c), about_point - 1e-14);
    EXPECT_LE(enclosing_radius(shape, c), about_point + gap);
    const Vec3 radii = enclosing_radii(shape, c);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(radii[k], about_axes[k] - 1e-14);
      EXPECT_LE(radii[k], (about_axes[k] + gap) * (1 + 5e-6));
    }
  }
}

TEST(Compound, RadiusAboutAnAxisIsAtMostFiveMillionthsTooLarge) {
  const Shape ball = Compound{{{Sphere{0.2}, {0.1, 0.37, -0.83}}}};
  const double exact = std::hypot(0.37, 0.83) + 0.1;
  EXPECT_GE(enclosing_radii(ball, Vec3::Zero()).x(), exact * (1 - 1e-15));
  EXPECT_LE(enclosing_radii(ball, Vec3::Zero()).x(), exact * (1 + 5e-6));
}

TEST(Compound, OutlineIsTheConvexOneOfTheProjection) {
  const std::vector<Vec3> curve = outline(hammer());
  EXPECT_EQ(curve.front(), curve.back());
  double high = -1e9, low = 1e9;
  for (const Vec3& p : curve) {
    EXPECT_EQ(p.x(), 0);
    high = std::max(high, p.z());
    low = std::min(low, p.z());
  }
  EXPECT_NEAR(high, support_point(hammer(), Vec3::UnitZ()).z(), 1e-12);
  EXPECT_NEAR(low, -0.4 - 0.09, 1e-12);
}

std::string refusal(const Compound& compound) {
  try {
    surface_points(compound, 0.1);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Compound, WithoutPartsOrWithOneThatIsWrongIsRefusedByPart) {
  EXPECT_EQ(refusal({}), "compound: has no parts, must have at least one");
  EXPECT_EQ(refusal({{{Sphere{1}}, {Cone{-1, 1}}}}),
            "compound: part 1: cone: length = -1 m, must be positive and finite");
  EXPECT_EQ(refusal({{{Sphere{1}, {0, NAN, 0}}}}), "compound: part 0: position is not finite");
  EXPECT_EQ(refusal({{{Sphere{1}, {0, 0, 0}, Quat(2, 0, 0, 0)}}}),
            "compound: part 0: orientation is no unit quaternion");
  EXPECT_EQ(refusal({{{Compound{{{Sphere{0}}}}}}}),
            "compound: part 0: compound: part 0: sphere: diameter = 0 m, must be positive and finite");
}

}  // namespace
}  // namespace nilas::rigid
