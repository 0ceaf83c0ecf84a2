#include <gtest/gtest.h>

#include "sph/ice.hpp"
#include "sph/pair_passes_kernel.hpp"
#include "sph/pair_records.hpp"
#include "tests/support/pair_sums.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

using test::jittered_block;
using test::PairSums;

constexpr double u = 0x1p-24;     // rounding of a float
constexpr double c_b = 3196.5;    // m/s
constexpr double v_largest = 35;  // m/s, of the clouds: 20 along each axis

constexpr PairTerms single(bool corrected, bool viscous, bool periodic) { return {corrected, viscous, periodic, true}; }
const PairTerms all_terms[] = {single(false, false, false), single(false, false, true), single(false, true, false),
                               single(false, true, true),   single(true, false, false), single(true, false, true),
                               single(true, true, false),   single(true, true, true)};

/// A jittered cloud with random velocities, stresses and volumes, seven by six by eight spacings; the periodic form
/// wraps y and z.
struct Cloud {
  double h;
  Particles particles;
  Period period;
  Neighbours neighbours;
  PairConstants constants;

  explicit Cloud(const PairTerms& t, double dx = 0.02)
      : h(1.3 * dx),
        particles(test::particles_at(jittered_block({7, 6, 8}, dx, 0.2), dx)),
        period(t.periodic ? Period(0, 6 * dx, 8 * dx) : Period::Zero()),
        neighbours(2.1 * h, dx, period, Vec3::Zero(), Vec3::Constant(8 * dx), 1000, Precision::single),
        constants{h,           WendlandC2(h).gradient_scale(), c_b, t.viscous ? 0.3 : 0, t.viscous ? 0.6 : 0, period,
                  dx * dx * dx} {
    neighbours.rebuild(particles);
    test::disturb(particles, 20, 1e6);
  }
  void run(const PairPasses& passes) {
    passes.velocity_gradient(particles, neighbours, constants);
    for (Vec3& a : particles.acceleration) a.setZero();
    passes.acceleration(particles, neighbours, constants, 1e-6);
  }
};

/// What rounding may change, from the number format alone: each position by u times the distance to the mean position,
/// each velocity by u times the speed, each term by some 30 operations, each sum by 16 additions of packs. Frobenius
/// norms throughout.
class RoundingBound {
 public:
  RoundingBound(const Cloud& cloud, bool corrected) : c_(cloud), oracle_(c_.particles, c_.h, c_.period) {
    Vec3 mean = Vec3::Zero();
    for (const Motion& m : c_.particles.motion) mean += m.position / static_cast<double>(c_.particles.size());
    for (const Motion& m : c_.particles.motion) radius_ = std::max(radius_, (m.position - mean).norm());
    for (std::size_t i = 0; i < c_.particles.size(); ++i) {
      const Mat3 B = corrected ? Mat3(oracle_.moment(i).inverse()) : Mat3(Mat3::Identity());
      B_.push_back(B.norm());
      double moment = 0;
      if (corrected) for_pairs(i, [&](std::size_t, double r, double g, double dg) { moment += dg * r + g * shift(r); });
      dB_.push_back(B.squaredNorm() * moment);
    }
  }
  double velocity_gradient(std::size_t i) const {
    double error = 0;
    for_pairs(i, [&](std::size_t j, double, double g, double dg) {
      const double du = (c_.particles.motion[j].velocity - c_.particles.motion[i].velocity).norm();
      error += dg * du + g * 2 * u * v_largest;
    });
    return error * B_[i] + oracle_.velocity_gradient(i, false).norm() * dB_[i];
  }
  double acceleration(std::size_t i) const {
    const auto stress = [&](std::size_t k) { return to_matrix(c_.particles.stress[k]).norm(); };
    double error = 0;
    for_pairs(i, [&](std::size_t j, double r, double g, double dg) {
      const Motion &mi = c_.particles.motion[i], &mj = c_.particles.motion[j];
      const double per_mass = mi.volume / c_.particles.mass;
      error +=
          per_mass * (dg * (stress(i) * B_[i] + stress(j) * B_[j]) + g * (stress(i) * dB_[i] + stress(j) * dB_[j]));
      // Viscosity: 2 V_i/(V_i + V_j) (alpha c mu + beta mu^2) V_j grad W. mu changes by no more than its largest value
      // over the shortest length in it.
      const double distance2 = r * r + 0.01 * c_.h * c_.h;
      const double mu = c_.h * r * (mi.velocity - mj.velocity).norm() / distance2;
      const double dmu = mu * (30 * u + 3 * shift(r) / std::sqrt(distance2)) + c_.h * r * 2 * u * v_largest / distance2;
      const double share = 2 * mi.volume / (mi.volume + mj.volume);
      const double alpha_c = c_.constants.alpha * c_b, beta = c_.constants.beta;
      error += share * ((alpha_c * mu + beta * mu * mu) * dg + (alpha_c + 2 * beta * mu) * dmu * g);
    });
    return error;
  }

