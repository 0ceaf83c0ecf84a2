#include "rigid/shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <stdexcept>

#include "tests/rigid/shape_oracle.hpp"

namespace nilas::rigid {
namespace {

using oracle::Case;
using std::numbers::pi;

constexpr double round_off = 1e-13;  // relative to the size of the shape

double size_of(const Shape& shape) {
  const oracle::Bounds b = oracle::bounds(shape);
  return (b.high - b.low).norm();
}

double smallest_extent(const Shape& shape) {
  const oracle::Bounds b = oracle::bounds(shape);
  return (b.high - b.low).minCoeff();
}

/// Inside, outside, on the axes and the planes of symmetry, on edges, near and far.
std::vector<Vec3> query_points(const Shape& shape) {
  const oracle::Bounds b = oracle::bounds(shape);
  const Vec3 middle = 0.5 * (b.low + b.high), half = 0.5 * (b.high - b.low);
  std::vector<Vec3> points;
  for (const double x : {0.0, 1e-12, 0.3, 0.8, 1.0, 1.5, 40.0}) {
    for (const double y : {0.0, -0.4, 1.0, -1.2}) {
      for (const double z : {-30.0, -1.3, -1.0, -0.95, -0.6, 0.0, 0.2, 0.75, 0.9, 1.0, 1.1, 20.0}) {
        points.push_back(middle + half.cwiseProduct(Vec3(x, y, z)));
      }
    }
  }
  if (const auto* h = std::get_if<Hcc>(&shape)) {
    for (const double rho : {0.0, 0.1, 0.5, 1.0, 1.7}) {
      points.emplace_back(rho * h->diameter / 2, 0, -h->nose_length);  // in the nose's base
      for (const double below : {1e-9, 0.01, 0.1, 0.5}) {
        points.emplace_back(0, rho * h->diameter / 2, -h->nose_length - below * h->nose_length);
      }
    }
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.4, 1.4);
  for (int i = 0; i < 200; ++i) {
    points.push_back(middle + half.cwiseProduct(Vec3(uniform(random), uniform(random), uniform(random))));
  }
  return points;
}

class EveryShape : public testing::TestWithParam<Case> {
 protected:
  const Shape& shape() const { return GetParam().shape; }
};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, testing::ValuesIn(oracle::cases()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(EveryShape, VolumeCentroidAndInertiaAreThoseOfQuadratureOverSlices) {
  const oracle::Integrals expected = oracle::integrate(shape());
  EXPECT_NEAR(volume(shape()), expected.volume, 1e-8 * expected.volume);
  EXPECT_LT((centroid(shape()) - expected.centroid).norm(), 1e-8 * size_of(shape()));
  const Vec3 inertia = inertia_per_mass(shape());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(inertia[i], expected.inertia_per_mass[i], 1e-8 * inertia.maxCoeff());
}

TEST_P(EveryShape, SurfaceAreaIsThatOfTheRevolvedMeridian) {
  if (const auto* box = std::get_if<Box>(&shape())) {
    const double x = box->size.x(), y = box->size.y(), z = box->size.z();
    EXPECT_DOUBLE_EQ(surface_area(shape()), x * y * 2 + x * z * 2 + y * z * 2);
  } else {
    const double expected = oracle::revolved_area(shape());
    EXPECT_NEAR(surface_area(shape()), expected, 1e-9 * expected);
  }
}

TEST_P(EveryShape, AreasOfSamplesSumToTheSurfaceArea) {
  for (const double spacing : {0.3, 0.05, 0.013}) {
    double sum = 0;
    for (const SurfacePoint& p : surface_points(shape(), spacing)) sum += p.area;
    EXPECT_NEAR(sum, surface_area(shape()), 1e-12 * sum) << spacing;
  }
}

TEST_P(EveryShape, AreaVectorsOfSamplesSumToZero) {
  for (const double spacing : {0.3, 0.05, 0.013}) {
    Vec3 sum = Vec3::Zero();
    for (const SurfacePoint& p : surface_points(shape(), spacing)) sum += p.area * p.normal;
    EXPECT_LT(sum.norm(), 1e-12 * surface_area(shape())) << spacing;
  }
}

// Gauss: the flux of x through the surface is three times the volume.
TEST_P(EveryShape, FluxOfThePositionConvergesToThreeVolumesAtSecondOrder) {
  const auto error = [&](double spacing) {
    double flux = 0;
    for (const SurfacePoint& p : surface_points(shape(), spacing)) {
      flux += p.area * p.normal.dot(p.position - centroid(shape()));
    }
    return std::abs(flux / (3 * volume(shape())) - 1);
  };
  const double coarse = size_of(shape()) / 96;  // a blunt nose has some 15 rings: the asymptotic range
  const double e1 = error(coarse), e2 = error(coarse / 8);
  if (e1 < 1e-11) {
    EXPECT_LT(e2, 1e-10);  // flat faces, round walls and spheres are exact, to the round-off of a million terms
  } else {
    EXPECT_NEAR(std::log(e1 / e2) / std::log(8.0), 2, 0.15);  // the ring counts are rounded, so not quite 2
  }
}

TEST_P(EveryShape, SamplesLieOnTheSurfaceAndCarryItsNormal) {
  for (const SurfacePoint& p : surface_points(shape(), size_of(shape()) / 40)) {
    EXPECT_NEAR(oracle::level(shape(), p.position), 0, round_off);
    const Closest closest = closest_point(shape(), p.position);
    EXPECT_NEAR(closest.distance, 0, round_off * size_of(shape()));
    EXPECT_LT((closest.point - p.position).norm(), round_off * size_of(shape()));
    EXPECT_LT((closest.normal - p.normal).norm(), 1e-11);
    EXPECT_NEAR(p.normal.norm(), 1, 1e-15);
    EXPECT_GT(p.area, 0);
  }
}

std::vector<std::array<double, 7>> sorted_rows(const std::vector<SurfacePoint>& points, const Vec3& mirror) {
  std::vector<std::array<double, 7>> rows;
  for (const SurfacePoint& p : points) {
    const Vec3 x = mirror.cwiseProduct(p.position), n = mirror.cwiseProduct(p.normal);
    rows.push_back({x.x(), x.y(), x.z(), n.x(), n.y(), n.z(), p.area});
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

TEST_P(EveryShape, SamplesAreMirrorImagesBitForBit) {
  const std::vector<SurfacePoint> points = surface_points(shape(), size_of(shape()) / 37);
  const auto rows = sorted_rows(points, {1, 1, 1});
  EXPECT_EQ(rows, sorted_rows(points, {-1, 1, 1}));
  EXPECT_EQ(rows, sorted_rows(points, {1, -1, 1}));
  if (!std::holds_alternative<Hcc>(shape()) && !std::holds_alternative<Cone>(shape())) {
    EXPECT_EQ(rows, sorted_rows(points, {1, 1, -1}));
  }
}

TEST_P(EveryShape, SamplesOfBodiesOfRevolutionStartHalfAnIntervalOffTheXAxis) {
  if (std::holds_alternative<Box>(shape())) return;
  for (const SurfacePoint& p : surface_points(shape(), size_of(shape()) / 37)) {
    EXPECT_GT(std::abs(p.position.x()), 0);
    EXPECT_GT(std::abs(p.position.y()), 0);
  }
}

TEST_P(EveryShape, SamplesAreAboutTheSpacingApart) {
  const double spacing = smallest_extent(shape()) / 10;
  for (const SurfacePoint& p : surface_points(shape(), spacing)) {
    // The first ring about a sharp tip has four samples however short it is.
    const bool at_tip = std::holds_alternative<Cone>(shape()) && std::hypot(p.position.x(), p.position.y()) < spacing;
    EXPECT_GT(p.area, at_tip ? 0 : 0.5 * spacing * spacing);
    EXPECT_LT(p.area, 2 * spacing * spacing);
  }
}

TEST_P(EveryShape, SpacingBeyondTheSizeStillCoversTheSurface) {
  const std::vector<SurfacePoint> points = surface_points(shape(), 100 * size_of(shape()));
  EXPECT_GE(points.size(), 6u);
}

// For a convex body the plane through the nearest point with its normal has the whole body behind it, and the query
// point lies on the normal: that alone proves the outside case; inside, no point of the surface may be nearer.
TEST_P(EveryShape, ClosestPointIsTheNearestOfTheSurface) {
  const oracle::Cloud cloud = oracle::cloud(shape());
  for (const Vec3& p : query_points(shape())) {
    const Closest closest = closest_point(shape(), p);
    const double scale = size_of(shape()) + p.norm();
    EXPECT_NEAR(oracle::level(shape(), closest.point), 0, round_off) << p.transpose();
    EXPECT_NEAR(closest.normal.norm(), 1, 1e-14) << p.transpose();
    EXPECT_NEAR((p - closest.point).norm(), std::abs(closest.distance), round_off * scale) << p.transpose();
    EXPECT_LT((p - closest.point - closest.distance * closest.normal).norm(), round_off * scale) << p.transpose();

    double nearest = 1e9, beyond = -1e9;
    for (const Vec3& s : cloud.points) {
      nearest = std::min(nearest, (s - p).norm());
      beyond = std::max(beyond, closest.normal.dot(s - closest.point));
    }
    EXPECT_LT(beyond, round_off * scale) << p.transpose();
    EXPECT_LE(std::abs(closest.distance), nearest + round_off * scale) << p.transpose();
    EXPECT_LE(nearest, std::abs(closest.distance) + cloud.gap) << p.transpose();
  }
}

TEST_P(EveryShape, DistanceIsNegativeInsideAndPositiveOutside) {
  for (const Vec3& p : query_points(shape())) {
    const double level = oracle::level(shape(), p);
    const double distance = closest_point(shape(), p).distance;
    if (std::abs(level) > round_off) {
      EXPECT_EQ(distance < 0, level < 0) << p.transpose();
    }
  }
}

TEST_P(EveryShape, PointsMovedOutAlongTheNormalComeBack) {
  for (const SurfacePoint& s : surface_points(shape(), size_of(shape()) / 20)) {
    for (const double offset : {1e-9, 1e-3, 0.1, 10.0}) {
      const Closest closest = closest_point(shape(), s.position + offset * s.normal);
      EXPECT_NEAR(closest.distance, offset, 1e-14 * (offset + size_of(shape())));
      EXPECT_LT((closest.point - s.position).norm(), 1e-14 * (offset + size_of(shape())));
    }
  }
}

TEST_P(EveryShape, VeryDistantPointsGetAFiniteDistanceAndAUnitNormal) {
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0.6, 0, 0.8), Vec3(0, -0.6, -0.8)}) {
    for (const double r : {1e9, 1e160}) {
      const Closest closest = closest_point(shape(), r * direction);
      EXPECT_NEAR(closest.distance / r, 1, 2e-9);
      EXPECT_NEAR(closest.normal.norm(), 1, 1e-14);
    }
  }
}

TEST_P(EveryShape, SupportPointIsOfTheBodyAndFarthestAlongTheDirection) {
  const oracle::Cloud cloud = oracle::cloud(shape());
  std::vector<Vec3> directions = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitX(), -Vec3::UnitZ()};
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 50; ++i) directions.push_back(Vec3(normal(random), normal(random), normal(random)).normalized());
  for (const Vec3& d : directions) {
    const Vec3 support = support_point(shape(), d);
    EXPECT_NEAR(oracle::level(shape(), support), 0, round_off) << d.transpose();
    double farthest = -1e9;
    for (const Vec3& s : cloud.points) farthest = std::max(farthest, d.dot(s));
    EXPECT_GE(d.dot(support), farthest - round_off * size_of(shape())) << d.transpose();
    EXPECT_LE(d.dot(support), farthest + cloud.gap) << d.transpose();
  }
}

