#include "sph/neo_hookean.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <numbers>

#include "sph/stress_update.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

constexpr double MPa = 1e6, dx = 0.02, h = 0.026;

MaterialSpec spec(double kelvin_voigt = 0) {
  MaterialSpec m;
  m.model = Model::neo_hookean;
  m.kelvin_voigt = kelvin_voigt;
  return m;
}
NeoHookean ice(double kelvin_voigt = 0) { return {spec(kelvin_voigt), h}; }

/// A deformation with positive determinant.
Mat3 deformation(test::Random& random) { return Mat3::Identity() + 0.2 * random.matrix(); }

Mat3 rotation(double angle, const Vec3& axis) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

// V6, MPa.
TEST(NeoHookean, HomogeneousDeformationsHaveTheirTabulatedStressAndEnergy) {
  Mat3 shear = Mat3::Identity();
  shear(0, 1) = 0.2;
  const struct {
    Mat3 F;
    Sym3 tau;
    double energy;  // 0: not tabulated
  } table[] = {
      {Vec3(1.1, 1, 1).asDiagonal(), {1428.8795, 733.9426, 733.9426}, 66.383944},
      {0.9 * Mat3::Identity(), {-2154.452657, -2154.452657, -2154.452657}, 376.129020},
      {shear, {94.035088, -47.017544, -47.017544, 705.263158}, 70.526316},
      {Vec3(0.7, 1, 1).asDiagonal(), {-3865.785952, -1584.607024, -1584.607024}, 0},
  };
  for (const auto& row : table) {
    const Mat3 tau = to_matrix(ice().elastic_kirchhoff(row.F)) / MPa, expected = to_matrix(row.tau);
    // The table's digits: seven to ten.
    for (int k = 0; k < 9; ++k) EXPECT_NEAR(tau(k / 3, k % 3), expected(k / 3, k % 3), 6e-5) << k;
    if (row.energy > 0) {
      EXPECT_NEAR(ice().energy(row.F) / MPa, row.energy, 5.1e-7);
    }
  }
}

// The same closed forms worked out by hand, to the accuracy that V6 asks for.
TEST(NeoHookean, StretchShearAndCompressionAreTheirClosedForms) {
  const double K = ice().constants.bulk_modulus, G = ice().constants.shear_modulus;
  for (const double a : {1.1, 0.7}) {
    const Sym3 tau = ice().elastic_kirchhoff(Vec3(a, 1, 1).asDiagonal());
    const double p = 0.5 * K * (a * a - 1), s = G * std::pow(a, -2.0 / 3) * (a * a - 1) / 3;
    EXPECT_NEAR(tau.xx / (p + 2 * s), 1, 1e-9);
    EXPECT_NEAR(tau.yy / (p - s), 1, 1e-9);
    EXPECT_EQ(tau.yy, tau.zz);
  }
  const double J = 0.9 * 0.9 * 0.9;
  EXPECT_NEAR(ice().elastic_kirchhoff(0.9 * Mat3::Identity()).zz / (0.5 * K * (J * J - 1)), 1, 1e-9);
  EXPECT_NEAR(ice().energy(0.9 * Mat3::Identity()) / (0.5 * K * (0.5 * (J * J - 1) - std::log(J))), 1, 1e-9);
  Mat3 shear = Mat3::Identity();
  shear(0, 1) = 0.2;
  const Sym3 tau = ice().elastic_kirchhoff(shear);
  EXPECT_NEAR(tau.xy / (0.2 * G), 1, 1e-9);
  EXPECT_NEAR(tau.xx / (2 * G * 0.04 / 3), 1, 1e-9);
  EXPECT_NEAR(tau.yy / (-G * 0.04 / 3), 1, 1e-9);
  EXPECT_NEAR(ice().energy(shear) / (0.5 * G * 0.04), 1, 1e-9);
}

