// The oracles and builders that the tests of sph/ rest on, checked against what is known without them.
#include <gtest/gtest.h>

#include "tests/support/material_point.hpp"
#include "tests/support/pair_sums.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph::test {
namespace {

TEST(PairSumsOracle, KernelSlopeIntegratesToTheKernelAtItsCentre) {
  const double h = 0.7;
  double sum = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) sum += kernel_slope((i + 0.5) * 2 * h / n, h) * 2 * h / n;
  EXPECT_NEAR(-sum, 21 / (16 * std::numbers::pi * h * h * h), 1e-7);
}

TEST(PairSumsOracle, KernelSlopeIsThatOfTheKernelValue) {
  const double h = 0.7, step = 1e-5;
  for (double r = 0.05; r < 2.2 * h; r += 0.1)
    EXPECT_NEAR((kernel_value(r + step, h) - kernel_value(r - step, h)) / (2 * step), kernel_slope(r, h), 1e-8);
}

// With h much larger than the spacing the sums approach the integrals: C = 1, D Laplace(rho) = 6 D for rho = x^2.
TEST(PairSumsOracle, ConcentrationAndDensityRateApproachTheirIntegrals) {
  Particles p = particles_at(jittered_block({13, 13, 13}, 1, 0), 1);
  const std::size_t centre = (6 * 13 + 6) * 13 + 6;
  for (Motion& m : p.motion) m.volume = 1 / (1 + 1e-6 * (m.position - p.motion[centre].position).squaredNorm());
  const PairSums sums(p, 3);
  EXPECT_NEAR(sums.concentration(centre), 1, 1e-2);
  EXPECT_LT(sums.concentration_gradient(centre).norm(), 1e-12);
  EXPECT_NEAR(sums.density_rate(centre, 2) / (900 * 2 * 6e-6), 1, 0.03);  // 0.01 h^2 takes about 2 %
}

TEST(PairSumsOracle, ShortestImageIsWithinHalfAPeriodAndEquivalent) {
  Random random(3);
  const Vec3 period(2, 0, 3);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 d = Vec3(2, 1, 3).cwiseProduct(random.vector());
    const Vec3 image = shortest_of_all_images(d, period);
    EXPECT_LE(std::abs(image[0]), 1 + 1e-12);
    EXPECT_EQ(image[1], d[1]);
    EXPECT_LE(std::abs(image[2]), 1.5 + 1e-12);
    EXPECT_NEAR(std::remainder(image[0] - d[0], 2), 0, 1e-12);
    EXPECT_NEAR(std::remainder(image[2] - d[2], 3), 0, 1e-12);
  }
}

// With h much larger than the spacing the kernel sum approaches the integral, whose moment is the identity.
TEST(PairSumsOracle, MomentMatrixApproachesTheIdentityForASmoothKernel) {
  const Particles p = particles_at(jittered_block({13, 13, 13}, 1, 0), 1);
  const PairSums sums(p, 3);
  const std::size_t centre = (6 * 13 + 6) * 13 + 6;
  EXPECT_LT((sums.moment(centre) - Mat3::Identity()).norm(), 1e-2);
}

TEST(PairSumsOracle, LatticeFactorIsTheMomentInsideALatticeAndTendsToOne) {
  const Particles p = particles_at(jittered_block({9, 9, 9}, 1, 0), 1);
  const std::size_t centre = (4 * 9 + 4) * 9 + 4;
  for (const double ratio : {1.3, 2.0})
    EXPECT_LT((PairSums(p, ratio).moment(centre) - lattice_factor(ratio) * Mat3::Identity()).norm(), 1e-12);
  EXPECT_NEAR(lattice_factor(4), 1, 1e-3);
}

TEST(PairSumsOracle, UniformStressLeavesAnInteriorParticleOfALatticeInBalance) {
  Particles p = particles_at(jittered_block({9, 9, 9}, 1, 0), 1);
  for (Sym3& s : p.stress) s = {3, -2, 1, 0.5, 0.25, -1};
  const std::size_t centre = (4 * 9 + 4) * 9 + 4;
  EXPECT_LT(PairSums(p, 1.3).acceleration(centre, {}, {}).norm() * p.mass, 1e-12);
}

TEST(PairSumsOracle, ViscosityOpposesApproachAndNothingElse) {
  Particles p = particles_at({{0, 0, 0}, {1, 0, 0}}, 1);
  const PairSums::Viscosity viscosity{0.1, 0.2, 3000};
  p.motion[0].velocity = {1, 5, 0};
  EXPECT_LT(PairSums(p, 1.3).viscous_force(0, 1, viscosity)[0], 0);
  p.motion[0].velocity = {-1, 5, 0};
  EXPECT_EQ(PairSums(p, 1.3).viscous_force(0, 1, viscosity), Vec3::Zero());
}

TEST(MaterialPointDriver, ElasticPointHasYoungsModulusAndPoissonsRatio) {
  MaterialSpec spec;
  MaterialPoint point(Elastic{ElasticConstants(spec), PressureLaw::volumetric_strain});
  for (int n = 0; n < 10; ++n) point.axial(1e-5, 0);
  EXPECT_NEAR(point.stress().xx / (spec.young_modulus * 1e-4), 1, 1e-9);
  EXPECT_NEAR(point.lateral_strain() / -(spec.poisson_ratio * 1e-4), 1, 1e-9);
  EXPECT_NEAR(point.stress().yy, 0, 1);
}

TEST(MaterialPointDriver, LateralStressIsHeldWhereItIsAsked) {
  MaterialPoint point(Elastic{ElasticConstants(MaterialSpec{}), PressureLaw::density});
  for (int n = 0; n < 10; ++n) point.axial(-1e-5, -2e6);
  EXPECT_NEAR(point.stress().yy / -2e6, 1, 1e-6);
  EXPECT_NEAR(point.stress().zz / -2e6, 1, 1e-6);
}

}  // namespace
}  // namespace nilas::sph::test