 private:
  /// Error of a separation: of two positions, and of what is done with it.
  double shift(double r) const { return 2 * std::sqrt(3) * u * radius_ + 8 * u * r; }
  /// body(j, r, g, dg): g = |V_j grad W|, dg its error. d(t^3 x)/dx is at most t^2 (1 + q).
  template <class Body>
  void for_pairs(std::size_t i, const Body& body) const {
    for (std::size_t j = 0; j < c_.particles.size(); ++j) {
      const Motion &mi = c_.particles.motion[i], &mj = c_.particles.motion[j];
      const double r = test::shortest_of_all_images(mi.position - mj.position, c_.period).norm();
      // A pair just beyond the support may round to just inside.
      const double q = r / c_.h, t = std::max(0.0, 1 - q / 2) + u * radius_ / c_.h;
      if (i == j || q > 2 * (1 + u * radius_ / c_.h)) continue;
      const double scale = mj.volume * 105 / (16 * std::numbers::pi * std::pow(c_.h, 5));
      const double g = scale * t * t * t * r;
      body(j, r, g, 46 * u * g + scale * t * t * (1 + q) * shift(r));
    }
  }
  const Cloud& c_;
  PairSums oracle_;
  double radius_ = 0;
  std::vector<double> B_, dB_;
};

void expect_textbook_sums(const Cloud& cloud, const PairTerms& terms) {
  const PairSums oracle(cloud.particles, cloud.h, cloud.period);
  const PairSums::Viscosity viscosity{cloud.constants.alpha, cloud.constants.beta, c_b};
  const RoundingBound bound(cloud, terms.corrected);
  const std::vector<Mat3> B = terms.corrected ? oracle.corrections() : std::vector<Mat3>{};
  for (std::size_t i = 0; i < cloud.particles.size(); i += 7) {
    const Mat3 L = cloud.particles.velocity_gradient[i] - oracle.velocity_gradient(i, terms.corrected);
    const Vec3 a = cloud.particles.acceleration[i] - oracle.acceleration(i, B, viscosity);
    EXPECT_LT(L.norm(), bound.velocity_gradient(i)) << terms.corrected << terms.viscous << terms.periodic;
    EXPECT_LT(a.norm(), bound.acceleration(i)) << terms.corrected << terms.viscous << terms.periodic;
  }
}

TEST(SinglePrecision, EqualsTheTextbookSumsToTheRoundingOfFloatsAtEverySpacing) {
  for (const double dx : {1e-4, 0.02, 10.0})
    for (const PairTerms& terms : all_terms) {
      Cloud cloud(terms, dx);
      cloud.run(pair_passes(terms));
      expect_textbook_sums(cloud, terms);
    }
}

TEST(SinglePrecision, EqualsTheTextbookSumsInTheBaselineInstructionSetToo) {
  for (const PairTerms& terms : all_terms) {
    Cloud cloud(terms);
    cloud.run(baseline::select(terms));
    expect_textbook_sums(cloud, terms);
  }
}

TEST(SinglePrecision, LosesNothingFarFromTheOriginOrInAFastFrame) {
  for (const PairTerms& terms : all_terms) {
    Cloud near(terms), far(terms);
    for (Motion& m : far.particles.motion) {
      m.position += Vec3(1e6, -1e6, 1e6);
      m.velocity += Vec3(1e3, 1e3, -1e3);
    }
    near.run(pair_passes(terms));
    far.run(pair_passes(terms));
    const RoundingBound bound(near, terms.corrected);
    for (std::size_t i = 0; i < near.particles.size(); i += 5) {
      const Particles &a = near.particles, &b = far.particles;
      EXPECT_LT((a.velocity_gradient[i] - b.velocity_gradient[i]).norm(), 2 * bound.velocity_gradient(i));
      EXPECT_LT((a.acceleration[i] - b.acceleration[i]).norm(), 2 * bound.acceleration(i));
    }
  }
}

TEST(SinglePrecision, UniformTranslationGivesExactlyNoVelocityGradient) {
  for (const PairTerms& terms : all_terms) {
    Cloud cloud(terms);
    for (Motion& m : cloud.particles.motion) m.velocity = {1000, -200, 30};
    cloud.run(pair_passes(terms));
    for (const Mat3& L : cloud.particles.velocity_gradient) EXPECT_EQ(L, Mat3::Zero());
  }
}