TEST(NeoHookean, StressIsTheDerivativeOfTheEnergy) {
  test::Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 F = deformation(random);
    const Mat3 P = to_matrix(ice().elastic_kirchhoff(F)) * F.inverse().transpose();
    const double step = 1e-5;
    Mat3 difference;
    for (int k = 0; k < 9; ++k) {
      Mat3 dF = Mat3::Zero();
      dF(k / 3, k % 3) = step;
      difference(k / 3, k % 3) = (ice().energy(F + dF) - ice().energy(F - dF)) / (2 * step);
    }
    EXPECT_LT((difference - P).norm(), 1e-6 * P.norm());
  }
}

TEST(NeoHookean, SmallStrainIsHookesLaw) {
  const Sym3 e{1e-8, -2e-8, 3e-8, 4e-8, -5e-8, 6e-8};
  const NeoHookean law = ice();
  const Sym3 hooke =
      add_isotropic((2 * law.constants.shear_modulus) * deviator(e), law.constants.bulk_modulus * trace(e));
  const Mat3 tau = to_matrix(law.elastic_kirchhoff(Mat3::Identity() + to_matrix(e)));
  EXPECT_LT((tau - to_matrix(hooke)).norm(), 1e-6 * to_matrix(hooke).norm());
}

TEST(NeoHookean, SuperposedRotationTurnsStressAndLeavesEnergy) {
  test::Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 F = deformation(random), Q = rotation(3 * random(), random.vector()), L = 100 * random.matrix();
    const NeoHookean law = ice(1);
    const Mat3 tau = to_matrix(law.elastic_kirchhoff(F));
    EXPECT_LT((to_matrix(law.elastic_kirchhoff(Q * F)) - Q * tau * Q.transpose()).norm(), 1e-12 * tau.norm());
    EXPECT_NEAR(law.energy(Q * F) / law.energy(F), 1, 1e-12);
    // Seen from a frame that turns with spin W, L is Q L Q^T + W: the spin adds no damping on unstrained ice.
    const Vec3 w = 1e3 * random.vector();
    Mat3 W;
    W << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    const Mat3 turned = Q * L * Q.transpose() + W, damping = to_matrix(law.damping_kirchhoff(Mat3::Identity(), L));
    EXPECT_LT((to_matrix(law.damping_kirchhoff(Q, turned)) - Q * damping * Q.transpose()).norm(),
              1e-12 * law.damping * turned.norm());
  }
}

TEST(NeoHookean, SpinMovesTheDeformationOnByARotation) {
  Mat3 W;
  W << 0, -300, 100, 300, 0, -200, -100, 200, 0;
  test::Random random(3);
  const Mat3 start = deformation(random);
  Mat3 F = start;
  for (int n = 0; n < 10000; ++n) F = NeoHookean::advance(F, W, 1e-4);
  EXPECT_LT((F.transpose() * F - start.transpose() * start).norm(), 1e-11);
}

TEST(NeoHookean, DeformationFollowsAConstantGradientToSecondOrder) {
  Mat3 L = Mat3::Zero();
  L.diagonal() = Vec3(0.1, -0.2, 0.3);
  const auto error = [&](int steps) {
    Mat3 F = Mat3::Identity();
    for (int n = 0; n < steps; ++n) F = NeoHookean::advance(F, L, 1.0 / steps);
    return (F.diagonal() - L.diagonal().array().exp().matrix()).norm();
  };
  EXPECT_NEAR(std::log2(error(10) / error(20)), 2, 0.05);
}

TEST(KelvinVoigt, StressIsTheViscosityTimesTheStrainRateInOneDimension) {
  const NeoHookean law = ice(1);
  EXPECT_NEAR(law.damping / (900 * 3196.5 * h / 2), 1, 2e-5);  // 3196.5: five digits
  const Sym3 tau = law.damping_kirchhoff(Mat3::Identity(), Vec3(50, 0, 0).asDiagonal());
  EXPECT_NEAR(tau.xx / (50 * law.damping), 1, 1e-12);
  EXPECT_EQ(tau.yy, 0);
  EXPECT_EQ(kelvin_voigt_viscosity(MaterialSpec{}, h), 0);  // Drucker-Prager ice has none
}

