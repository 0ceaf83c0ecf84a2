#include "sph/time_step.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <set>
#include <string>

namespace nilas::sph {
namespace {

constexpr double dx = 0.02, h = 0.026, mass = 900 * dx * dx * dx;

/// What the step depends on. Nothing but the sound speed limits it unless a test says so.
struct Case {
  NumericsSpec numerics;
  ContactSpec contact;
  double speed = 0, acceleration = 0, kelvin_voigt_viscosity = 0;
  bool has_contact = false;

  Case() { numerics.viscosity_alpha = 0; }
  ElasticConstants elastic{MaterialSpec{}};
  ContactConstants contact_constants() const { return {contact, elastic, dx}; }
  StepLimit limit() const {
    return stable_step(numerics, elastic, contact_constants(), mass, h, speed, acceleration, has_contact,
                       kelvin_voigt_viscosity);
  }
};

TEST(StableStep, SoundSpeedLimitsByDefault) {
  Case c;
  EXPECT_EQ(c.limit().limiter, Limiter::sound_speed);
  EXPECT_NEAR(c.limit().dt, 0.6 * h / 3196.5, 1e-10);
  c.speed = 200;
  EXPECT_NEAR(c.limit().dt, 0.6 * h / 3396.5, 1e-10);
}

TEST(StableStep, SoundSpeedIsThatOfThePWaveWhereTheSpecAsks) {
  Case c;
  c.numerics.cfl_sound_speed = SoundSpeed::p_wave;
  EXPECT_EQ(c.limit().limiter, Limiter::sound_speed);
  EXPECT_NEAR(c.limit().dt, 0.6 * h / 3929.6, 1e-10);
}

TEST(StableStep, AccelerationLimitsWhenItIsLarge) {
  Case c;
  c.acceleration = 1e10;
  EXPECT_EQ(c.limit().limiter, Limiter::acceleration);
  EXPECT_NEAR(c.limit().dt, 0.6 * std::sqrt(h / 1e10), 1e-15);
}

TEST(StableStep, ViscosityLimitsWhenItIsLarge) {
  Case c;
  c.numerics.viscosity_alpha = 10;
  EXPECT_EQ(c.limit().limiter, Limiter::viscosity);
  EXPECT_NEAR(c.limit().dt / (0.4 * 0.6 * h * h / (3 * 10 * h * 3196.5 / 10)), 1, 2e-5);  // 3196.5: five digits
}

TEST(StableStep, KelvinVoigtDampingLimitsWhenItIsLarge) {
  Case c;
  c.kelvin_voigt_viscosity = 900 * 10;  // kinematic: 10 m2/s
  EXPECT_EQ(c.limit().limiter, Limiter::sound_speed);
  c.kelvin_voigt_viscosity = 900 * 100;
  EXPECT_EQ(c.limit().limiter, Limiter::kelvin_voigt);
  EXPECT_NEAR(c.limit().dt / (0.4 * 0.6 * h * h / 100), 1, 1e-12);
}

TEST(StableStep, ContactLimitsWhenItIsStiffAndOnlyWhereThereIsContact) {
  Case c;
  c.contact.stiffness = 100;
  EXPECT_EQ(c.limit().limiter, Limiter::sound_speed);
  c.has_contact = true;
  EXPECT_EQ(c.limit().limiter, Limiter::contact);
  c.contact.stiffness = 0.2;
  c.contact.damping = 100;
  EXPECT_EQ(c.limit().limiter, Limiter::contact);
}

TEST(StableStep, MaxStepLimitsWhenItIsSmall) {
  Case c;
  c.numerics.max_step = 1e-7;
  EXPECT_EQ(c.limit().limiter, Limiter::max_step);
  EXPECT_EQ(c.limit().dt, 1e-7);
  c.numerics.max_step = 1;
  EXPECT_EQ(c.limit().limiter, Limiter::sound_speed);
}

TEST(StableStep, EveryLimiterHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const Limiter l : {Limiter::sound_speed, Limiter::acceleration, Limiter::viscosity, Limiter::kelvin_voigt,
                          Limiter::contact, Limiter::max_step, Limiter::body_rotation})
    names.insert(name(l));
  EXPECT_EQ(names.size(), 7u);
  EXPECT_EQ(names.count(""), 0u);
}

TEST(StableStep, EveryLimitScalesWithTheCflNumber) {
  Case c;
  c.numerics.max_step = 0;
  c.has_contact = true;
  for (const double alpha : {0.0, 10.0})
    for (const double acceleration : {0.0, 1e10})
      for (const double stiffness : {0.2, 100.0}) {
        c.numerics.viscosity_alpha = alpha, c.acceleration = acceleration, c.contact.stiffness = stiffness;
        c.numerics.cfl = 0.6;
        const double dt = c.limit().dt;
        c.numerics.cfl = 0.3;
        EXPECT_NEAR(c.limit().dt / dt, 0.5, 1e-12);
      }
}

/// Spectral radius of one drift-kick-drift step of m x'' = -k x - c x', force from the velocity before the kick.
double growth(double dt, double k, double c) {
  Eigen::Matrix2d drift, kick;
  drift << 1, dt / 2, 0, 1;
  kick << 1, 0, -dt * k / mass, 1 - dt * c / mass;
  return (drift * kick * drift).eigenvalues().cwiseAbs().maxCoeff();
}

TEST(StableStep, ContactLimitIsWhereOneParticleOnItsSpringAndDashpotTurnsUnstable) {
  for (const double stiffness : {0.2, 1.0, 20.0})
    for (const double damping : {0.0, 0.4, 3.0, 30.0}) {
      Case c;
      c.contact.stiffness = 1e3 * stiffness;  // so that contact is the limiter
      c.contact.damping = damping * std::sqrt(1e3);
      c.numerics.cfl = 1;
      c.has_contact = true;
      const ContactConstants k = c.contact_constants();
      ASSERT_EQ(c.limit().limiter, Limiter::contact);
      EXPECT_LE(growth(0.999 * c.limit().dt, k.stiffness, k.normal_damping), 1 + 1e-12);
      EXPECT_GT(growth(1.001 * c.limit().dt, k.stiffness, k.normal_damping), 1 + 1e-6);
    }
}

}  // namespace
}  // namespace nilas::sph
