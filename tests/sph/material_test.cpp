#include "sph/material.hpp"

#include <gtest/gtest.h>

#include "tests/support/material_point.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

using test::MaterialPoint;

constexpr double MPa = 1e6;
constexpr double step = 1e-5;  // strain increment

MaterialSpec ice(AfterFailure after = AfterFailure::plastic, PressureLaw pressure = PressureLaw::volumetric_strain) {
  MaterialSpec m;
  m.after_failure = after;
  m.pressure = pressure;
  return m;
}
MaterialPoint<DruckerPrager> point(const MaterialSpec& m) { return MaterialPoint(DruckerPrager(m)); }

/// Axial stress after loading in steps at constant lateral stress.
double axial_strength(double sign, double confinement = 0) {
  auto p = point(ice());
  const ElasticConstants e{MaterialSpec{}};
  const double isotropic = -confinement / (3 * e.bulk_modulus);
  p.strain({isotropic, isotropic, isotropic});
  for (int n = 0; n < 1000; ++n) p.axial(sign * step, -confinement);
  return p.stress().xx;
}

// V8.
TEST(DruckerPragerPaths, UniaxialStrengths) {
  EXPECT_NEAR(axial_strength(-1) / (-1.13406 * MPa), 1, 1e-3);
  EXPECT_NEAR(axial_strength(+1) / (0.582447 * MPa), 1, 1e-3);
}

TEST(DruckerPragerPaths, TriaxialStressDifferenceRisesWithConfinement) {
  const double table[][2] = {{0, 1.13406}, {1, 2.55465}, {5, 8.23701}, {20, 29.54588}};  // MPa
  for (const auto& row : table)
    EXPECT_NEAR(-axial_strength(-1, row[0] * MPa) - row[0] * MPa, row[1] * MPa, 1e-3 * row[1] * MPa);
}

TEST(DruckerPragerPaths, HydrostaticCompressionNeverYields) {
  auto p = point(ice());
  for (int n = 0; n < 10000; ++n) p.strain({-step, -step, -step});
  EXPECT_FALSE(p.state().failed);
  EXPECT_NEAR(p.pressure() / (0.3 * ElasticConstants(MaterialSpec{}).bulk_modulus), 1, 1e-9);
}

TEST(DruckerPragerPaths, HydrostaticTensionIsCappedAtTheApex) {
  auto p = point(ice());
  for (int n = 0; n < 1000; ++n) p.strain({step, step, step});
  EXPECT_NEAR(p.pressure() / (-0.798302 * MPa), 1, 1e-6);
  EXPECT_LT(p.sqrt_j2(), 1e-6);
}

TEST(DruckerPragerPaths, UniaxialStrainCompressionStaysElasticToAnyLevel) {
  auto p = point(ice());
  for (int n = 0; n < 20000; ++n) p.strain({-step, 0, 0});
  EXPECT_FALSE(p.state().failed);
  EXPECT_NEAR(p.stress().xx / (-0.2 * ElasticConstants(MaterialSpec{}).p_wave_modulus()), 1, 1e-9);
}

TEST(DruckerPragerPaths, UniaxialStrainTensionYieldsAtItsTabulatedStress) {
  auto p = point(ice());
  double at_yield = 0;
  while (!p.state().failed) {
    at_yield = p.stress().xx;
    p.strain({step / 100, 0, 0});
  }
  EXPECT_NEAR(at_yield / (0.672 * MPa), 1, 2e-3);  // tabulated to three digits
}

TEST(DruckerPragerPaths, IsochoricShearLocksAtItsTabulatedSlopes) {
  auto p = point(ice());
  const auto shear = [&](double gamma) { p.strain({0, 0, 0, gamma / 2}); };
  while (!p.state().failed) shear(step);
  const double sqrt_j2 = p.sqrt_j2(), pressure = p.pressure();
  for (int n = 0; n < 1000; ++n) shear(step);
  EXPECT_NEAR((p.sqrt_j2() - sqrt_j2) / (1000 * step) / (813.02 * MPa), 1, 1e-3);
  EXPECT_NEAR((p.pressure() - pressure) / (1000 * step) / (1460.67 * MPa), 1, 1e-3);
}