TEST_P(EveryShape, EnclosingRadiiHoldTheShapeAndNoLess) {
  const oracle::Cloud cloud = oracle::cloud(shape());
  const Vec3 low = oracle::bounds(shape()).low, high = oracle::bounds(shape()).high;
  std::vector<Vec3> centres = {Vec3::Zero(), centroid(shape()), low, high, 2 * high - low};
  for (const double z : {-3.0, -0.7, -0.1, 0.0, 0.1, 0.4, 0.8, 1.0, 5.0}) {
    for (const double x : {0.0, 0.05, 0.5, 3.0}) {
      centres.push_back(0.5 * (low + high) + 0.5 * (high - low).cwiseProduct(Vec3(x, -0.3 * x, z)));
    }
  }
  for (const Vec3& c : centres) {
    double about_point = 0;
    Vec3 about_axes = Vec3::Zero();
    for (const Vec3& s : cloud.points) {
      const Vec3 d = s - c;
      about_point = std::max(about_point, d.norm());
      about_axes =
          about_axes.cwiseMax(Vec3(std::hypot(d.y(), d.z()), std::hypot(d.z(), d.x()), std::hypot(d.x(), d.y())));
    }
    const double slack = round_off * (size_of(shape()) + c.norm());
    EXPECT_GE(enclosing_radius(shape(), c), about_point - slack) << c.transpose();
    EXPECT_LE(enclosing_radius(shape(), c), about_point + cloud.gap) << c.transpose();
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(enclosing_radii(shape(), c)[i], about_axes[i] - slack) << c.transpose() << " axis " << i;
      EXPECT_LE(enclosing_radii(shape(), c)[i], about_axes[i] + cloud.gap) << c.transpose() << " axis " << i;
    }
  }
}