// Pairs far from each other, so that a sum is the force of one pair.
TEST(SinglePrecision, ForcesOfAPairAreEqualAndOppositeToTheLastBit) {
  for (const PairTerms& terms : all_terms) {
    Cloud cloud(terms);
    test::Random random(3);
    std::vector<Vec3> positions;
    for (int k = 0; k < 200; ++k) {
      const Vec3 x = 0.13 * Vec3(k % 6, (k / 6) % 6, k / 36);
      positions.push_back(x);
      positions.push_back(x + 0.02 * random.vector());
    }
    cloud.particles = test::particles_at(positions, 0.02);
    test::disturb(cloud.particles, 20, 1e6);
    cloud.constants.period = terms.periodic ? Period(0.78, 0.78, 0) : Period::Zero();
    cloud.neighbours =
        Neighbours(2.1 * cloud.h, 0.02, cloud.constants.period, Vec3::Zero(), Vec3::Ones(), 1000, Precision::single);
    cloud.neighbours.rebuild(cloud.particles);
    cloud.run(pair_passes(terms));
    int pairs = 0;
    for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
      int near = 0;
      cloud.neighbours.for_each_near(i, [&](std::uint32_t j) {
        if (shortest_image(cloud.particles.motion[i].position - cloud.particles.motion[j].position,
                           cloud.constants.period)
                .norm() >= 2 * cloud.h)
          return;
        ++near;
        EXPECT_EQ(cloud.particles.acceleration[i], -cloud.particles.acceleration[j]);
        pairs += cloud.particles.acceleration[i].norm() > 0;
      });
      ASSERT_LE(near, 1);
    }
    EXPECT_GT(pairs, 300);
  }
}

// What is left is the rounding of the sums: at most 16 additions of packs per component.
TEST(SinglePrecision, ForcesSumToZeroToTheRoundingOfTheSums) {
  for (const PairTerms& terms : all_terms) {
    Cloud cloud(terms);
    cloud.run(pair_passes(terms));
    const PairSums oracle(cloud.particles, cloud.h, cloud.period);
    const std::vector<Mat3> B = oracle.corrections();
    const auto B_of = [&](std::size_t i) { return terms.corrected ? B[i] : Mat3(Mat3::Identity()); };
    Vec3 total = Vec3::Zero();
    double magnitudes = 0;
    for (std::size_t i = 0; i < cloud.particles.size(); ++i) {
      total += cloud.particles.mass * cloud.particles.acceleration[i];
      cloud.neighbours.for_each_near(i, [&](std::uint32_t j) {
        magnitudes += oracle.stress_force(i, j, B_of(i), B_of(j)).norm();
        magnitudes += oracle.viscous_force(i, j, {cloud.constants.alpha, cloud.constants.beta, c_b}).norm();
      });
    }
    EXPECT_LT(total.norm(), 16 * u * magnitudes);
  }
}

IceSpec small_block(Precision precision) {
  IceSpec spec;
  PieceSpec piece;
  piece.shape = IceShape::block;
  piece.size = 0.02 * Vec3(9, 8, 7);
  spec.pieces = {piece};
  spec.spacing = 0.02;
  spec.numerics.precision = precision;
  return spec;
}

TEST(SinglePrecision, RecordsOfThePairLoopsTakeHalfTheMemoryAndOnlyThoseOfThePrecisionInUseAreThere) {
  Ice in_double(small_block(Precision::double_)), in_single(small_block(Precision::single));
  std::vector<Surface> none;
  in_double.step(none, 1e-6), in_single.step(none, 1e-6);
  const Particles &d = in_double.particles(), &s = in_single.particles();
  EXPECT_EQ(d.single_pair_records.bytes(), 0u);
  EXPECT_EQ(s.pair_records.bytes(), 0u);
  // At least 13 numbers per particle; places at the ends of columns stay empty.
  EXPECT_GE(d.pair_records.bytes(), 13 * 8 * d.size());
  EXPECT_GE(s.single_pair_records.bytes(), 13 * 4 * s.size());
  EXPECT_LT(s.single_pair_records.bytes(), 0.7 * d.pair_records.bytes());
}

TEST(SinglePrecision, ARunIsBitIdenticalForOneAndTwoThreads) {
  const auto run = [](int threads) {
    const test::Threads scope(threads);
    IceSpec spec = small_block(Precision::single);
    spec.numerics.gradient_correction = true;
    InitialState initial;
    initial.velocity = [](const Vec3& x) { return Vec3(30 * std::sin(40 * x[1]), 10 * std::cos(30 * x[2]), 5); };
    Ice ice(spec, {}, initial);
    std::vector<Surface> none;
    for (int n = 0; n < 60; ++n) ice.step(none, ice.stable_step().dt);
    std::vector<Vec3> state;
    for (const Motion& m : ice.particles().motion) state.insert(state.end(), {m.position, m.velocity});
    return state;
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace nilas::sph
