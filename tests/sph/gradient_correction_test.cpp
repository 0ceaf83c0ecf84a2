// The kernel-gradient correction over time: it turns with the ice, exerts no moment, and leaves yielded ice alone.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sph/kernel.hpp"
#include "sph/pair_passes.hpp"
#include "sph/stress_update.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

constexpr double dx = 0.02, h = 1.3 * dx;

/// A jittered block about its own centre, turned by `rotation`, sorted, with velocity gradients and corrections.
struct Block {
  Particles particles;
  Neighbours neighbours{2.1 * h, dx, Period::Zero(), Vec3::Constant(-0.2), Vec3::Constant(0.2), 400};
  PairConstants constants{h, WendlandC2(h).gradient_scale(), 3000, 0, 0, Period::Zero(), dx* dx* dx};
  std::size_t fallbacks = 0;

  explicit Block(const Mat3& rotation = Mat3::Identity()) {
    std::vector<Vec3> positions = test::jittered_block({7, 6, 8}, dx, 0.2);
    for (Vec3& x : positions) x = rotation * (x - dx * Vec3(3.5, 3, 4));
    particles = test::particles_at(positions, dx);
    neighbours.rebuild(particles);
  }
  void differentiate(const Mat3& gradient, bool corrected = true) {
    for (Motion& m : particles.motion) m.velocity = gradient * m.position;
    fallbacks = pair_passes({corrected, false, false}).velocity_gradient(particles, neighbours, constants);
  }
  /// Corrections in order of creation.
  std::vector<Mat3> corrections() const {
    std::vector<Mat3> result(particles.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[particles.id[i]] = to_matrix(particles.correction[i]);
    return result;
  }
};

Mat3 spin(const Vec3& w) {
  Mat3 m;
  m << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
  return m;
}

// The update turns by Cayley's transform, that is by 2 atan(w dt / 2).
TEST(GradientCorrection, TurnedByTheSpinIsThatOfTheTurnedIce) {
  const Vec3 w(30, -50, 20);
  const double dt = 4e-3;
  Block block;
  block.differentiate(spin(w));
  turn_correction(block.particles, dt);
  Block turned(Eigen::AngleAxisd(2 * std::atan(0.5 * w.norm() * dt), w.normalized()).toRotationMatrix());
  turned.differentiate(Mat3::Zero());
  const auto a = block.corrections(), b = turned.corrections();
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LT((a[k] - b[k]).norm(), 1e-10) << k;
}

// SUM r x f is the antisymmetric part of SUM V sigma B M with the moment matrix M, and B M = I.
TEST(GradientCorrection, LeavesForcesWithoutAMomentWhateverTheStress) {
  for (const bool corrected : {true, false}) {
    Block block;
    block.differentiate(Mat3::Zero(), corrected);
    test::Random random(3);
    for (Sym3& s : block.particles.stress) s = 1e6 * random.tensor();
    for (Vec3& a : block.particles.acceleration) a.setZero();
    pair_passes({corrected, false, false}).acceleration(block.particles, block.neighbours, block.constants, 0);
    Vec3 moment = Vec3::Zero();
    double scale = 0;
    for (std::size_t i = 0; i < block.particles.size(); ++i) {
      const Vec3 m = block.particles.mass * block.particles.motion[i].position.cross(block.particles.acceleration[i]);
      moment += m, scale += m.norm();
    }
    if (corrected)
      EXPECT_LT(moment.norm(), 1e-12 * scale);
    else
      EXPECT_GT(moment.norm(), 1e-6 * scale);  // what there is to gain
  }
}

TEST(GradientCorrection, LeavesYieldedIceAlone) {
  const Mat3 gradient = spin({1, 2, 3}) + Mat3::Identity();
  Block plain, corrected;
  plain.differentiate(gradient, false);
  corrected.particles.failed.assign(corrected.particles.size(), 0);
  for (std::size_t i = 0; i < corrected.particles.size(); i += 3) corrected.particles.failed[i] = 1;
  corrected.differentiate(gradient);
  EXPECT_EQ(corrected.fallbacks, 0u);
  for (std::size_t i = 0; i < corrected.particles.size(); ++i) {
    const Mat3& L = corrected.particles.velocity_gradient[i];
    if (corrected.particles.failed[i])
      EXPECT_LT((L - plain.particles.velocity_gradient[i]).norm(), 1e-12);
    else
      EXPECT_LT((L - gradient).norm(), 1e-10);
  }
}

}  // namespace
}  // namespace nilas::sph