TEST_P(EveryShape, OutlineIsAClosedCurveOnTheSurfaceAndReachesItsExtremes) {
  const std::vector<Vec3> curve = outline(shape());
  EXPECT_EQ(curve.front(), curve.back());
  const oracle::Bounds b = oracle::bounds(shape());
  Vec3 low = curve.front(), high = curve.front();
  double twice_area = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    EXPECT_EQ(curve[i].x(), 0);
    EXPECT_NEAR(oracle::level(shape(), curve[i]), 0, round_off);
    low = low.cwiseMin(curve[i]);
    high = high.cwiseMax(curve[i]);
    if (i > 0) twice_area += curve[i - 1].y() * curve[i].z() - curve[i].y() * curve[i - 1].z();
  }
  EXPECT_NEAR((high - low).y(), (b.high - b.low).y(), round_off);
  EXPECT_NEAR((high - low).z(), (b.high - b.low).z(), round_off);
  // No spike, no crossing: a fat polygon (a triangle has half of its box).
  EXPECT_GT(std::abs(twice_area), (high - low).y() * (high - low).z() * (1 - round_off));
}

TEST(Hcc, ClosestPointOnTheAxisIsKnownInClosedForm) {
  const Shape prolate = Hcc{1.8, 0.3, 0.2};  // radius of curvature of the tip 0.1125
  EXPECT_NEAR(closest_point(prolate, {0, 0, 0.07}).distance, 0.07, 1e-15);
  EXPECT_NEAR(closest_point(prolate, {0, 0, -0.1}).distance, -0.1, 1e-15);
  EXPECT_EQ(closest_point(prolate, {0, 0, -0.1}).normal, Vec3(0, 0, 1));
  EXPECT_NEAR(closest_point(prolate, {0, 0, -0.2}).distance, -0.15, 1e-15);
  // Beyond the centre of curvature: d^2 = b^2 (1 - z^2/(a^2 - b^2)), z from the centre of the spheroid.
  EXPECT_NEAR(closest_point(prolate, {0, 0, -0.15}).distance,
              -0.15 * std::sqrt(1 - 0.05 * 0.05 / (0.2 * 0.2 - 0.15 * 0.15)), 1e-15);
  EXPECT_NEAR(closest_point(prolate, {0, 0, -1.75}).distance, -0.05, 1e-15);
  EXPECT_EQ(closest_point(prolate, {0, 0, -1.75}).normal, Vec3(0, 0, -1));

  const Shape blunt = Hcc{1.0, 0.3, 0.05};  // below the base the tip is still nearer than the wall
  EXPECT_NEAR(closest_point(blunt, {0, 0, -0.06}).distance, -0.06, 1e-15);
  EXPECT_EQ(closest_point(blunt, {0, 0, -0.06}).normal, Vec3(0, 0, 1));
  EXPECT_NEAR(closest_point(blunt, {0, 0, -0.5}).distance, -0.15, 1e-15);
}

