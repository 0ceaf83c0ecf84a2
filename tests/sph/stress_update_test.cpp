#include "sph/stress_update.hpp"

#include <gtest/gtest.h>

#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

using test::Random;

constexpr double dx = 0.02, rho = 900;

MaterialSpec elastic_ice(PressureLaw law = PressureLaw::volumetric_strain) {
  MaterialSpec m;
  m.model = Model::elastic;
  m.pressure = law;
  return m;
}

Material law_of(const MaterialSpec& spec) { return make_material(spec, dx, 1.3 * dx); }

Particles particles(std::size_t n, bool plastic = false, bool bulking = false) {
  Particles p = test::particles_at(std::vector<Vec3>(n, Vec3::Zero()), dx);
  if (plastic) p.plastic_strain.assign(n, 0), p.failed.assign(n, 0);
  if (bulking) p.bulking.assign(n, 0);
  return p;
}

Mat3 spin(const Vec3& w) {
  Mat3 W;
  W << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
  return W;
}

TEST(StressUpdate, VolumeFollowsContinuityExactly) {
  Particles p = particles(1);
  p.velocity_gradient[0] = Vec3(100, -30, 50).asDiagonal();
  for (int n = 0; n < 1000; ++n) update_stress(p, law_of(elastic_ice()), rho, 1e-6);
  EXPECT_NEAR(p.motion[0].volume / (dx * dx * dx * std::exp(120 * 1e-3)), 1, 1e-12);
}

// V3.
TEST(StressUpdate, RigidRotationChangesNeitherDensityNorStressInvariants) {
  for (const PressureLaw law : {PressureLaw::volumetric_strain, PressureLaw::density}) {
    Particles p = particles(1);
    p.stress[0] = law == PressureLaw::density ? Sym3{1e6, -1e6, 0, 2e6, 3e6, 0} : Sym3{1e6, -3e6, 2e6, 2e6, 3e6, 1e6};
    const double pressure = -trace(p.stress[0]) / 3, j2 = second_invariant(deviator(p.stress[0]));
    p.velocity_gradient[0] = spin({2000, -1000, 3000});
    double work = 0;
    for (int n = 0; n < 1000; ++n) work += update_stress(p, law_of(elastic_ice(law)), rho, 1e-6).work;
    EXPECT_EQ(p.density(0), p.mass / (dx * dx * dx));
    EXPECT_NEAR(-trace(p.stress[0]) / 3, pressure, 1e-6);
    EXPECT_NEAR(second_invariant(deviator(p.stress[0])) / j2, 1, 1e-11);
    EXPECT_EQ(work, 0);
  }
}

TEST(StressUpdate, ElasticPulseOfStrainGivesHookesLaw) {
  Particles p = particles(1);
  const Sym3 strain{1e-5, -2e-5, 3e-5, 4e-5, -5e-5, 6e-5};
  p.velocity_gradient[0] = to_matrix(strain) / 1e-6;
  update_stress(p, law_of(elastic_ice()), rho, 1e-6);
  const ElasticConstants e{elastic_ice()};
  const double lambda = e.bulk_modulus - 2 * e.shear_modulus / 3;
  const Mat3 expected = lambda * trace(strain) * Mat3::Identity() + 2 * e.shear_modulus * to_matrix(strain);
  EXPECT_LT((to_matrix(p.stress[0]) - expected).norm(), 1e-12 * expected.norm());
}

TEST(StressUpdate, WorkOnElasticIceIsTheEnergyItStores) {
  Particles p = particles(50);
  Random random(1);
  double work = 0;
  const Material law = law_of(elastic_ice());
  for (int n = 0; n < 50; ++n) {
    for (Mat3& L : p.velocity_gradient) L = 2 * random.matrix() + spin({100, 200, -300});
    work += update_stress(p, law, rho, 1e-6).work;
  }
  const double stored = elastic_energy(p, law_of(elastic_ice()));
  ASSERT_GT(stored, 0);
  EXPECT_NEAR(work / stored, 1, 1e-3);  // the volume changes by 1e-4: not exactly hyperelastic
}

