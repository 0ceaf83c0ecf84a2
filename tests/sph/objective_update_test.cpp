#include "sph/objective_update.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "sph/material.hpp"

namespace nilas::sph {
namespace {

using std::numbers::pi;

const Sym3 prestress{3e6, -2e6, 1e6, 0.5e6, -1.5e6, 2e6};  // Pa

Mat3 spin(const Vec3& w) {
  Mat3 W;
  W << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
  return W;
}
Mat3 turned(const Sym3& s, double angle, const Vec3& axis) {
  const Mat3 R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  return R * to_matrix(s) * R.transpose();
}
Sym3 turn_in_steps(const Sym3& start, const Vec3& axis, double angle_per_step, int steps) {
  const double dt = 1e-6;
  Sym3 s = start;
  for (int n = 0; n < steps; ++n) s = rotate_by_spin(s, spin(angle_per_step / dt * axis), dt);
  return s;
}
double difference(const Sym3& a, const Mat3& b) { return (to_matrix(a) - b).norm(); }

// V4.
TEST(ObjectiveUpdate, TenTurnsKeepNormPressureAndJ2) {
  const Vec3 axis = Vec3(1, -2, 0.5).normalized();
  const Sym3 s = turn_in_steps(prestress, axis, 0.01, static_cast<int>(std::round(20 * pi / 0.01)));
  EXPECT_NEAR(to_matrix(s).norm() / to_matrix(prestress).norm(), 1, 1e-10);
  EXPECT_NEAR(trace(s) / trace(prestress), 1, 1e-10);
  EXPECT_NEAR(second_invariant(deviator(s)) / second_invariant(deviator(prestress)), 1, 1e-10);
}

// A step turns by 2 atan(w dt / 2) = w dt - (w dt)^3/12 + ...
TEST(ObjectiveUpdate, TenTurnsEndAtTheTurnedStressToTheOrderOfTheUpdate) {
  const Vec3 axis = Vec3(1, -2, 0.5).normalized();
  const double total = 20 * pi, size = to_matrix(prestress).norm();
  double error[2];
  for (int k = 0; k < 2; ++k) {
    const int steps = 6400 << k;
    const Sym3 s = turn_in_steps(prestress, axis, total / steps, steps);
    error[k] = difference(s, turned(prestress, total, axis)) / size;
    EXPECT_LT(error[k], 2 * steps * std::pow(total / steps, 3) / 12);
    EXPECT_LT(difference(s, turned(prestress, steps * 2 * std::atan(total / steps / 2), axis)) / size, 1e-10);
  }
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.01);
}

TEST(ObjectiveUpdate, StepOfAnySizeIsARotation) {
  for (const double angle : {1e-12, 1e-3, 1.0, 10.0, 1e6}) {
    const Sym3 s = turn_in_steps(prestress, Vec3(3, 1, 2).normalized(), angle, 1);
    EXPECT_LT(difference(s, turned(prestress, 2 * std::atan(angle / 2), Vec3(3, 1, 2).normalized())),
              1e-13 * to_matrix(prestress).norm());
  }
}

TEST(ObjectiveUpdate, PureStrainAndHydrostaticStressAreNotTurned) {
  const Mat3 strain_rate = to_matrix({1, 2, -3, 4, 5, 6});
  EXPECT_EQ(to_matrix(rotate_by_spin(prestress, 1e3 * strain_rate, 1e-3)), to_matrix(prestress));
  const Sym3 s = rotate_by_spin({-5e6, -5e6, -5e6}, spin({1e3, 2e3, -1e3}) + strain_rate, 1e-3);
  EXPECT_LT(difference(s, -5e6 * Mat3::Identity()), 1e-8);
}

struct Shear {
  double s12, s11, s22, s33;  // over G
};
/// Simple shear L = gdot e1 (x) e2 up to gamma, in increments of d_gamma.
Shear shear_to(double gamma, int steps) {
  const Elastic law{ElasticConstants(MaterialSpec{}), PressureLaw::volumetric_strain};
  const double dt = 1e-6;
  Mat3 L = Mat3::Zero();
  L(0, 1) = gamma / steps / dt;
  Sym3 s{};
  NoState unused{};
  for (int n = 0; n < steps; ++n) s = law.update(rotate_by_spin(s, L, dt), {dt * symmetric_part(L)}, unused);
  const double G = law.constants.shear_modulus;
  return {s.xy / G, s.xx / G, s.yy / G, s.zz / G};
}

// V5: sigma12 = G sin(gamma), sigma11 = -sigma22 = G (1 - cos(gamma)).
TEST(ObjectiveUpdate, SimpleShearIsThatOfTheJaumannRate) {
  const struct {
    double gamma, s12, s11;
  } table[] = {{0.5, 0.479426, 0.122417}, {1, 0.841471, 0.459698}, {pi / 2, 1, 1}, {pi, 0, 2}};
  for (const auto& row : table) {
    const Shear s = shear_to(row.gamma, static_cast<int>(std::round(row.gamma / 1e-3)));
    EXPECT_NEAR(s.s12, row.s12, 1e-3);
    EXPECT_NEAR(s.s11, row.s11, 1e-3);
    EXPECT_NEAR(s.s22, -row.s11, 1e-3);
    EXPECT_NEAR(s.s33, 0, 1e-12);
  }
}

TEST(ObjectiveUpdate, SimpleShearConvergesAtLeastAtFirstOrder) {
  const auto error = [](int steps) {
    const Shear s = shear_to(1, steps);
    return std::hypot(s.s12 - std::sin(1.0), s.s11 - (1 - std::cos(1.0)));
  };
  EXPECT_GT(std::log2(error(500) / error(1000)), 0.98);
  EXPECT_GT(std::log2(error(1000) / error(2000)), 0.98);
}

}  // namespace
}  // namespace nilas::sph
