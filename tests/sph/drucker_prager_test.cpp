#include "sph/drucker_prager.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

constexpr double MPa = 1e6;

/// The ice of Cai et al. 2025: phi 36 deg, c 0.58 MPa, E 9.38 GPa, nu 0.33; dilation as asked.
DruckerPragerCone cone(double friction_deg = 36, double dilation_deg = 12, double cohesion = 0.58e6) {
  MaterialSpec m;
  m.friction_angle_deg = friction_deg;
  m.dilation_angle_deg = dilation_deg;
  m.cohesion = cohesion;
  return {m, ElasticConstants(m)};
}

ReturnedStress give_back(const DruckerPragerCone& c, const Sym3& trial, double strength = 1) {
  return c.return_map(deviator(trial), -trace(trial) / 3, strength);
}
Sym3 full(const ReturnedStress& r) { return add_isotropic(r.deviator, -r.pressure); }
double yield(const DruckerPragerCone& c, const ReturnedStress& r) {
  return c.yield_function(std::sqrt(second_invariant(r.deviator)), r.pressure);
}

TEST(DruckerPragerCone, ConstantsAreThoseOfThePlaneStrainFit) {
  EXPECT_NEAR(cone().alpha, 0.185536, 5e-7);
  EXPECT_NEAR(cone().k / MPa, 0.444341, 5e-7);
  EXPECT_NEAR(cone().alpha_psi, 0.0688099, 5e-8);
  EXPECT_NEAR(cone().tension_limit() / MPa, 0.798302, 5e-7);
  EXPECT_NEAR(cone().bulk_modulus / 1e9, 9.19608, 5e-6);
  EXPECT_NEAR(cone().shear_modulus / 1e9, 3.52632, 5e-6);
}

TEST(DruckerPragerCone, TensionLimitIsCohesionOverTheTangentOfFriction) {
  for (const double phi : {1.0, 10.0, 36.0, 60.0})
    EXPECT_NEAR(cone(phi).tension_limit() / (0.58e6 / std::tan(phi * std::numbers::pi / 180)), 1, 1e-12);
}

struct Row {
  const char* name;
  Sym3 trial;  // MPa
  double dilation_deg;
  Sym3 returned;      // MPa
  double multiplier;  // negative: the table gives none (apex)
};

// V7. Values to the digits of the table.
const Row table[] = {
    {"compression 2", {-2, 0, 0}, 12, {-1.839091, -0.291264, -0.291264}, 7.403261e-5},
    {"compression 10 confined", {-10, -2, -2}, 12, {-9.252117, -3.353750, -3.353750}, 3.440924e-4},
    {"shear 5", {0, 0, 0, 5}, 12, {-1.887040, -1.887040, -1.887040, 1.494682}, 9.940453e-4},
    {"shear 5 without dilation", {0, 0, 0, 5}, 0, {0, 0, 0, 0.444341}, 1.291903e-3},
    {"shear 5 associated", {0, 0, 0, 5}, 36, {-3.657611, -3.657611, -3.657611, 2.480196}, 7.145712e-4},
    {"hydrostatic tension", {5, 5, 5}, 12, {0.798302, 0.798302, 0.798302}, -1},
    {"uniaxial tension", {5, 0, 0}, 12, {0.609802, 0.101166, 0.101166}, 7.353540e-4},
    {"uniaxial tension without dilation", {5, 0, 0}, 0, {0.798302, 0.798302, 0.798302}, -1},
    {"tension with shear", {3, 3, 3, 1}, 12, {0.798302, 0.798302, 0.798302}, -1},
    {"large compression with shear",
     {-100, -40, -40, 30},
     12,
     {-96.915010, -48.989081, -48.989081, 23.962965},
     2.615116e-3},
    {"hydrostatic compression", {-50, -50, -50}, 12, {-50, -50, -50}, 0},
};

