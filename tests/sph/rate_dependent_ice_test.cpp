#include "sph/rate_dependent_ice.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "tests/support/material_point.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

using test::MaterialPoint;
using Point = MaterialPoint<RateDependentIce>;

constexpr double MPa = 1e6, dx = 0.002;
constexpr double step = 1e-5;  // strain increment

MaterialSpec spec() {
  MaterialSpec m;
  m.model = Model::rate_dependent;
  return m;
}
RateDependentIce ice(double spacing = dx) { return {spec(), spacing}; }
const ElasticConstants elastic{spec()};

/// A point whose increments of `increment` come at `rate` [1/s], and that has seen this rate for long.
Point point(double rate, double increment = step, double spacing = dx) {
  Point p(ice(spacing), increment / rate);
  p.state().strain_rate = rate;
  return p;
}
/// Compresses a point without letting it take notice of the rate.
void compress(Point& p, double volume_strain) {
  const double rate = p.state().strain_rate;
  p.strain({-volume_strain / 3, -volume_strain / 3, -volume_strain / 3});
  p.state().strain_rate = rate;
}
/// Isochoric compression along x: the equivalent strain is the increment.
void squeeze(Point& p, double increment = step) { p.strain({-increment, increment / 2, increment / 2}); }
double von_mises_of(const Point& p) { return std::sqrt(3.0) * p.sqrt_j2(); }

TEST(RateDependentStrength, IsThatOfJones) {
  const double table[][2] = {{1, 8.9}, {10, 12.5716}, {1e3, 25.0838}};  // 1/s, MPa
  for (const auto& [rate, strength] : table) {
    auto p = point(rate);
    compress(p, 0.01);
    double largest = 0;
    for (int n = 0; n < 400; ++n) {
      squeeze(p);
      largest = std::max(largest, von_mises_of(p));
    }
    EXPECT_NEAR(largest / (strength * MPa), 1, 1e-5) << rate;
  }
}

TEST(RateDependentStrength, EndsWhereTheRatesEnd) {
  EXPECT_EQ(ice().compressive_strength(0), ice().compressive_strength(1));
  EXPECT_EQ(ice().compressive_strength(1e9), ice().compressive_strength(1e4));
  EXPECT_NEAR(ice().compressive_strength(1e9) / (35.4314 * MPa), 1, 1e-5);
}

TEST(RateDependentStrength, DoesNotDependOnPressureWhileIntact) {
  for (const double volume_strain : {0.005, 0.01, 0.05}) {
    auto p = point(100);
    compress(p, volume_strain);
    double largest = 0;
    for (int n = 0; n < 400; ++n) {
      squeeze(p);
      largest = std::max(largest, von_mises_of(p));
    }
    EXPECT_NEAR(largest / (17.7580 * MPa), 1, 1e-5);
  }
}

TEST(RateDependentStrength, FollowsTheRateWithTheRelaxationTime) {
  const double T = ice().relaxation_time();
  EXPECT_NEAR(T / (7 * dx / 3196.5), 1, 2e-5);  // 3196.5: five digits
  Point p(ice(), T / 100);
  p.state().strain_rate = 1000;
  for (int n = 0; n < 100; ++n) squeeze(p, 3000 * T / 100);
  EXPECT_NEAR(p.state().strain_rate, 3000 - 2000 * std::exp(-1.0), 1e-9);
}

TEST(RateDependentStrength, RateDoesNotDependOnHowAStepIsDivided) {
  const double dt = 1e-6;
  Point whole(ice(), dt), halves(ice(), dt / 2);
  for (int n = 0; n < 20; ++n) {
    squeeze(whole, (1 + n) * 1e-4);
    for (int half = 0; half < 2; ++half) squeeze(halves, (1 + n) * 0.5e-4);
    EXPECT_NEAR(whole.state().strain_rate / halves.state().strain_rate, 1, 1e-12);
  }
}

