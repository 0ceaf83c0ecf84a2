#include "sph/absorbing_rim.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "sph/ice.hpp"
#include "sph/state_sums.hpp"

namespace nilas::sph {
namespace {

constexpr double kRadius = 0.8, kThickness = 0.2, kSpacing = 0.05;

IceSpec sheet(bool absorbing) {
  IceSpec spec;
  PieceSpec disc;
  disc.diameter = 2 * kRadius;
  disc.thickness = kThickness;
  disc.centre = Vec3(0.3, -0.2, 0.1);
  disc.absorbing_rim = absorbing;
  disc.fixed.rim = !absorbing;
  spec.pieces = {disc};
  spec.spacing = kSpacing;
  spec.material.model = Model::elastic;
  spec.numerics.gradient_correction = true;
  return spec;
}

Vec3 outward(const Vec3& position, const PieceSpec& disc) {
  Vec3 n = position - disc.centre;
  n.z() = 0;
  return n.normalized();
}

TEST(AbsorbingRim, BooksWhatItTakes) {
  const IceSpec spec = sheet(true);
  Particles particles = lattice(spec, {.velocity = [](const Vec3& x) { return Vec3(3 * x[1], 5 + x[2], -2 * x[0]); }});
  AbsorbingRim rim(spec, ElasticConstants(spec.material), particles, 0.13);
  const StateSums before = state_sums(particles);
  for (int n = 0; n < 3; ++n) rim.apply(particles, 1e-5);
  const StateSums after = state_sums(particles);
  EXPECT_GT(rim.account().energy, 0.1 * before.kinetic);
  EXPECT_NEAR(before.kinetic - after.kinetic, rim.account().energy, 1e-12 * before.kinetic);
  EXPECT_LT((after.momentum - before.momentum - rim.account().impulse).norm(), 1e-12 * before.momentum_scale);
  EXPECT_LT((after.angular_momentum - before.angular_momentum - rim.account().angular_impulse).norm(),
            1e-12 * before.momentum_scale);
}

// v' = -(c/d) v with the speed of plate waves along the normal and of shear waves across it; nothing further inside.
TEST(AbsorbingRim, DampsItsLayerAtTheRatesOfTheWavesThatLeave) {
  const IceSpec spec = sheet(true);
  const PieceSpec& disc = spec.pieces[0];
  const double depth = 0.13, dt = 2e-5;
  Particles particles = lattice(spec, {.velocity = [](const Vec3&) { return Vec3(1, 2, 3); }});
  AbsorbingRim rim(spec, ElasticConstants(spec.material), particles, depth);
  rim.apply(particles, dt);
  const MaterialSpec& m = spec.material;
  const double plate = std::sqrt(m.young_modulus / (m.density * (1 - m.poisson_ratio * m.poisson_ratio)));
  const double shear = std::sqrt(m.young_modulus / (2 * (1 + m.poisson_ratio) * m.density));
  for (const Motion& motion : particles.motion) {
    const double radius = (motion.position - disc.centre).head<2>().norm();
    const Vec3 n = outward(motion.position, disc), v(1, 2, 3), v_n = v.dot(n) * n;
    const Vec3 expected = radius > kRadius - depth
                              ? Vec3(std::exp(-plate * dt / depth) * v_n + std::exp(-shear * dt / depth) * (v - v_n))
                              : v;
    EXPECT_LT((motion.velocity - expected).norm(), 1e-12);
  }
}

TEST(AbsorbingRim, KeepsToItsParticlesWhenTheyAreSortedAnew) {
  const IceSpec spec = sheet(true);
  Particles particles = lattice(spec, {.velocity = [](const Vec3&) { return Vec3(1, 2, 3); }});
  AbsorbingRim rim(spec, ElasticConstants(spec.material), particles, 0.13);
  std::vector<std::uint32_t> backwards(particles.size());
  for (std::uint32_t i = 0; i < backwards.size(); ++i)
    backwards[i] = static_cast<std::uint32_t>(backwards.size()) - 1 - i;
  particles.permute(backwards);
  rim.follow(particles);
  rim.apply(particles, 1e-5);
  for (const Motion& motion : particles.motion)
    EXPECT_EQ(motion.velocity != Vec3(1, 2, 3),
              (motion.position - spec.pieces[0].centre).head<2>().norm() > kRadius - 0.13);
}

/// Largest energy so far of what differs from a sheet three times as wide, within the rim of the narrower one, over the
/// energy that went out through that rim: the echo, as the wide sheet has none yet. Twice the kinetic energy, whose
/// mean is half of a wave's.
double echo(bool absorbing, const VelocityField& push, double time) {
  const IceSpec narrow_spec = sheet(absorbing);
  IceSpec wide_spec = sheet(false);
  wide_spec.pieces[0].diameter *= 3;
  Ice narrow(narrow_spec, {}, {.velocity = push}), wide(wide_spec, {}, {.velocity = push});
  std::map<std::array<double, 3>, std::size_t> site;  // creation index in the wide sheet
  const Particles sites = lattice(wide_spec), own_sites = lattice(narrow_spec);
  const auto key = [](const Vec3& x) { return std::array{x[0], x[1], x[2]}; };
  for (std::size_t i = 0; i < sites.size(); ++i) site[key(sites.motion[i].position)] = i;

  std::vector<Surface> none;
  const double arriving = narrow.ledger().kinetic, dt = narrow.stable_step().dt;
  double largest = 0;
  for (double t = 0; t < time; t += dt) {
    narrow.step(none, dt);
    wide.step(none, dt);
    const auto in_narrow = narrow.creation_order(), in_wide = wide.creation_order();
    double difference = 0;
    for (std::size_t i = 0; i < own_sites.size(); ++i) {
      const Vec3& x = own_sites.motion[i].position;
      if ((x - narrow_spec.pieces[0].centre).head<2>().norm() > kRadius - 2 * narrow.smoothing_length()) continue;
      const Vec3& v = narrow.particles().motion[in_narrow[i]].velocity;
      difference += (v - wide.particles().motion[in_wide[site.at(key(x))]].velocity).squaredNorm();
    }
    largest = std::max(largest, narrow.particles().mass * difference);
  }
  return largest / (absorbing ? narrow.absorbed() : arriving);
}

/// A push within `radius` of the middle, of such a shape that no wave shorter than that is made.
VelocityField push(double radius, bool along) {
  const PieceSpec disc = sheet(true).pieces[0];
  return [=](const Vec3& x) {
    const double r = (x - disc.centre).head<2>().norm();
    if (r > radius) return Vec3(Vec3::Zero());
    return along ? Vec3(std::pow(std::sin(M_PI * r / radius), 2) * outward(x, disc))
                 : Vec3(0, 0, 1 + std::cos(M_PI * r / radius));
  };
}

// The bound that a run states on the effect of its cut takes for granted that less than half of the amplitude returns.
TEST(AbsorbingRim, ReturnsLessThanHalfOfTheAmplitudeOfWavesAlongTheSheetAndAFixedOneMore) {
  const double time = 2 * kRadius / ElasticConstants(sheet(true).material).plate_wave_speed();
  EXPECT_LT(echo(true, push(0.4, true), time), 0.25);
  EXPECT_GT(echo(false, push(0.4, true), time), 0.25);
}

TEST(AbsorbingRim, ReturnsLessThanHalfOfTheAmplitudeOfAPushAcrossTheSheet) {
  const double time = 2 * kRadius / ElasticConstants(sheet(true).material).plate_wave_speed();
  EXPECT_LT(echo(true, push(0.4, false), time), 0.25);
}

TEST(AbsorbingRim, IsRefusedForOtherIceThanOneDisc) {
  IceSpec ball = sheet(true);
  ball.pieces[0].shape = IceShape::sphere;
  EXPECT_THROW(Ice{ball}, std::invalid_argument);
  IceSpec two = sheet(true);
  two.pieces.push_back(sheet(false).pieces[0]);
  two.pieces[1].centre.z() += 2;
  EXPECT_THROW(Ice{two}, std::invalid_argument);
}

TEST(AbsorbingRim, CostsNothingWhereThereIsNone) {
  const auto left_out = Ice(sheet(false)).terms_left_out();
  EXPECT_NE(std::find(left_out.begin(), left_out.end(), "absorbing rim"), left_out.end());
  EXPECT_EQ(Ice(sheet(false)).absorbed(), 0);
}

}  // namespace
}  // namespace nilas::sph
