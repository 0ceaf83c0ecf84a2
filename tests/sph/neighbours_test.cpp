#include "sph/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/pair_sums.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

using test::particles_at;
using test::Random;

std::vector<Vec3> random_cloud(std::size_t n, const Vec3& lower, const Vec3& upper, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> x(n);
  for (Vec3& v : x) v = 0.5 * (lower + upper) + 0.5 * (upper - lower).cwiseProduct(random.vector());
  return x;
}

std::vector<std::vector<std::uint32_t>> all_pairs(const Particles& p, double reach, const Period& period) {
  std::vector<std::vector<std::uint32_t>> lists(p.size());
  for (std::uint32_t i = 0; i < p.size(); ++i)
    for (std::uint32_t j = 0; j < p.size(); ++j) {
      const Vec3 d = p.motion[i].position - p.motion[j].position;
      if (j != i && test::shortest_of_all_images(d, period).norm() < reach) lists[i].push_back(j);
    }
  return lists;
}

void expect_equals_brute_force(Neighbours& neighbours, Particles& p, double reach, const Period& period) {
  neighbours.rebuild(p);
  const auto expected = all_pairs(p, reach, period);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto list = neighbours.of(i);
    std::vector<std::uint32_t> sorted(list.begin(), list.end());
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted, expected[i]) << "particle " << i;
    pairs += list.size();
  }
  EXPECT_GT(pairs, 0u);
}

TEST(Neighbours, ListEqualsBruteForceForARandomCloud) {
  const Vec3 lower(-1, 2, 5), upper(0, 4, 5.5);
  for (const double reach : {0.05, 0.13, 0.4, 3.0}) {
    Particles p = particles_at(random_cloud(1500, lower, upper, 1), 0.05);
    Neighbours neighbours(reach, Period::Zero(), lower, upper, 1000);
    expect_equals_brute_force(neighbours, p, reach, Period::Zero());
  }
}

// One, two, three and more cells along the axes that wrap; the shortest axis is just longer than two reaches.
TEST(Neighbours, ListEqualsBruteForceInAPeriodicDomain) {
  const double reach = 0.1;
  for (const Period& period : {Period(0.21, 0.35, 1), Period(0.9, 0, 0), Period(0, 0.21, 0.21), Period(0.31, 0.5, 0)}) {
    const Vec3 upper = period.cwiseMax(0.4);
    // Particles are not wrapped back: some are periods away from the box.
    std::vector<Vec3> x = random_cloud(1200, Vec3::Zero(), upper, 4);
    Random random(5);
    for (Vec3& v : x) v += period.cwiseProduct((1 * random.vector()).array().round().matrix());
    Particles p = particles_at(x, 0.04);
    Neighbours neighbours(reach, period, Vec3::Zero(), upper, 1000);
    expect_equals_brute_force(neighbours, p, reach, period);
  }
}

TEST(Neighbours, StraysFarOutsideTheBoundsAreFound) {
  const Vec3 lower = Vec3::Zero(), upper = Vec3::Ones();
  std::vector<Vec3> x = random_cloud(600, lower, upper, 6);
  for (const Vec3& where : {Vec3(1e6, -3e5, 0.5), Vec3(-40, 0.5, 0.5), Vec3(0.5, 1.05, 2e9)})
    for (int n = 0; n < 20; ++n) x.push_back(where + 0.2 * Random(100 + n).vector());
  for (const Vec3& v : random_cloud(200, Vec3::Constant(-0.5), Vec3::Constant(1.5), 7)) x.push_back(v);
  Particles p = particles_at(x, 0.05);
  Neighbours neighbours(0.15, Period::Zero(), lower, upper, 1000);
  expect_equals_brute_force(neighbours, p, 0.15, Period::Zero());
}