TEST(RateDependentPressure, HydrostaticCompressionIsElasticToAnyLevel) {
  auto p = point(1000);
  for (int n = 0; n < 10000; ++n) p.strain({-step, -step, -step});
  EXPECT_NEAR(p.pressure() / (elastic.bulk_modulus * std::expm1(0.3)), 1, 1e-9);
  EXPECT_LT(p.sqrt_j2(), 1e-3);
  EXPECT_FALSE(p.state().failed);
  EXPECT_EQ(p.state().shear_damage, 0);
  EXPECT_EQ(p.state().tensile_damage, 0);
  EXPECT_EQ(p.state().bulking, 0);
}

struct Crack {
  double peak, work, opening;  // Pa, J/m2 of crack, m
  Point point;
};
/// A bar one spacing long pulled in uniaxial stress until it is cracked through.
Crack crack(double spacing, double increment) {
  auto p = point(1, increment, spacing);
  double peak = 0, work = 0, before = 0, strain = 0;
  while (!p.state().failed) {
    p.axial(increment, 0);
    strain += increment;
    work += 0.5 * (before + p.stress().xx) * increment * spacing;
    before = p.stress().xx;
    peak = std::max(peak, before);
  }
  return {peak, work, strain * spacing, p};
}

TEST(RateDependentTension, IsCutOffAtTheTensileStrength) {
  const Crack c = crack(dx, 1e-6);
  EXPECT_LE(c.peak, 0.5 * MPa * (1 + 1e-9));
  EXPECT_GT(c.peak, 0.5 * MPa * (1 - 0.02));  // a step is 0.02 of the strain at peak
}

TEST(RateDependentTension, ACrackDissipatesTheFractureEnergyAtEverySpacing) {
  for (const double spacing : {0.001, 0.002, 0.01, 0.03}) {
    const double increment = 4e-6 / spacing / 2000;  // opening 2 G_f/sigma_t = 4 um, in 2000 steps
    const Crack c = crack(spacing, increment);
    EXPECT_NEAR(c.work, 1, 2e-3) << spacing;
    EXPECT_NEAR(c.opening / 4e-6, 1, 2e-3) << spacing;
    EXPECT_EQ(c.point.state().tensile_damage, 1);
    EXPECT_EQ(c.point.state().shear_damage, 0);
  }
}

TEST(RateDependentTension, CrackedIceCarriesNoTension) {
  Point p = crack(dx, 1e-6).point;
  test::Random random(1);
  for (int n = 0; n < 1000; ++n) {
    p.strain(1e-4 * random.tensor());
    const double largest = Eigen::SelfAdjointEigenSolver<Mat3>(to_matrix(p.stress())).eigenvalues()[2];
    EXPECT_LE(largest, 1e-9 * (MPa + p.sqrt_j2()));
  }
}

TEST(RateDependentTension, CracksLeaveTheCompressiveStrength) {
  // Split across x, then pushed along x and along y, free to expand: columns carry their axial load.
  const double nu = spec().poisson_ratio;
  for (const Sym3& push : {Sym3{-1, nu, nu}, Sym3{nu, -1, nu}}) {
    const Point cracked = crack(dx, 1e-6).point;
    ASSERT_EQ(cracked.state().tensile_damage, 1);
    Point p(ice(), step / 10);
    p.state() = cracked.state();
    p.state().bulking = 0;  // a closed crack
    p.state().strain_rate = 10;
    double largest = 0;
    for (int n = 0; n < 400; ++n) {
      p.strain(step * push);
      largest = std::max(largest, std::sqrt(3.0) * p.sqrt_j2());
    }
    // The equivalent rate is between (2/3)(1 + nu) = 0.887 and 1 of the axial one.
    EXPECT_LE(largest, 12.5716 * MPa * 1.001);
    EXPECT_GE(largest, 12.5716 * MPa * std::pow(0.887, 0.15) * 0.999);
  }
}

/// Pressures while the volume goes to `largest` times its own and back.
std::vector<std::pair<double, double>> pull_and_push(Point& p, double largest) {
  const int steps = 1000;
  const double d = std::log(largest) / steps / 3;
  std::vector<std::pair<double, double>> back;  // V/V0, p
  for (int n = 0; n < steps; ++n) p.strain({d, d, d});
  for (int n = steps - 1; n >= 0; --n) {
    p.strain({-d, -d, -d});
    back.emplace_back(std::exp(3 * d * n), p.pressure());
  }
  return back;
}