TEST(DruckerPragerPaths, ShearWithoutDilationStaysAtTheCohesionForGood) {
  MaterialSpec m = ice();
  m.dilation_angle_deg = 0;
  auto p = point(m);
  for (int n = 0; n < 10000; ++n) p.strain({0, 0, 0, step});
  EXPECT_NEAR(p.sqrt_j2() / (0.444341 * MPa), 1, 2e-6);
  EXPECT_NEAR(p.pressure(), 0, 1e-3);
}

TEST(DruckerPragerPaths, VonMisesIceYieldsAtItsCohesionInShearUnderAnyPressure) {
  MaterialSpec m = ice();
  m.friction_angle_deg = m.dilation_angle_deg = 0;
  for (const double compression : {-1e-3, 0.0, 1e-2}) {
    auto p = point(m);
    p.strain({-compression, -compression, -compression});
    const double before = p.pressure();
    for (int n = 0; n < 200; ++n) p.strain({0, 0, 0, step});
    EXPECT_NEAR(p.sqrt_j2() / 0.58e6, 1, 1e-9);
    EXPECT_NEAR(p.pressure(), before, 1e-6);
  }
}

TEST(DruckerPragerPaths, PlasticStrainIsTheTotalLessTheElasticInShear) {
  MaterialSpec m = ice();
  m.dilation_angle_deg = 0;
  auto p = point(m);
  for (int n = 0; n < 1000; ++n) p.strain({0, 0, 0, step});
  // Equivalent strain of a tensor shear e is 2 e / sqrt(3).
  const double plastic = 1000 * step - p.stress().xy / (2 * ElasticConstants(m).shear_modulus);
  EXPECT_NEAR(p.state().plastic_strain / (2 * plastic / std::sqrt(3.0)), 1, 1e-9);
}

/// von Mises ice of yield stress `yield` in uniaxial stress that hardens by `hardening` per plastic strain.
MaterialSpec hardening_ice(double yield, double hardening) {
  MaterialSpec m = ice();
  m.friction_angle_deg = m.dilation_angle_deg = 0;
  m.cohesion = yield / std::sqrt(3.0);
  m.hardening_modulus = hardening;
  return m;
}

TEST(Hardening, UniaxialStressFollowsItsClosedForm) {
  const double yield = 2 * MPa;
  for (const double H : {0.0, 1e8, 6.89e9})
    for (const double sign : {-1.0, 1.0}) {
      const MaterialSpec m = hardening_ice(yield, H);
      const double E = m.young_modulus;
      auto p = point(m);
      for (int n = 1; n <= 200; ++n) {
        p.axial(sign * step, 0);
        const double strain = n * step, plastic = std::max(0.0, (strain - yield / E) * E / (E + H));
        EXPECT_NEAR(sign * p.stress().xx, plastic > 0 ? yield + H * plastic : E * strain, 1e-7 * yield);
        EXPECT_NEAR(p.state().plastic_strain, plastic, 1e-8 * step * n);
      }
    }
}

TEST(Hardening, IsKeptThroughUnloadingAndIsTheSameInBothDirections) {
  const MaterialSpec m = hardening_ice(2 * MPa, 1e9);
  auto p = point(m);
  for (int n = 0; n < 100; ++n) p.axial(step, 0);
  const double reached = p.stress().xx, plastic = p.state().plastic_strain;
  while (p.state().plastic_strain == plastic) p.axial(-step / 100, 0);
  EXPECT_NEAR(p.stress().xx / -reached, 1, 1e-3);  // isotropic: no Bauschinger effect; a step is 5e-4 of it
}

TEST(Hardening, MovesTheConeOutwardsAtTheSameAngles) {
  MaterialSpec m = ice();
  m.hardening_modulus = 1e9;
  const DruckerPragerCone cone(m, ElasticConstants(m)), after = cone.hardened(1e-3);
  EXPECT_NEAR(after.k - cone.k, 1e9 * 1e-3 / std::sqrt(3.0), 1e-6);
  EXPECT_EQ(after.alpha, cone.alpha);
  EXPECT_EQ(after.alpha_psi, cone.alpha_psi);
  EXPECT_NEAR(after.tension_limit() / cone.tension_limit(), after.k / cone.k, 1e-12);
}