TEST(DruckerPragerReturn, GivesTheTabulatedStresses) {
  for (const Row& row : table) {
    const ReturnedStress r = give_back(cone(36, row.dilation_deg), MPa * row.trial);
    const Mat3 error = to_matrix(full(r)) / MPa - to_matrix(row.returned);
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-6) << row.name;
    if (row.multiplier >= 0) {
      EXPECT_NEAR(r.multiplier, row.multiplier, 1e-6 * row.multiplier + 1e-15) << row.name;
    }
    EXPECT_EQ(r.yielded, row.multiplier != 0) << row.name;
  }
}

TEST(DruckerPragerReturn, InvariantsAndPlasticVolumeOfTheTable) {
  const ReturnedStress compression = give_back(cone(), {-2 * MPa, 0, 0});
  EXPECT_NEAR(compression.pressure / MPa, 0.807206, 1e-6);
  EXPECT_NEAR(std::sqrt(second_invariant(compression.deviator)) / MPa, 0.893638, 1e-6);
  EXPECT_NEAR(give_back(cone(), {5 * MPa, 5 * MPa, 5 * MPa}).plastic_volume, 4.569011e-4, 1e-9);
}

TEST(DruckerPragerReturn, ElasticTrialComesBackUntouched) {
  const Sym3 trial{-50 * MPa, -49.9 * MPa, -50 * MPa, 0.1 * MPa, 0, 0.2 * MPa};
  const ReturnedStress r = give_back(cone(), trial);
  EXPECT_FALSE(r.yielded);
  EXPECT_EQ(r.multiplier, 0);
  EXPECT_EQ(r.plastic_volume, 0);
  EXPECT_EQ(to_matrix(r.deviator), to_matrix(deviator(trial)));
}

// trial - returned = dlam C : dg/dsigma with g = sqrt(J2) + alpha_psi I1, and f = 0: the equations of the return
// themselves, for cone points.
TEST(DruckerPragerReturn, SatisfiesFlowRuleAndConsistencyOnTheCone) {
  test::Random random(1);
  int on_cone = 0;
  for (const double psi : {0.0, 12.0, 36.0}) {
    const DruckerPragerCone c = cone(36, psi);
    for (int n = 0; n < 2000; ++n) {
      const Sym3 trial = add_isotropic(8 * MPa * random.tensor(), 3 * MPa * random());
      const ReturnedStress r = give_back(c, trial);
      const double sqrt_j2 = std::sqrt(second_invariant(r.deviator));
      if (!r.yielded || sqrt_j2 == 0) continue;
      ++on_cone;
      const Mat3 direction = to_matrix(r.deviator) / (2 * sqrt_j2) + c.alpha_psi * Mat3::Identity();
      const Mat3 relaxed = c.bulk_modulus * direction.trace() * Mat3::Identity() +
                           2 * c.shear_modulus * (direction - direction.trace() / 3 * Mat3::Identity());
      EXPECT_LT((to_matrix(trial) - to_matrix(full(r)) - r.multiplier * relaxed).norm(),
                1e-10 * to_matrix(trial).norm());
      EXPECT_GT(r.multiplier, 0);
      EXPECT_NEAR(yield(c, r), 0, 1e-12 * c.k * 10);
      EXPECT_NEAR(r.plastic_volume, 3 * c.alpha_psi * r.multiplier, 1e-12);
    }
  }
  EXPECT_GT(on_cone, 3000);
}