TEST(Neighbours, StraysDoNotMakeTheGridGrow) {
  std::vector<Vec3> x = random_cloud(600, Vec3::Zero(), Vec3::Ones(), 6);
  const auto bytes = [&] {
    Particles p = particles_at(x, 0.05);
    Neighbours neighbours(0.1, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
    neighbours.rebuild(p);
    return neighbours.bytes();
  };
  const std::size_t before = bytes();
  x.emplace_back(1e12, 1e12, -1e12);
  EXPECT_LT(bytes(), before + 1000);
}

TEST(Neighbours, CoincidentParticlesListEachOtherAndNotThemselves) {
  std::vector<Vec3> x = random_cloud(300, Vec3::Zero(), Vec3::Ones(), 8);
  const std::vector<Vec3> again = x;
  for (int copies = 0; copies < 2; ++copies) x.insert(x.end(), again.begin(), again.end());
  Particles p = particles_at(x, 0.1);
  Neighbours neighbours(0.2, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
  expect_equals_brute_force(neighbours, p, 0.2, Period::Zero());
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_GE(neighbours.of(i).size(), 2u);
}

TEST(Neighbours, LoneParticleHasNone) {
  Particles p = particles_at({{0.3, 0.2, 0.1}}, 0.1);
  Neighbours neighbours(0.2, Period::Zero(), p.motion[0].position, p.motion[0].position, 1000);
  neighbours.rebuild(p);
  EXPECT_TRUE(neighbours.of(0).empty());
}

TEST(Neighbours, FlatCloudWithoutExtentIsListed) {
  std::vector<Vec3> x = random_cloud(200, Vec3(0, 0, 1), Vec3(1, 1, 1), 9);
  Particles p = particles_at(x, 0.1);
  Neighbours neighbours(0.2, Period::Zero(), Vec3(0, 0, 1), Vec3(1, 1, 1), 1000);
  expect_equals_brute_force(neighbours, p, 0.2, Period::Zero());
}

TEST(Neighbours, RebuildAfterMotionEqualsBruteForceAgain) {
  Particles p = particles_at(random_cloud(800, Vec3::Zero(), Vec3::Ones(), 10), 0.1);
  Neighbours neighbours(0.15, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
  Random random(11);
  for (int n = 0; n < 5; ++n) {
    for (Motion& m : p.motion) m.position += 0.3 * random.vector();
    expect_equals_brute_force(neighbours, p, 0.15, Period::Zero());
  }
}

TEST(Neighbours, OrderAndListsAreTheSameForOneAndTwoThreads) {
  const std::vector<Vec3> x = random_cloud(6000, Vec3::Zero(), Vec3::Ones(), 12);
  const auto build = [&](int threads) {
    const test::Threads scope(threads);
    Particles p = particles_at(x, 0.05);
    Neighbours neighbours(0.12, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
    neighbours.rebuild(p);
    std::vector<std::vector<std::uint32_t>> lists;
    for (std::size_t i = 0; i < p.size(); ++i) lists.emplace_back(neighbours.of(i).begin(), neighbours.of(i).end());
    return std::pair{p.id, lists};
  };
  EXPECT_EQ(build(1), build(2));
}

TEST(Neighbours, PositionsAtRebuildAreThoseOfTheSortedParticles) {
  Particles p = particles_at(random_cloud(500, Vec3::Zero(), Vec3::Ones(), 13), 0.05);
  Neighbours neighbours(0.12, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
  neighbours.rebuild(p);
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(neighbours.position_at_rebuild(i), p.motion[i].position);
}

// Every field of particle `id` is a function of id, so that a field left behind by the sort shows.
TEST(Particles, FieldsTravelTogetherThroughASort) {
  const std::size_t n = 3000;
  Particles p = particles_at(random_cloud(n, Vec3::Zero(), Vec3::Ones(), 14), 0.05);
  std::vector<Vec3> created_at(n);
  p.plastic_strain.resize(n), p.failed.resize(n), p.bulking.resize(n);
  p.strain_rate.resize(n), p.tensile_damage.resize(n), p.shear_damage.resize(n), p.deformation_gradient.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double v = static_cast<double>(i);
    created_at[i] = p.motion[i].position;
    p.motion[i].velocity = {v, 2 * v, 3 * v};
    p.motion[i].volume = v + 0.5;
    p.stress[i].xy = v;
    p.velocity_gradient[i](2, 1) = v;
    p.acceleration[i][1] = v;
    p.held[i] = i % 3 == 0;
    p.correction[i].yz = v;
    p.plastic_strain[i] = v;
    p.failed[i] = i % 5 == 0;
    p.bulking[i] = v;
    p.strain_rate[i] = v;
    p.tensile_damage[i] = v;
    p.shear_damage[i] = v;
    p.deformation_gradient[i](2, 1) = v;
  }
  Neighbours neighbours(0.1, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
  neighbours.rebuild(p);
  std::set<std::uint32_t> seen;
  bool moved = false;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t id = p.id[i];
    const double v = id;
    seen.insert(id);
    moved = moved || id != i;
    EXPECT_EQ(p.motion[i].position, created_at[id]);
    EXPECT_EQ(p.motion[i].velocity, Vec3(v, 2 * v, 3 * v));
    EXPECT_EQ(p.motion[i].volume, v + 0.5);
    EXPECT_EQ(p.stress[i].xy, v);
    EXPECT_EQ(p.velocity_gradient[i](2, 1), v);
    EXPECT_EQ(p.acceleration[i][1], v);
    EXPECT_EQ(p.held[i] != 0, id % 3 == 0);
    EXPECT_EQ(p.correction[i].yz, v);
    EXPECT_EQ(p.plastic_strain[i], v);
    EXPECT_EQ(p.failed[i] != 0, id % 5 == 0);
    EXPECT_EQ(p.bulking[i], v);
    EXPECT_EQ(p.strain_rate[i], v);
    EXPECT_EQ(p.tensile_damage[i], v);
    EXPECT_EQ(p.shear_damage[i], v);
    EXPECT_EQ(p.deformation_gradient[i](2, 1), v);
  }
  EXPECT_EQ(seen.size(), n);
  EXPECT_TRUE(moved);
}

TEST(Particles, FieldsThatAreNotInUseStayEmptyThroughASort) {
  Particles p = particles_at(random_cloud(500, Vec3::Zero(), Vec3::Ones(), 15), 0.05);
  p.correction.clear();
  Neighbours neighbours(0.1, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
  neighbours.rebuild(p);
  EXPECT_TRUE(p.correction.empty());
  EXPECT_TRUE(p.plastic_strain.empty());
  EXPECT_TRUE(p.failed.empty());
  EXPECT_TRUE(p.bulking.empty());
}

}  // namespace
}  // namespace nilas::sph