TEST(RateDependentVoids, OpenedVoidsStayAsBulkingAndCarryPressureAtOnce) {
  auto p = point(1000);
  for (const auto& [volume, pressure] : pull_and_push(p, 1.1))
    EXPECT_NEAR(pressure, elastic.bulk_modulus * (1 / volume - 1 / 1.1), 0.51 * MPa) << volume;
  EXPECT_NEAR(p.state().bulking, 1 - 1 / 1.1, 1e-4);
}

TEST(RateDependentVoids, BeyondTheLargestBulkingVoidsHaveToClose) {
  auto p = point(1000);
  for (const auto& [volume, pressure] : pull_and_push(p, 3)) {
    if (volume > 2.001) {
      EXPECT_NEAR(pressure, 0, 1e-3) << volume;
    } else if (volume < 1.99) {
      EXPECT_NEAR(pressure / (elastic.bulk_modulus * (1 / volume - 0.5)), 1, 1e-9) << volume;
    }
  }
  EXPECT_EQ(p.state().bulking, 0.5);
}

TEST(RateDependentShear, FailureStrainIsTheSlipOverGradysFragmentSize) {
  // s = (sqrt(24) 0.1e6/(3.5366e6 r))^(2/3): 2.677 mm at 1e3 /s, 5.77 mm at 316 /s, 12.4 mm at 100 /s.
  EXPECT_NEAR(ice().failure_strain(1e3), 0.5 / 2.677, 1e-4);
  EXPECT_NEAR(ice().failure_strain(100), 0.5 / 12.43, 1e-4);
  EXPECT_EQ(ice().failure_strain(1), 0.002);  // never less
  EXPECT_EQ(ice(0.01).failure_strain(500), ice(0.001).failure_strain(500));
}

TEST(RateDependentShear, StrengthFallsLinearlyOverTheFailureStrainToResidualFriction) {
  for (const double rate : {1.0, 300.0, 5000.0}) {
    auto p = point(rate);
    compress(p, 0.006);
    const double pressure = p.pressure(), peak = ice().compressive_strength(rate);
    const double residual = std::sqrt(3.0) * 3 * 0.0347796 * pressure;
    ASSERT_LT(residual, peak * 1.2);
    double before = 0;
    for (int n = 0; n < 60000 && !p.state().failed; ++n) {
      squeeze(p);
      if (p.state().plastic_strain > 0) {
        const double D = before / ice().failure_strain(rate);
        EXPECT_NEAR(von_mises_of(p) / ((1 - D) * peak + D * std::min(peak, residual)), 1, 1e-5);
        EXPECT_NEAR(p.state().shear_damage, std::min(1.0, p.state().plastic_strain / ice().failure_strain(rate)), 1e-9);
      }
      before = p.state().plastic_strain;
    }
    EXPECT_TRUE(p.state().failed);
    EXPECT_EQ(p.state().tensile_damage, 0);
  }
}

/// von Mises stress of crushed ice in shear at a pressure.
double residual_strength(double volume_strain, double& pressure) {
  auto p = point(100);
  compress(p, volume_strain);
  p.state().shear_damage = 1;
  for (int n = 0; n < 1000; ++n) squeeze(p);
  pressure = p.pressure();
  return p.sqrt_j2();
}

TEST(RateDependentShear, CrushedIceLiesOnTheFrictionLineUpToItsStrength) {
  double pressure = 0;
  for (const double volume_strain : {1e-4, 1e-3, 1e-2}) {
    const double sqrt_j2 = residual_strength(volume_strain, pressure);
    EXPECT_NEAR(sqrt_j2 / (0.104339 * pressure), 1, 1e-5);
  }
  EXPECT_NEAR(residual_strength(0.1, pressure) / (17.7580 * MPa / std::sqrt(3.0)), 1, 1e-5);
}