// Associated flow: the returned stress is the admissible one closest to the trial in the norm of the elastic energy,
// so that (trial - returned) : C^-1 : (other - returned) <= 0 for every admissible other.
TEST(DruckerPragerReturn, AssociatedReturnIsTheClosestAdmissibleStressOnConeAndApex) {
  const DruckerPragerCone c = cone(36, 36);
  const auto energy_product = [&](const Sym3& a, const Sym3& b) {
    return contract(deviator(a), deviator(b)) / (2 * c.shear_modulus) + trace(a) * trace(b) / (9 * c.bulk_modulus);
  };
  test::Random random(2);
  std::vector<Sym3> admissible;
  while (admissible.size() < 500) {
    const Sym3 s = add_isotropic(5 * MPa * random.tensor(), -10 * MPa * random());
    if (c.yield_function(std::sqrt(second_invariant(deviator(s))), -trace(s) / 3) <= 0) admissible.push_back(s);
  }
  const double apex = c.tension_limit();
  admissible.push_back({apex, apex, apex});
  for (int n = 0; n < 500; ++n) {
    const Sym3 trial = add_isotropic(8 * MPa * random.tensor(), 6 * MPa * random());
    const Sym3 returned = full(give_back(c, trial));
    const Sym3 relaxed = trial + -1.0 * returned;
    for (const Sym3& other : admissible)
      EXPECT_LE(energy_product(relaxed, other + -1.0 * returned), 1e-12 * energy_product(trial, trial) + 1e-9);
  }
}

TEST(DruckerPragerReturn, IsIdempotent) {
  test::Random random(3);
  for (const double psi : {0.0, 12.0, 36.0})
    for (const double strength : {0.0, 0.3, 1.0})
      for (int n = 0; n < 1000; ++n) {
        const DruckerPragerCone c = cone(36, psi);
        const ReturnedStress once =
            give_back(c, add_isotropic(8 * MPa * random.tensor(), 5 * MPa * random()), strength);
        const ReturnedStress twice = c.return_map(once.deviator, once.pressure, strength);
        EXPECT_LT((to_matrix(full(twice)) - to_matrix(full(once))).norm(),
                  1e-12 * (c.k + to_matrix(full(once)).norm()));
      }
}

TEST(DruckerPragerReturn, EndsInsideTheSurface) {
  test::Random random(4);
  for (const double psi : {0.0, 12.0, 36.0})
    for (int n = 0; n < 20000; ++n) {
      const DruckerPragerCone c = cone(36, psi);
      const ReturnedStress r = give_back(c, add_isotropic(4 * c.k * random.tensor(), 4 * c.k * random()));
      EXPECT_LE(yield(c, r), 1e-12 * c.k);
      EXPECT_GE(r.pressure, -c.tension_limit() * (1 + 1e-15));
    }
}

/// Finite, inside the surface at the strength asked for, no more tension than its limit; trials of 1 to 1e12 Pa.
void expect_total(const DruckerPragerCone& c, int trials, std::uint64_t seed) {
  test::Random random(seed);
  for (int n = 0; n < trials; ++n) {
    const double deviatoric = std::pow(10, 6 * (1 + random())), pressure = std::pow(10, 6 * (1 + random()));
    const Sym3 S = deviator(deviatoric * random.tensor());
    const double p = pressure * (random() > 0 ? 1 : -1), strength = n % 3 == 0 ? 0.5 * (1 + random()) : n % 3 - 1;
    const ReturnedStress r = c.return_map(S, p, strength);
    const double sqrt_j2 = std::sqrt(second_invariant(r.deviator)), scale = deviatoric + pressure + c.k;
    ASSERT_TRUE(std::isfinite(sqrt_j2) && std::isfinite(r.pressure) && std::isfinite(r.multiplier) &&
                std::isfinite(r.plastic_volume));
    ASSERT_GE(r.multiplier, 0);
    ASSERT_LE(sqrt_j2 - strength * (3 * c.alpha * r.pressure + c.k), 1e-12 * scale);
    const double tension = strength > 0 ? strength * c.tension_limit() : 0;
    ASSERT_GE(r.pressure, -tension - 1e-12 * scale);
  }
}

TEST(DruckerPragerReturn, IsDefinedForAMillionTrialsFromOneToATrillionPascals) {
  for (const double phi : {0.0, 1e-6, 36.0, 60.0, 89.0})
    for (const double psi : {0.0, 12.0}) expect_total(cone(phi, psi), 100000, 5);
  expect_total(cone(36, 12, 0), 100000, 6);  // no cohesion
  expect_total(cone(0, 0, 0), 100000, 7);    // a fluid
  expect_total(cone().cohesionless(), 100000, 8);
}