TEST(Hardening, EveryReturnEndsOnTheSurfaceOfTheStepsEnd) {
  MaterialSpec m = ice();
  m.hardening_modulus = 2e9;
  const DruckerPragerCone cone(m, ElasticConstants(m));
  auto p = point(m);
  p.strain({-step, -step, -step});
  test::Random random(5);
  for (int n = 0; n < 2000; ++n) {
    p.strain(3e-5 * deviator(random.tensor()));
    const double f = cone.hardened(p.state().plastic_strain).yield_function(p.sqrt_j2(), p.pressure());
    EXPECT_LE(f, 1e-9 * (p.pressure() + MPa));
  }
  EXPECT_GT(p.state().plastic_strain, 1e-3);
}

/// Fails the point by shear under compression.
void fail(MaterialPoint<DruckerPrager>& p) {
  p.strain({-step, -step, -step});
  for (int n = 0; n < 200; ++n) p.strain({0, 0, 0, step});
  ASSERT_TRUE(p.state().failed);
}

TEST(AfterFailure, NothingDiffersBeforeTheFirstYield) {
  for (const AfterFailure after : {AfterFailure::cohesionless, AfterFailure::fluid, AfterFailure::softening}) {
    auto p = point(ice(after)), plastic = point(ice(AfterFailure::plastic));
    const Sym3 increments[] = {{-5e-6, 0, 0, 1e-6}, {1e-6, 2e-6, 0, 0, 3e-6}, {0, 0, 0, -4e-6, 0, 5e-6}};
    for (const Sym3& d : increments) {
      p.strain(d), plastic.strain(d);
      EXPECT_EQ(to_matrix(p.stress()), to_matrix(plastic.stress()));
      EXPECT_FALSE(p.state().failed);
    }
  }
}

TEST(AfterFailure, PlasticIceKeepsItsStrengthAndTension) {
  auto p = point(ice(AfterFailure::plastic));
  fail(p);
  for (int n = 0; n < 5000; ++n) p.strain({step, step, step});
  EXPECT_NEAR(p.pressure() / (-0.798302 * MPa), 1, 1e-6);
}

TEST(AfterFailure, CohesionlessIceKeepsFrictionButNeitherTensionCohesionNorDilation) {
  auto p = point(ice(AfterFailure::cohesionless));
  fail(p);
  const DruckerPragerCone cone(ice(), ElasticConstants(ice()));
  test::Random random(1);
  double largest = 0;
  for (int n = 0; n < 20000; ++n) {
    p.strain(1e-4 * random.tensor());
    EXPECT_GE(p.pressure(), -1e-6);
    EXPECT_LE(p.sqrt_j2(), 3 * cone.alpha * p.pressure() + 1e-5);
    largest = std::max(largest, p.sqrt_j2());
  }
  EXPECT_GT(largest, MPa);
  // Isochoric shear: pressure does not rise.
  while (p.pressure() < MPa) p.strain({-step, -step, -step});
  for (int n = 0; n < 1000; ++n) p.strain({0, 0, 0, step});
  const double before = p.pressure();
  for (int n = 0; n < 1000; ++n) p.strain({0, 0, 0, step});
  EXPECT_NEAR(p.pressure() / before, 1, 1e-12);
  EXPECT_NEAR(p.sqrt_j2() / (3 * cone.alpha * p.pressure()), 1, 1e-9);
}

TEST(AfterFailure, FluidIceCarriesNoDeviatorAndNoTensionForGood) {
  for (const PressureLaw law : {PressureLaw::volumetric_strain, PressureLaw::density}) {
    auto p = point(ice(AfterFailure::fluid, law));
    fail(p);
    test::Random random(2);
    double largest = 0;
    for (int n = 0; n < 20000; ++n) {
      p.strain(1e-4 * random.tensor());
      EXPECT_GE(p.pressure(), -1e-15 * MPa);
      EXPECT_LE(p.sqrt_j2(), 1e-15 * (10 * MPa + p.pressure()));
      EXPECT_TRUE(p.state().failed);
      largest = std::max(largest, p.pressure());
    }
    EXPECT_GT(largest, MPa);
  }
}

TEST(AfterFailure, FluidIceHasFailedInTheStepOfItsFirstYield) {
  auto p = point(ice(AfterFailure::fluid));
  while (!p.state().failed) {
    EXPECT_LE(p.sqrt_j2(), 0.58e6);
    p.strain({0, 0, 0, step});
  }
  EXPECT_LE(p.sqrt_j2(), 1e-15 * MPa);
}