TEST(StressUpdate, ElasticEnergyOfPureShearAndPurePressure) {
  const ElasticConstants e{elastic_ice()};
  const double volume = dx * dx * dx;
  Particles p = particles(2);
  p.stress[0].xz = 3e6;              // tau^2 / (2G)
  p.stress[1] = {-4e6, -4e6, -4e6};  // p^2 / (2K)
  const double expected = volume * (9e12 / (2 * e.shear_modulus) + 16e12 / (2 * e.bulk_modulus));
  EXPECT_NEAR(elastic_energy(p, law_of(elastic_ice())) / expected, 1, 1e-12);
}

TEST(StressUpdate, PlasticWorkExceedsStoredEnergyAndFailuresAreCounted) {
  MaterialSpec m;
  m.after_failure = AfterFailure::plastic;
  Particles p = particles(300, true);
  for (std::size_t i = 0; i < p.size(); ++i) p.velocity_gradient[i](0, 1) = i < 100 ? 1000 : 1;
  StressUpdateSums sums;
  double work = 0;
  for (int n = 0; n < 100; ++n) {
    sums = update_stress(p, law_of(m), rho, 1e-6);
    work += sums.work;
  }
  EXPECT_EQ(sums.failed, 100u);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(p.failed[i] != 0, i < 100);
    EXPECT_EQ(p.plastic_strain[i] > 0, i < 100);
  }
  EXPECT_GT(work, elastic_energy(p, law_of(m)));
}

TEST(StressUpdate, ElasticIceCountsNoFailures) {
  Particles p = particles(10);
  for (Mat3& L : p.velocity_gradient) L(0, 1) = 1e6;
  EXPECT_EQ(update_stress(p, law_of(elastic_ice()), rho, 1e-3).failed, 0u);
}

TEST(StressUpdate, BulkingIsKeptPerParticleWithPressureFromDensity) {
  MaterialSpec m;
  m.after_failure = AfterFailure::plastic;
  m.pressure = PressureLaw::density;
  Particles p = particles(2, true, true);
  for (Motion& motion : p.motion) motion.volume *= 0.99;
  p.velocity_gradient[1](0, 1) = 1e4;
  for (int n = 0; n < 200; ++n) update_stress(p, law_of(m), rho, 1e-6);
  EXPECT_EQ(p.bulking[0], 0);
  EXPECT_GT(p.bulking[1], 0);
}

TEST(StressUpdate, CollapsedAndNonFiniteParticlesAreReportedByLowestIndex) {
  Particles p = particles(2000);
  const Material law = law_of(elastic_ice());
  EXPECT_EQ(update_stress(p, law, rho, 1e-6).out_of_range, static_cast<std::size_t>(-1));
  p.velocity_gradient[1500] = -1e7 * Mat3::Identity();
  EXPECT_EQ(update_stress(p, law, rho, 1e-6).out_of_range, 1500u);
  p.velocity_gradient[700](1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(update_stress(p, law, rho, 1e-6).out_of_range, 700u);
}

TEST(StressUpdate, RunawayExpansionIsReported) {
  Particles p = particles(10);
  p.velocity_gradient[3] = 1e9 * Mat3::Identity();
  EXPECT_EQ(update_stress(p, law_of(elastic_ice()), rho, 1e-6).out_of_range, 3u);
}

TEST(StressUpdate, IsBitIdenticalForOneAndTwoThreads) {
  const auto run = [](int threads) {
    const test::Threads scope(threads);
    MaterialSpec m;
    Particles p = particles(5000, true);
    Random random(2);
    double work = 0;
    for (Mat3& L : p.velocity_gradient) L = 300 * random.matrix();
    for (int n = 0; n < 20; ++n) work += update_stress(p, law_of(m), rho, 1e-6).work;
    std::vector<Mat3> stress;
    for (const Sym3& s : p.stress) stress.push_back(to_matrix(s));
    return std::tuple{stress, p.failed, p.plastic_strain, work};
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace nilas::sph