TEST(DruckerPragerReturn, StressFreeAndPurelyHydrostaticTrialsAreFinite) {
  for (const double phi : {0.0, 36.0})
    for (const double cohesion : {0.0, 0.58e6})
      for (const double strength : {0.0, 0.5, 1.0})
        for (const double p : {-1e10, -1.0, 0.0, 1.0, 1e10}) {
          const ReturnedStress r = cone(phi, 12, cohesion).return_map({}, p, strength);
          EXPECT_TRUE(std::isfinite(r.pressure));
          EXPECT_EQ(to_matrix(r.deviator), Mat3::Zero());
          if (p >= 0) {
            EXPECT_EQ(r.pressure, p);
          }
        }
}

TEST(DruckerPragerReturn, WithoutFrictionIsVonMises) {
  const DruckerPragerCone c = cone(0, 0);
  EXPECT_EQ(c.alpha, 0);
  EXPECT_DOUBLE_EQ(c.k, 0.58e6);
  EXPECT_TRUE(std::isinf(c.tension_limit()));
  for (const double p : {-1e9, 0.0, 1e9}) {
    const ReturnedStress r = c.return_map({0, 0, 0, 5 * MPa}, p);
    EXPECT_DOUBLE_EQ(r.deviator.xy, 0.58e6);
    EXPECT_EQ(r.pressure, p);
    EXPECT_EQ(r.plastic_volume, 0);
  }
}

TEST(DruckerPragerReturn, StrengthScalesYieldStressAndTensionLimit) {
  const DruckerPragerCone c = cone(36, 0);
  for (const double strength : {0.1, 0.5, 1.0}) {
    const double p = 3 * MPa;
    const ReturnedStress shear = c.return_map({0, 0, 0, 50 * MPa}, p, strength);
    EXPECT_NEAR(shear.deviator.xy, strength * (3 * c.alpha * p + c.k), 1e-6);
    EXPECT_NEAR(c.return_map({}, -50 * MPa, strength).pressure, -strength * c.tension_limit(), 1e-6);
  }
}

TEST(DruckerPragerReturn, NoStrengthLeavesPressureOnly) {
  for (const double phi : {0.0, 36.0}) {
    const DruckerPragerCone c = cone(phi);
    const ReturnedStress compressed = c.return_map({3 * MPa, -3 * MPa, 0, 1 * MPa}, 7 * MPa, 0);
    EXPECT_LT(std::sqrt(second_invariant(compressed.deviator)), 1e-15 * 3 * MPa);
    EXPECT_EQ(compressed.pressure, 7 * MPa);
    EXPECT_EQ(c.return_map({3 * MPa, -3 * MPa, 0, 1 * MPa}, -7 * MPa, 0).pressure, 0);
  }
}

TEST(DruckerPragerCone, CohesionlessKeepsFrictionAndCarriesNoTension) {
  for (const double phi : {0.0, 36.0}) {
    const DruckerPragerCone crushed = cone(phi).cohesionless();
    EXPECT_EQ(crushed.alpha, cone(phi).alpha);
    EXPECT_EQ(crushed.k, 0);
    EXPECT_EQ(crushed.tension_limit(), 0) << "friction angle " << phi;
    EXPECT_EQ(crushed.return_map({}, -5 * MPa).pressure, 0) << "friction angle " << phi;
    const ReturnedStress r = crushed.return_map({0, 0, 0, 50 * MPa}, 2 * MPa);
    EXPECT_NEAR(r.deviator.xy, 3 * crushed.alpha * 2 * MPa, 1e-6);
    EXPECT_EQ(r.plastic_volume, 0);
  }
}

}  // namespace
}  // namespace nilas::sph
