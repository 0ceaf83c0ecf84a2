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

constexpr double kSpacing = 0.05;  // of the columns; the result does not depend on it

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

std::vector<std::uint32_t> listed(const Neighbours& neighbours, std::size_t i) {
  std::vector<std::uint32_t> list;
  neighbours.for_each_near(i, [&](std::uint32_t j) { list.push_back(j); });
  return list;
}

/// Every particle in reach is listed once, i itself never, and what is listed beyond shares a group with one in reach.
void expect_agrees_with_brute_force(Neighbours& neighbours, Particles& p, double reach, const Period& period) {
  neighbours.rebuild(p);
  const auto expected = all_pairs(p, reach, period);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::vector<std::uint32_t> list = listed(neighbours, i);
    std::sort(list.begin(), list.end());
    ASSERT_EQ(std::adjacent_find(list.begin(), list.end()), list.end()) << "twice near particle " << i;
    ASSERT_FALSE(std::binary_search(list.begin(), list.end(), i));
    ASSERT_TRUE(std::includes(list.begin(), list.end(), expected[i].begin(), expected[i].end())) << "particle " << i;
    for (const std::uint32_t group : neighbours.groups_near(i)) {
      const auto in_reach = [&](std::uint32_t j) {
        return j == i || std::binary_search(expected[i].begin(), expected[i].end(), j);
      };
      bool any = false;
      for (std::uint32_t j = neighbours.group_begin(group); j < neighbours.group_begin(group + 1); ++j)
        any = any || in_reach(j);
      ASSERT_TRUE(any) << "group " << group << " near particle " << i;
    }
    pairs += list.size();
  }
  EXPECT_GT(pairs, 0u);
}

TEST(Neighbours, ListAgreesWithBruteForceForARandomCloud) {
  const Vec3 lower(-1, 2, 5), upper(0, 4, 5.5);
  for (const double reach : {0.05, 0.13, 0.4, 3.0}) {
    Particles p = particles_at(random_cloud(1500, lower, upper, 1), 0.05);
    Neighbours neighbours(reach, kSpacing, Period::Zero(), lower, upper, 1000);
    expect_agrees_with_brute_force(neighbours, p, reach, Period::Zero());
  }
}

// One, two, three and more cells along the axes that wrap; the shortest axis is just longer than two reaches.
TEST(Neighbours, ListAgreesWithBruteForceInAPeriodicDomain) {
  const double reach = 0.1;
  for (const Period& period : {Period(0.21, 0.35, 1), Period(0.9, 0, 0), Period(0, 0.21, 0.21), Period(0.31, 0.5, 0)}) {
    const Vec3 upper = period.cwiseMax(0.4);
    // Particles are not wrapped back: some are periods away from the box.
    std::vector<Vec3> x = random_cloud(1200, Vec3::Zero(), upper, 4);
    Random random(5);
    for (Vec3& v : x) v += period.cwiseProduct((1 * random.vector()).array().round().matrix());
    Particles p = particles_at(x, 0.04);
    Neighbours neighbours(reach, kSpacing, period, Vec3::Zero(), upper, 1000);
    expect_agrees_with_brute_force(neighbours, p, reach, period);
  }
}

TEST(Neighbours, StraysFarOutsideTheBoundsAreFound) {
  const Vec3 lower = Vec3::Zero(), upper = Vec3::Ones();
  std::vector<Vec3> x = random_cloud(600, lower, upper, 6);
  for (const Vec3& where : {Vec3(1e6, -3e5, 0.5), Vec3(-40, 0.5, 0.5), Vec3(0.5, 1.05, 2e9)})
    for (int n = 0; n < 20; ++n) x.push_back(where + 0.2 * Random(100 + n).vector());
  for (const Vec3& v : random_cloud(200, Vec3::Constant(-0.5), Vec3::Constant(1.5), 7)) x.push_back(v);
  Particles p = particles_at(x, 0.05);
  Neighbours neighbours(0.15, kSpacing, Period::Zero(), lower, upper, 1000);
  expect_agrees_with_brute_force(neighbours, p, 0.15, Period::Zero());
}