TEST(Cone, ClosestPointIsKnownInClosedForm) {
  const Shape cone = Cone{0.4, 0.6};  // 3-4-5: slant 0.5, normal of the side (0.8, 0, 0.6)
  EXPECT_LT((closest_point(cone, {0, 0, 0.3}).point - Vec3(0, 0, 0.2)).norm(), 1e-16);
  EXPECT_EQ(closest_point(cone, {0, 0, 0.3}).normal, Vec3(0, 0, 1));
  const Vec3 on_side(0.15, 0, 0), out(0.8, 0, 0.6);
  for (const double distance : {-0.05, 0.1, 3.0}) {
    const Closest closest = closest_point(cone, on_side + distance * out);
    EXPECT_NEAR(closest.distance, distance, 1e-15);
    EXPECT_LT((closest.point - on_side).norm(), 1e-15);
    EXPECT_LT((closest.normal - out).norm(), 1e-15);
  }
  EXPECT_NEAR(closest_point(cone, {0, 0.1, -0.15}).distance, -0.05, 1e-16);  // the base
  EXPECT_EQ(closest_point(cone, {0, 0.1, -0.15}).normal, Vec3(0, 0, -1));
  EXPECT_NEAR(closest_point(cone, {0.3 + 0.03, 0, -0.2 - 0.04}).distance, 0.05, 1e-16);  // the rim
  EXPECT_LT((closest_point(cone, {0.33, 0, -0.24}).normal - Vec3(0.6, 0, -0.8)).norm(), 1e-15);
}