/// Shear stress of softening ice without dilation, at p = 0, over its strength when intact, and its plastic strain.
std::vector<std::pair<double, double>> softening_curve(double residual, double strain) {
  MaterialSpec m = ice(AfterFailure::softening);
  m.dilation_angle_deg = 0;
  m.residual_strength = residual;
  m.softening_strain = strain;
  auto p = point(m);
  const double k = DruckerPragerCone(m, ElasticConstants(m)).k;
  std::vector<std::pair<double, double>> curve;
  for (int n = 0; n < 5000; ++n) {
    const double before = p.state().plastic_strain;
    p.strain({0, 0, 0, step});
    if (p.state().failed) curve.emplace_back(before, p.sqrt_j2() / k);
  }
  return curve;
}

TEST(AfterFailure, SofteningFallsLinearlyWithPlasticStrainToTheResidualStrength) {
  for (const auto& [strain_before, strength] : softening_curve(0.3, 0.02))
    EXPECT_NEAR(strength, 1 - 0.7 * std::min(1.0, strain_before / 0.02), 1e-9);
  EXPECT_GT(softening_curve(0.3, 0.02).back().first, 0.02);
}

TEST(AfterFailure, SofteningOverNoStrainIsAtOnce) {
  for (const auto& [strain_before, strength] : softening_curve(0.3, 0)) EXPECT_NEAR(strength, 0.3, 1e-9);
}

TEST(AfterFailure, SofteningToFullStrengthIsPlasticIce) {
  MaterialSpec m = ice(AfterFailure::softening);
  m.residual_strength = 1;
  m.softening_strain = 0.01;
  auto soft = point(m), plastic = point(ice(AfterFailure::plastic));
  test::Random random(3);
  for (int n = 0; n < 1000; ++n) {
    const Sym3 d = 3e-5 * random.tensor();
    soft.strain(d), plastic.strain(d);
    EXPECT_EQ(to_matrix(soft.stress()), to_matrix(plastic.stress()));
  }
}

TEST(AfterFailure, SofteningScalesTheTensionLimitToo) {
  MaterialSpec m = ice(AfterFailure::softening);
  m.residual_strength = 0.25;
  auto p = point(m);
  fail(p);
  for (int n = 0; n < 5000; ++n) p.strain({step, step, step});
  EXPECT_NEAR(p.pressure() / (-0.25 * 0.798302 * MPa), 1, 1e-6);
}

TEST(PressureFromDensity, IsTheBulkModulusTimesTheCompression) {
  const Elastic law{ElasticConstants(MaterialSpec{}), PressureLaw::density};
  NoState unused{};
  for (const double compression : {-0.1, 0.0, 1e-6, 0.2}) {
    // Whatever the stress was before.
    const Sym3 s = law.update({1e6, 2e6, 3e6, 4e6, 0, 0}, {{}, compression}, unused);
    EXPECT_NEAR(-trace(s) / 3, law.constants.bulk_modulus * compression, 1e-6);
    EXPECT_NEAR(s.xy, 4e6, 1e-6);
  }
}

TEST(PressureFromDensity, EqualsThatFromStrainForSmallStrains) {
  MaterialPoint density(Elastic{ElasticConstants(MaterialSpec{}), PressureLaw::density});
  MaterialPoint strain(Elastic{ElasticConstants(MaterialSpec{}), PressureLaw::volumetric_strain});
  for (int n = 0; n < 10; ++n) {
    density.strain({-1e-6, 2e-6, -4e-6, 1e-6, 0, 0});
    strain.strain({-1e-6, 2e-6, -4e-6, 1e-6, 0, 0});
  }
  EXPECT_NEAR(density.pressure() / strain.pressure(), 1, 1e-4);
}

/// Pulls a point apart by `strain` and pushes it back; pressures on the way back, over the strain still open.
std::vector<std::pair<double, double>> pull_and_push(MaterialPoint<DruckerPrager>& p, int steps) {
  const double d = 1e-4;
  for (int n = 0; n < steps; ++n) p.strain({d / 3, d / 3, d / 3});
  std::vector<std::pair<double, double>> back;
  for (int n = 1; n <= steps + 5; ++n) {
    p.strain({-d / 3, -d / 3, -d / 3});
    back.emplace_back(d * (steps - n), p.pressure());
  }
  return back;
}