TEST(RateDependentShear, ShearUnderPressureDoesNotDilate) {
  auto p = point(1000);
  compress(p, 0.01);
  const double before = p.pressure();
  for (int n = 0; n < 30000; ++n) p.strain({0, 0, 0, step});
  EXPECT_EQ(p.state().shear_damage, 1);
  EXPECT_EQ(p.state().bulking, 0);
  EXPECT_NEAR(p.pressure() / before, 1, 1e-12);
}

TEST(RateDependentShear, SplittingUnderPressureDoesNotDilate) {
  auto p = point(1000);
  compress(p, 5e-4);
  p.state().tensile_damage = 1;
  for (int n = 0; n < 1000; ++n) squeeze(p);  // lateral stresses of cracked ice want to be tensile
  EXPECT_EQ(p.state().bulking, 0);
}

TEST(RateDependentIce, DoesNotDependOnTheFrame) {
  const Mat3 Q = Eigen::AngleAxisd(1.1, Vec3(1, -2, 3).normalized()).toRotationMatrix();
  const auto turned = [&](const Sym3& s) { return symmetric_part(Q * to_matrix(s) * Q.transpose()); };
  auto a = point(1000, 1e-3), b = a;
  test::Random random(2);
  for (int n = 0; n < 300; ++n) {
    const Sym3 d = add_isotropic(1e-3 * random.tensor(), n < 150 ? -1e-4 : 2e-4);
    a.strain(d), b.strain(turned(d));
    EXPECT_LT((to_matrix(b.stress()) - to_matrix(turned(a.stress()))).norm(), 1e-6 * (MPa + a.sqrt_j2())) << n;
    EXPECT_NEAR(b.state().shear_damage, a.state().shear_damage, 1e-9);
    EXPECT_NEAR(b.state().tensile_damage, a.state().tensile_damage, 1e-9);
  }
  EXPECT_GT(a.state().shear_damage, 0);
  EXPECT_GT(a.state().tensile_damage, 0);
}

TEST(RateDependentIce, IsFiniteAndWithinItsLimitsForEveryInput) {
  test::Random random(3);
  const auto magnitude = [&](double low, double high) {
    return std::pow(10, low + (high - low) * (0.5 + random() / 2));
  };
  for (int n = 0; n < 200000; ++n) {
    DamageState s{magnitude(-3, 6), 0.5 + random() / 2, 0.5 + random() / 2, 0, 0.25 + random() / 4};
    if (n % 7 == 0) s = {};
    if (n % 5 == 0) s.tensile_damage = 1;
    const double limit = (1 - s.tensile_damage) * 0.5 * MPa;
    const StrainStep d{magnitude(-15, 3) * random.tensor(), 50 * std::pow(random(), 3),
                       n % 11 == 0 ? 0 : magnitude(-12, 1)};
    const Sym3 before = n % 13 == 0 ? Sym3{} : magnitude(-6, 15) * random.tensor();
    const Sym3 stress = ice(magnitude(-6, 1)).update(before, d, s);
    ASSERT_TRUE(to_matrix(stress).allFinite()) << n;
    ASSERT_TRUE(s.tensile_damage >= 0 && s.tensile_damage <= 1 && s.shear_damage >= 0 && s.shear_damage <= 1) << n;
    ASSERT_TRUE(s.bulking >= 0 && s.bulking <= 0.5 && std::isfinite(s.plastic_strain)) << n;
    ASSERT_TRUE(s.strain_rate >= 0 && std::isfinite(s.strain_rate)) << n;
    const double scale = to_matrix(stress).norm() + std::abs(elastic.bulk_modulus * d.compression);
    const double largest = Eigen::SelfAdjointEigenSolver<Mat3>(to_matrix(stress)).eigenvalues()[2];
    ASSERT_LE(largest, limit + 1e-12 * (scale + to_matrix(before).norm())) << n;
    ASSERT_LE(std::sqrt(3 * second_invariant(deviator(stress))), 35.4314 * MPa * 1.001 + 1e-12 * scale) << n;
  }
}

}  // namespace
}  // namespace nilas::sph