TEST(Neighbours, StraysDoNotMakeTheGridGrow) {
  std::vector<Vec3> x = random_cloud(600, Vec3::Zero(), Vec3::Ones(), 6);
  const auto bytes = [&] {
    Particles p = particles_at(x, 0.05);
    Neighbours neighbours(0.1, kSpacing, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
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
  Neighbours neighbours(0.2, kSpacing, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
  expect_agrees_with_brute_force(neighbours, p, 0.2, Period::Zero());
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_GE(listed(neighbours, i).size(), 2u);
}

TEST(Neighbours, LoneParticleHasNone) {
  Particles p = particles_at({{0.3, 0.2, 0.1}}, 0.1);
  Neighbours neighbours(0.2, kSpacing, Period::Zero(), p.motion[0].position, p.motion[0].position, 1000);
  neighbours.rebuild(p);
  EXPECT_TRUE(listed(neighbours, 0).empty());
}

TEST(Neighbours, FlatCloudWithoutExtentIsListed) {
  std::vector<Vec3> x = random_cloud(200, Vec3(0, 0, 1), Vec3(1, 1, 1), 9);
  Particles p = particles_at(x, 0.1);
  Neighbours neighbours(0.2, kSpacing, Period::Zero(), Vec3(0, 0, 1), Vec3(1, 1, 1), 1000);
  expect_agrees_with_brute_force(neighbours, p, 0.2, Period::Zero());
}

TEST(Neighbours, RebuildAfterMotionAgreesWithBruteForceAgain) {
  Particles p = particles_at(random_cloud(800, Vec3::Zero(), Vec3::Ones(), 10), 0.1);
  Neighbours neighbours(0.15, kSpacing, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
  Random random(11);
  for (int n = 0; n < 5; ++n) {
    for (Motion& m : p.motion) m.position += 0.3 * random.vector();
    expect_agrees_with_brute_force(neighbours, p, 0.15, Period::Zero());
  }
}

TEST(Neighbours, OrderAndListsAreTheSameForOneAndTwoThreads) {
  const std::vector<Vec3> x = random_cloud(6000, Vec3::Zero(), Vec3::Ones(), 12);
  const auto build = [&](int threads) {
    const test::Threads scope(threads);
    Particles p = particles_at(x, 0.05);
    Neighbours neighbours(0.12, kSpacing, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
    neighbours.rebuild(p);
    std::vector<std::vector<std::uint32_t>> lists;
    for (std::size_t i = 0; i < p.size(); ++i) lists.push_back(listed(neighbours, i));
    return std::pair{p.id, lists};
  };
  EXPECT_EQ(build(1), build(2));
}

TEST(Neighbours, LargestDisplacementIsThatOfTheParticleThatMovedFarthest) {
  Particles p = particles_at(random_cloud(500, Vec3::Zero(), Vec3::Ones(), 13), 0.05);
  Neighbours neighbours(0.12, kSpacing, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
  neighbours.rebuild(p);
  EXPECT_EQ(neighbours.largest_displacement(p), 0);
  p.motion[17].position += Vec3(0.003, 0, -0.004);
  p.motion[401].position += Vec3(0, 0.001, 0);
  EXPECT_NEAR(neighbours.largest_displacement(p), 0.005, 1e-15);
}

// Two particles of one block are neighbours through the mutual list of the one or the other, others through both
// one-sided lists: each pair is evaluated for either side exactly once.
TEST(Neighbours, OneSidedAndMutualListsTogetherVisitEveryPairForEitherSideOnce) {
  for (const Precision precision : {Precision::double_, Precision::single}) {
    Particles p = particles_at(random_cloud(5000, Vec3::Zero(), Vec3::Ones(), 16), 0.05);
    Neighbours neighbours(0.12, kSpacing, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 5000, precision);
    neighbours.rebuild(p);
    ASSERT_GT(neighbours.block_count(), 2u);
    std::vector<std::vector<std::uint32_t>> visits(p.size());
    const auto for_members = [&](std::span<const std::uint32_t> groups, const auto& visit) {
      for (const std::uint32_t group : groups)
        for (std::uint32_t j = neighbours.group_begin(group); j < neighbours.group_begin(group + 1); ++j) visit(j);
    };
    for (std::uint32_t i = 0; i < p.size(); ++i) {
      for_members(neighbours.groups_one_sided(i), [&](std::uint32_t j) { visits[i].push_back(j); });
      for_members(neighbours.groups_mutual(i),
                  [&](std::uint32_t j) { visits[i].push_back(j), visits[j].push_back(i); });
    }
    const auto expected = all_pairs(p, 0.12, Period::Zero());
    for (std::uint32_t i = 0; i < p.size(); ++i) {
      std::sort(visits[i].begin(), visits[i].end());
      ASSERT_EQ(std::adjacent_find(visits[i].begin(), visits[i].end()), visits[i].end());
      ASSERT_TRUE(std::includes(visits[i].begin(), visits[i].end(), expected[i].begin(), expected[i].end()));
    }
  }
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
  Neighbours neighbours(0.1, kSpacing, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
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
  Neighbours neighbours(0.1, kSpacing, Period::Zero(), Vec3::Zero(), Vec3::Ones(), 1000);
  neighbours.rebuild(p);
  EXPECT_TRUE(p.correction.empty());
  EXPECT_TRUE(p.plastic_strain.empty());
  EXPECT_TRUE(p.failed.empty());
  EXPECT_TRUE(p.bulking.empty());
}

}  // namespace
}  // namespace nilas::sph