TEST(PressureFromDensity, VoidHasToCloseBeforeIceCarriesPressureAgain) {
  for (const AfterFailure after :
       {AfterFailure::plastic, AfterFailure::cohesionless, AfterFailure::fluid, AfterFailure::softening}) {
    MaterialSpec m = ice(after, PressureLaw::density);
    m.residual_strength = 0.3;
    auto p = point(m);
    for (const auto& [open, pressure] : pull_and_push(p, 1000)) {
      if (open > 1e-9) {
        EXPECT_LE(pressure, 0) << "open by " << open;
      }
      if (open < -1e-9) {
        EXPECT_NEAR(pressure / (9.19608e9 * -open), 1, 1e-3) << "compressed by " << -open;
      }
    }
    EXPECT_EQ(p.state().bulking, 0);
  }
}

TEST(PressureFromDensity, VoidOpenedUnderStrainHasToCloseToo) {
  MaterialSpec m = ice(AfterFailure::fluid, PressureLaw::density);
  auto p = point(m);
  test::Random random(4);
  double volume_strain = 0;
  for (int n = 0; n < 20000; ++n) {
    const Sym3 d = add_isotropic(1e-4 * random.tensor(), 3e-7 * (volume_strain > 0 ? -1 : 1));
    volume_strain += trace(d);
    p.strain(d);
    if (p.state().failed && volume_strain > 1e-12) {
      EXPECT_NEAR(p.pressure(), 0, 1e-15 * MPa);
    }
  }
}

TEST(PressureFromStrain, RecompressedIceCarriesPressureAtOnce) {
  auto p = point(ice(AfterFailure::fluid, PressureLaw::volumetric_strain));
  const auto back = pull_and_push(p, 1000);
  EXPECT_NEAR(back.front().second / (1e-4 * 9.19608e9), 1, 1e-4);
}

TEST(PressureFromDensity, DilationUnderCompressionStaysAsBulking) {
  auto p = point(ice(AfterFailure::plastic, PressureLaw::density));
  for (int n = 0; n < 100; ++n) p.strain({-step, -step, -step});
  for (int n = 0; n < 2000; ++n) p.strain({0, 0, 0, step / 2});
  EXPECT_GT(p.state().bulking, 0);
  const double K = ElasticConstants(MaterialSpec{}).bulk_modulus;
  EXPECT_NEAR(p.pressure() / (K * (3e-3 + p.state().bulking)), 1, 2e-3);
  // Dilation of the cone: plastic volume strain = 3 alpha_psi lambda, plastic strain = lambda / sqrt(3).
  EXPECT_NEAR(p.state().bulking / (3 * 0.0688099 * std::sqrt(3.0) * p.state().plastic_strain), 1, 1e-6);
}

TEST(Material, IsTheLawThatTheSpecNames) {
  const auto law = [](Model model) {
    MaterialSpec m;
    m.model = model;
    return make_material(m, 0.02, 0.026);
  };
  EXPECT_TRUE(std::holds_alternative<Elastic>(law(Model::elastic)));
  EXPECT_TRUE(std::holds_alternative<NeoHookean>(law(Model::neo_hookean)));
  EXPECT_TRUE(std::holds_alternative<DruckerPrager>(law(Model::drucker_prager)));
  EXPECT_TRUE(std::holds_alternative<RateDependentIce>(law(Model::rate_dependent)));
}

TEST(ElasticConstants, AreThoseTabulatedForIce) {
  const ElasticConstants e{MaterialSpec{}};
  EXPECT_NEAR(e.bulk_modulus / 9.19608e9, 1, 2e-6);
  EXPECT_NEAR(e.shear_modulus / 3.52632e9, 1, 2e-6);
  EXPECT_NEAR(e.bulk_sound_speed(), 3196.5, 0.05);
  EXPECT_NEAR(e.p_wave_speed(), 3929.6, 0.05);
  EXPECT_NEAR(e.impedance() / 3.537e6, 1, 2e-4);
}

}  // namespace
}  // namespace nilas::sph