// Bullet's own inertia of this capsule is that of its box, 47.75 and 2.757 (reference body: R = 0.15 m, 1.44 m between
// the centres of the caps, 183.8 kg).
TEST(Capsule, InertiaIsThatOfACylinderAndTwoHalfBalls) {
  const double r = 0.15, h = 1.44;
  const double cylinder = pi * r * r * h, ball = 4.0 / 3 * pi * r * r * r;
  const Vec3 inertia = inertia_per_mass(Capsule{h + 2 * r, 2 * r}) * (cylinder + ball);
  // Textbook: the half balls' own moment 83/320 m r^2, moved by h/2 + 3/8 r.
  const double across =
      cylinder * (h * h / 12 + r * r / 4) + ball * (83.0 / 320 * r * r + std::pow(h / 2 + 0.375 * r, 2));
  EXPECT_NEAR(inertia.x(), across, 1e-14 * across);
  EXPECT_EQ(inertia.y(), inertia.x());
  EXPECT_NEAR(inertia.z(), cylinder * r * r / 2 + ball * 0.4 * r * r, 1e-14 * across);
}

TEST(Hcc, HemisphericalNoseIsHalfASphere) {
  const Shape hcc = Hcc{1.0, 0.3, 0.15};
  EXPECT_NEAR(volume(hcc), 2.0 / 3 * pi * std::pow(0.15, 3) + pi * 0.15 * 0.15 * 0.85, 1e-16);
  EXPECT_NEAR(surface_area(hcc), 2 * pi * 0.15 * 0.15 + pi * 0.3 * 0.85 + pi * 0.15 * 0.15, 1e-15);
}

TEST(Hcc, AreaIsContinuousThroughTheHemisphere) {
  const double hemisphere = surface_area(Hcc{1.0, 0.3, 0.15});
  for (const double relative : {1e-15, 1e-12, 1e-8, 1e-5}) {
    for (const double sign : {-1.0, 1.0}) {
      EXPECT_NEAR(surface_area(Hcc{1.0, 0.3, 0.15 * (1 + sign * relative)}), hemisphere, 0.2 * relative + 1e-15);
    }
  }
}

std::string refusal(const Shape& shape, double spacing) {
  try {
    surface_points(shape, spacing);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Shape, WithoutInteriorIsRefusedByDimensionAndValue) {
  EXPECT_EQ(refusal(Sphere{-0.061}, 0.01), "sphere: diameter = -0.061 m, must be positive and finite");
  EXPECT_EQ(refusal(Box{{1, 0, 1}}, 0.01), "box: size y = 0 m, must be positive and finite");
  EXPECT_EQ(refusal(Cylinder{INFINITY, 1}, 0.01), "cylinder: length = inf m, must be positive and finite");
  EXPECT_EQ(refusal(Hcc{1.8, 0.3, 2}, 0.01), "hcc: nose length = 2 m, must be at most the length, 1.8 m");
  EXPECT_EQ(refusal(Capsule{0.2, 0.3}, 0.01), "capsule: length = 0.2 m, must be at least the diameter, 0.3 m");
  EXPECT_EQ(refusal(Cone{1, 0}, 0.01), "cone: diameter = 0 m, must be positive and finite");
  EXPECT_THROW(validate(Hcc{1.8, NAN, 0.2}), std::invalid_argument);
  EXPECT_NO_THROW(validate(Hcc{0.2, 0.3, 0.2}));
}

TEST(Shape, SpacingThatIsNotPositiveOrAsksForTooManySamplesIsRefused) {
  for (const double spacing : {0.0, -0.01, 1e-9, double(INFINITY), double(NAN)}) {
    EXPECT_TRUE(refusal(Sphere{1}, spacing).starts_with("sphere: surface spacing = ")) << spacing;
  }
}

TEST(Shape, NamesAreThoseOfAScene) {
  EXPECT_EQ(name(Hcc{1.8, 0.3, 0.2}), "hcc");
  EXPECT_EQ(name(Sphere{1}), "sphere");
  EXPECT_EQ(name(Box{{1, 1, 1}}), "box");
  EXPECT_EQ(name(Cylinder{1, 1}), "cylinder");
  EXPECT_EQ(name(Capsule{1, 1}), "capsule");
  EXPECT_EQ(name(Cone{1, 1}), "cone");
}

}  // namespace
}  // namespace nilas::rigid