TEST(KelvinVoigt, StressIsHalfTheViscosityTimesTheRateOfTheLeftCauchyGreenTensor) {
  test::Random random(4);
  const Mat3 F = deformation(random), L = 10 * random.matrix();
  const double dt = 1e-6;
  const Mat3 before = NeoHookean::advance(F, L, -dt), after = NeoHookean::advance(F, L, dt);
  const Mat3 rate = (after * after.transpose() - before * before.transpose()) / (2 * dt);
  const NeoHookean law = ice(1);
  EXPECT_LT((to_matrix(law.damping_kirchhoff(F, L)) - 0.5 * law.damping * rate).norm(),
            1e-8 * law.damping * rate.norm());
}

Particles particles(std::size_t n) {
  Particles p = test::particles_at(std::vector<Vec3>(n, Vec3::Zero()), dx);
  p.deformation_gradient.assign(n, Mat3::Identity());
  return p;
}

TEST(NeoHookeanUpdate, VolumeIsThatOfTheDeformation) {
  Particles p = particles(1);
  test::Random random(5);
  for (int n = 0; n < 100; ++n) {
    p.velocity_gradient[0] = 1000 * random.matrix();
    update_stress(p, ice(), 900, 1e-5);
    EXPECT_NEAR(p.motion[0].volume / (dx * dx * dx * p.deformation_gradient[0].determinant()), 1, 1e-14);
  }
}

/// Work along a smooth path of large strain and rotation in so many steps, over the energy stored at its end.
double work_over_stored(int steps, double kelvin_voigt) {
  Particles p = particles(1);
  double work = 0;
  const double end = 1e-3;
  for (int n = 0; n < steps; ++n) {
    const double t = (n + 0.5) / steps;
    p.velocity_gradient[0] << 100 * t, 300, -50, -200 * t, 80, 60, 40, -90 * t, -150;
    work += update_stress(p, ice(kelvin_voigt), 900, end / steps).work;
  }
  return work / elastic_energy(p, ice(kelvin_voigt));
}

TEST(NeoHookeanUpdate, WorkIsTheStoredEnergyToSecondOrderInTheStep) {
  const double coarse = std::abs(work_over_stored(50, 0) - 1), fine = std::abs(work_over_stored(100, 0) - 1);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_GE(std::log2(coarse / fine), 1.9);
}

TEST(NeoHookeanUpdate, DampingDissipates) { EXPECT_GT(work_over_stored(200, 1), 1.01); }

TEST(NeoHookeanUpdate, ClosedLoopOfStrainReturnsTheWork) {
  Particles p = particles(1);
  double work = 0, largest = 0;
  const int steps = 2000;
  for (int n = 0; n < steps; ++n) {
    const double angle = 2 * std::numbers::pi * (n + 0.5) / steps;
    p.velocity_gradient[0] = Mat3::Zero();
    p.velocity_gradient[0](0, 1) = std::sin(angle);
    work += update_stress(p, ice(), 900, 1.0 / steps).work;
    largest = std::max(largest, work);
  }
  EXPECT_LT(std::abs(work), 1e-5 * largest);
}

TEST(NeoHookeanUpdate, IceTurnedInsideOutIsReported) {
  Particles p = particles(10);
  p.velocity_gradient[4] = Vec3(-3e6, 0, 0).asDiagonal();
  EXPECT_EQ(update_stress(p, ice(), 900, 1e-6).out_of_range, 4u);
  p = particles(10);
  p.velocity_gradient[7](1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(update_stress(p, ice(), 900, 1e-6).out_of_range, 7u);
}

}  // namespace
}  // namespace nilas::sph
