#include "coupling/stability_number.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using std::numbers::pi;

const sph::ElasticConstants kIce{sph::MaterialSpec{}};
const double kStep = 3.5e-6;  // s
const double z_dt = kIce.impedance() * kStep;

rigid::BodySpec body_of(const rigid::Shape& shape, double spacing) {
  rigid::BodySpec spec;
  spec.shape = shape;
  spec.boundary_spacing = spacing;
  spec.mass = rigid::from_density(shape, 1500);
  spec.velocity = Vec3(0, 0, 100);
  return spec;
}

TEST(StabilityNumber, OfASphereIsThatOfItsDiscAndFrictionBrakesItsWholeSurface) {
  const double R = 0.15, spacing = 0.01;
  const rigid::BodySpec spec = body_of(rigid::Sphere{2 * R}, spacing);
  const double tolerance = (spacing / R) * (spacing / R);  // of sums over samples
  const StabilityNumber n = stability_number(Body(spec), kIce, false, kStep);
  EXPECT_NEAR(n.translation / (z_dt * pi * R * R / spec.mass.mass), 1, tolerance);
  EXPECT_NEAR(n.pitch, 0, 1e-12);
  EXPECT_NEAR(n.roll, 0, 1e-12);
  // INT (distance from the axis)^2 dA = 2/3 R^2 4 pi R^2: every point slips along its circle about the axis.
  const StabilityNumber rough = stability_number(Body(spec), kIce, true, kStep);
  EXPECT_NEAR(rough.roll / (z_dt * 8 * pi / 3 * std::pow(R, 4) / spec.mass.inertia.z()), 1, tolerance);
}

// INT (r x n)^2 dA over the six faces of a box a, b, c about x: a b^3 / 6 + a c^3 / 6, and so round.
TEST(StabilityNumber, OfAPlateIsThatOfItsFaces) {
  const double a = 1.2, b = 0.8, c = 0.1, spacing = 0.01;
  const rigid::BodySpec spec = body_of(rigid::Box{Vec3(a, b, c)}, spacing);
  const auto cube = [](double s) { return s * s * s; };
  const double about_x = a * (cube(b) + cube(c)) / 6, about_y = b * (cube(a) + cube(c)) / 6,
               about_z = c * (cube(a) + cube(b)) / 6;
  const double tolerance = (spacing / c) * (spacing / c);  // midpoint rule across the ten cells of the thin faces
  const StabilityNumber n = stability_number(Body(spec), kIce, false, kStep);
  const Vec3& I = spec.mass.inertia;
  EXPECT_NEAR(n.translation / (z_dt * a * b / spec.mass.mass), 1, 1e-12);
  EXPECT_NEAR(n.pitch / (z_dt * std::max(about_x / I.x(), about_y / I.y())), 1, tolerance);
  EXPECT_NEAR(n.roll / (z_dt * about_z / I.z()), 1, tolerance);
}

TEST(StabilityNumber, IsProportionalToTheStep) {
  const Body body(test::short_hcc(60));
  const StabilityNumber n = stability_number(body, kIce, true, kStep),
                        half = stability_number(body, kIce, true, kStep / 2);
  EXPECT_DOUBLE_EQ(n.translation, 2 * half.translation);
  EXPECT_DOUBLE_EQ(n.pitch, 2 * half.pitch);
  EXPECT_DOUBLE_EQ(n.roll, 2 * half.roll);
  EXPECT_EQ(n.largest(), std::max({n.translation, n.pitch, n.roll}));
}

TEST(StabilityNumber, DoesNotDependOnTheAttitude) {
  const StabilityNumber upright = stability_number(Body(test::short_hcc(90)), kIce, true, kStep);
  const StabilityNumber oblique = stability_number(Body(test::short_hcc(60)), kIce, true, kStep);
  EXPECT_NEAR(upright.translation, oblique.translation, 1e-12);
  EXPECT_NEAR(upright.pitch, oblique.pitch, 1e-12);
  EXPECT_NEAR(upright.roll, oblique.roll, 1e-12);
}

TEST(StabilityNumber, OfALockedMotionIsZero) {
  const StabilityNumber path =
      stability_number(Body(test::short_hcc(60, rigid::Motion::fixed_path)), kIce, true, kStep);
  EXPECT_EQ(path.largest(), 0);
  const StabilityNumber slide =
      stability_number(Body(test::short_hcc(60, rigid::Motion::translation_only)), kIce, true, kStep);
  EXPECT_GT(slide.translation, 0);
  EXPECT_EQ(slide.pitch, 0);
  EXPECT_EQ(slide.roll, 0);
}

/// INT (r x n)_x^2 dA over the true surface of an HCC, about a point of its axis `centre` behind the tip.
double pitch_integral(double length, double radius, double nose, double centre) {
  const int intervals = 20000;
  double sum = pi * std::pow(radius, 4) / 4;  // flat tail: (r x n)_x = -rho sin(phi)
  const double wall = length - nose;
  for (int n = 0; n < intervals; ++n) {
    const double s = (n + 0.5) / intervals;
    const double z = centre - nose - s * wall;  // wall: (r x n)_x = -z sin(phi)
    sum += pi * radius * z * z * wall / intervals;
    // Nose: rho = R sin t, height a cos t above the shoulder; (r x n)_x = sin(phi) (rho n_z - z n_rho).
    const double t = s * pi / 2, rho = radius * std::sin(t), height = nose * std::cos(t);
    const Eigen::Vector2d normal = Eigen::Vector2d(nose * std::sin(t), radius * std::cos(t)).normalized();
    const double arc = std::hypot(radius * std::cos(t), nose * std::sin(t)) * pi / 2 / intervals;
    const double arm = rho * normal.y() - (centre - nose + height) * normal.x();
    sum += pi * arm * arm * rho * arc;
  }
  return sum;
}

TEST(StabilityNumber, OfTheHccIsThatOfItsTrueSurface) {
  const double length = 1.8, radius = 0.15, nose = 0.2, spacing = 0.015;
  rigid::BodySpec spec = body_of(rigid::Hcc{length, 2 * radius, nose}, spacing);
  const double tolerance = (spacing / radius) * (spacing / radius);
  const StabilityNumber n = stability_number(Body(spec), kIce, false, kStep);
  EXPECT_NEAR(n.translation / (z_dt * pi * radius * radius / spec.mass.mass), 1, tolerance);
  EXPECT_NEAR(n.pitch / (z_dt * pitch_integral(length, radius, nose, 0.932692) / spec.mass.inertia.x()), 1, tolerance);
  EXPECT_NEAR(n.roll, 0, 1e-12);
  EXPECT_LT(n.largest(), kStabilityWarning);
  // The inertia that the paper prints, less than half the true one, deserves the warning.
  spec.mass = {174.1, Vec3(0, 0, -0.9333), Vec3(21.4, 21.4, 6.15)};
  const StabilityNumber printed = stability_number(Body(spec), kIce, false, kStep);
  EXPECT_NEAR(printed.pitch / (z_dt * pitch_integral(length, radius, nose, 0.9333) / 21.4), 1, tolerance);
  EXPECT_GT(printed.largest(), kStabilityWarning);
}

}  // namespace
}  // namespace nilas
