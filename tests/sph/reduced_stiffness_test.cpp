#include "sph/reduced_stiffness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "sph/ice.hpp"
#include "tests/support/material_point.hpp"

namespace nilas::sph {
namespace {

using test::MaterialPoint;

constexpr double dx = 0.02;
const double scales[] = {0.7, 0.5, 0.25};

IceSpec softened(double scale, IceSpec spec = {}) {
  spec.numerics.sound_speed_scale = scale;
  return spec;
}

/// A bar along x with periodic sides: its strain is uniaxial.
IceSpec bar(double scale, int cells) {
  IceSpec spec;
  PieceSpec piece;
  piece.shape = IceShape::block;
  piece.size = dx * Vec3(cells, 6, 6);
  spec.pieces = {piece};
  spec.spacing = dx;
  spec.periodic = {true, true, true};
  spec.material.model = Model::elastic;
  spec.numerics.viscosity_alpha = 0;
  return softened(scale, spec);
}

/// Frequency of the longest standing wave of a bar without ends: from the second to the fourth zero of its amplitude.
double frequency(double scale) {
  const int cells = 40;
  const double wave_number = 2 * std::numbers::pi / (cells * dx);
  Ice ice(bar(scale, cells), {},
          {.velocity = [&](const Vec3& x) { return Vec3(1e-3 * std::cos(wave_number * x[0]), 0, 0); }});
  std::vector<Surface> none;
  double time = 0, before = 1, zeros[4] = {};
  for (int found = 0; found < 4;) {
    const double dt = ice.stable_step().dt;
    ice.step(none, dt);
    time += dt;
    double amplitude = 0;
    for (const Motion& m : ice.particles().motion) amplitude += m.velocity[0] * std::cos(wave_number * m.position[0]);
    if (amplitude * before < 0) zeros[found++] = time - dt * amplitude / (amplitude - before);
    before = amplitude;
  }
  return 1 / (zeros[3] - zeros[1]);
}

TEST(ReducedStiffness, IsRefusedOutsideZeroToOne) {
  for (const double scale : {0.0, -0.5, 1.0000001, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(with_reduced_stiffness(softened(scale)), std::invalid_argument) << scale;
    EXPECT_THROW(Ice(bar(scale, 10)), std::invalid_argument) << scale;
  }
}

TEST(ReducedStiffness, OfOneIsTheIceItselfToTheLastBit) {
  for (const double modulus : {9.38e9, 0.1, 1.0 / 3}) {
    IceSpec spec;
    spec.material.young_modulus = modulus;
    spec.numerics.viscosity_alpha = 0.1;
    const IceSpec same = with_reduced_stiffness(spec);
    EXPECT_EQ(same.material, spec.material);
    EXPECT_EQ(same.numerics.viscosity_alpha, spec.numerics.viscosity_alpha);
  }
}

TEST(ReducedStiffness, ActsOnce) {
  const IceSpec once = with_reduced_stiffness(softened(0.5));
  EXPECT_EQ(with_reduced_stiffness(once).material, once.material);
}

TEST(ReducedStiffness, ScalesEverySoundSpeed) {
  const ElasticConstants stated{MaterialSpec{}};
  for (const double s : scales) {
    const Ice ice(bar(s, 10));
    const ElasticConstants& e = ice.elastic_constants();
    EXPECT_NEAR(e.bulk_sound_speed() / stated.bulk_sound_speed(), s, 1e-12);
    EXPECT_NEAR(e.p_wave_speed() / stated.p_wave_speed(), s, 1e-12);
    EXPECT_NEAR(std::sqrt(e.shear_modulus / stated.shear_modulus), s, 1e-12);
    EXPECT_EQ(e.density, stated.density);
  }
}

TEST(ReducedStiffness, LengthensTheStepByItsInverse) {
  const double stated = Ice(bar(1, 10)).stable_step().dt;
  for (const double s : scales) {
    const StepLimit limit = Ice(bar(s, 10)).stable_step();
    EXPECT_EQ(limit.limiter, Limiter::sound_speed);
    EXPECT_NEAR(limit.dt * s / stated, 1, 1e-12);
  }
}

TEST(ReducedStiffness, LeavesTheStepThatViscosityAllows) {
  const auto viscous = [](double scale) {
    IceSpec spec = bar(scale, 10);
    spec.numerics.viscosity_alpha = 10;
    return Ice(spec).stable_step();
  };
  for (const double s : scales) {
    EXPECT_EQ(viscous(s).limiter, Limiter::viscosity);
    EXPECT_NEAR(viscous(s).dt / viscous(1).dt, 1, 1e-12);
  }
}

TEST(ReducedStiffness, SlowsTheWavesOfABarInProportion) {
  const double stated = frequency(1);
  for (const double s : {0.5, 0.25}) EXPECT_NEAR(frequency(s) / stated, s, 1e-4 * s);
}

/// Axial stress of perfectly plastic ice, pushed or pulled to four times its own strain at yield or more.
double uniaxial_strength(double scale, double sign) {
  IceSpec spec = softened(scale);
  spec.material.after_failure = AfterFailure::plastic;
  MaterialPoint point{DruckerPrager(with_reduced_stiffness(spec).material)};
  const double increment = 1e-6 / (scale * scale);
  for (int n = 0; n < 500; ++n) point.axial(sign * increment, 0);
  return point.stress().xx;
}

// V8.
TEST(ReducedStiffness, LeavesTheUniaxialStrengths) {
  for (const double s : scales) {
    EXPECT_NEAR(uniaxial_strength(s, -1) / -1.13406e6, 1, 1e-3) << s;
    EXPECT_NEAR(uniaxial_strength(s, +1) / 0.582447e6, 1, 1e-3) << s;
  }
}

RateDependentIce rate_dependent(double scale, double spacing) {
  return {with_reduced_stiffness(softened(scale)).material, spacing};
}

TEST(ReducedStiffness, LeavesTheTensileStrengthAndTheFractureEnergyOfACrack) {
  const double spacing = 0.002, opening = 4e-6;  // m, 2 G_f/sigma_t
  for (const double s : scales) {
    const double increment = opening / spacing / 2000;
    MaterialPoint<RateDependentIce> point(rate_dependent(s, spacing), increment);
    double peak = 0, work = 0, before = 0;
    while (!point.state().failed) {
      point.axial(increment, 0);
      work += 0.5 * (before + point.stress().xx) * increment * spacing;
      before = point.stress().xx;
      peak = std::max(peak, before);
    }
    EXPECT_NEAR(peak / 0.5e6, 1, 0.02) << s;  // a step is up to 0.02 of the strain at peak
    EXPECT_NEAR(work, 1, 2e-3) << s;          // J/m2, G_f
  }
}

TEST(ReducedStiffness, LeavesTheStrainOfFailureOfCrushedIce) {
  for (const double s : scales)
    for (const double rate : {10.0, 1e3})
      EXPECT_NEAR(rate_dependent(s, dx).failure_strain(rate) / rate_dependent(1, dx).failure_strain(rate), 1, 1e-12);
}

TEST(ReducedStiffness, LeavesTheKelvinVoigtViscosity) {
  IceSpec spec;
  spec.material.model = Model::neo_hookean;
  spec.material.kelvin_voigt = 0.3;
  const double stated = kelvin_voigt_viscosity(spec.material, 0.026);
  for (const double s : scales)
    EXPECT_NEAR(kelvin_voigt_viscosity(with_reduced_stiffness(softened(s, spec)).material, 0.026) / stated, 1, 1e-12);
}

}  // namespace
}  // namespace nilas::sph
