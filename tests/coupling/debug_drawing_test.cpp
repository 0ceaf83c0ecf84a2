#include "coupling/debug_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using rigid::from_bullet;

struct Line {
  Vec3 from, to;
  btVector3 colour;
};

/// Remembers what is drawn.
class RecordingDrawer final : public btIDebugDraw {
 public:
  explicit RecordingDrawer(int mode = DBG_DrawWireframe) : mode_(mode) {}
  void drawLine(const btVector3& from, const btVector3& to, const btVector3& colour) override {
    lines.push_back({from_bullet(from), from_bullet(to), colour});
  }
  void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
  void reportErrorWarning(const char*) override {}
  void draw3dText(const btVector3&, const char*) override {}
  void setDebugMode(int mode) override { mode_ = mode; }
  int getDebugMode() const override { return mode_; }

  std::vector<Line> of(const btVector3& colour) const {
    std::vector<Line> some;
    for (const Line& line : lines)
      if (line.colour == colour) some.push_back(line);
    return some;
  }

  std::vector<Line> lines;

 private:
  int mode_;
};

/// Half a millisecond into the impact: some of the sheet has failed, the nose carries load.
Impact struck() {
  Impact impact(test::small_sheet(), {Body(test::short_hcc(60))});
  impact.advance(5e-4);
  return impact;
}

TEST(DebugDrawing, CrossesEveryParticleWhereItIsInTheColourOfItsCondition) {
  const Impact impact = struck();
  const sph::Particles& p = impact.ice().particles();
  const DebugDrawing style;
  RecordingDrawer drawer;
  debug_draw(impact, drawer);
  const std::size_t failed = impact.ice().failed_count();
  ASSERT_GT(failed, 0u);
  ASSERT_LT(failed, p.size());
  EXPECT_EQ(drawer.of(style.failed).size(), 3 * failed);
  EXPECT_EQ(drawer.of(style.intact).size(), 3 * (p.size() - failed));
  for (std::size_t i = 0; i < p.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const Line& line = drawer.lines[3 * i + static_cast<std::size_t>(axis)];
      EXPECT_LT((0.5 * (line.from + line.to) - p.motion[i].position).norm(), 1e-15);
      EXPECT_LT((line.to - line.from - 0.5 * 0.03 * Vec3::Unit(axis)).norm(), 1e-15);
      EXPECT_EQ(line.colour, p.failed[i] ? style.failed : style.intact);
    }
}

TEST(DebugDrawing, TellsYieldedIceFromFailed) {
  sph::IceSpec ice = test::small_sheet();
  ice.material.model = sph::Model::rate_dependent;
  Impact impact(ice, {Body(test::short_hcc(60))});
  impact.advance(2e-4);
  const sph::Particles& p = impact.ice().particles();
  std::size_t yielded = 0, failed = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    failed += p.failed[i];
    yielded += !p.failed[i] && (p.plastic_strain[i] > 0 || p.tensile_damage[i] > 0 || p.shear_damage[i] > 0);
  }
  ASSERT_GT(yielded, 0u);
  ASSERT_GT(failed, 0u);
  const DebugDrawing style;
  RecordingDrawer drawer;
  debug_draw(impact, drawer);
  EXPECT_EQ(drawer.of(style.yielded).size(), 3 * yielded);
  EXPECT_EQ(drawer.of(style.failed).size(), 3 * failed);
}

TEST(DebugDrawing, DrawsTractionsToScaleFromOutsideOntoTheBoundaryParticlesThatCarryForce) {
  const Impact impact = struck();
  const double spacing = 0.03;
  std::vector<sph::BoundaryParticle> loaded;
  for (const sph::BoundaryParticle& b : impact.surfaces()[0].particles)
    if (!b.force.isZero(0)) loaded.push_back(b);
  ASSERT_GT(loaded.size(), 5u);
  const DebugDrawing style;
  RecordingDrawer drawer;
  debug_draw(impact, drawer);
  const std::vector<Line> lines = drawer.of(style.traction);
  ASSERT_EQ(lines.size(), loaded.size());
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const Vec3 shaft = lines[n].to - lines[n].from, traction = loaded[n].force / loaded[n].area;
    EXPECT_EQ(lines[n].to, loaded[n].position);
    EXPECT_LT(shaft.dot(loaded[n].normal), 0);  // frictionless ice only presses
    const double length = spacing * std::min(traction.norm() / 1e6, 20.);
    EXPECT_LT((shaft - length * traction.normalized()).norm(), 1e-12);
  }
}

TEST(DebugDrawing, OfLargeIceDrawsTheSameEvenShareOfParticlesInEveryFrame) {
  Impact impact(test::small_sheet(), {Body(test::short_hcc(60))});
  const auto drawn = [&](std::size_t most) {
    DebugDrawing style;
    style.most_crosses = most;
    RecordingDrawer drawer;
    debug_draw(impact, drawer, style);
    std::vector<Vec3> centres;
    for (std::size_t n = 0; n < drawer.lines.size(); n += 3)
      centres.push_back(0.5 * (drawer.lines[n].from + drawer.lines[n].to));
    return centres;
  };
  const std::vector<Vec3> all = drawn(1000000);
  ASSERT_EQ(all.size(), impact.ice().particles().size());
  for (const std::size_t most : {1000u, 300u}) {
    const std::vector<Vec3> some = drawn(most);
    EXPECT_NEAR(static_cast<double>(some.size()), static_cast<double>(most), 0.02 * static_cast<double>(most));
    // Each of the eight parts of the sheet has its share, and each of its layers.
    const double share = static_cast<double>(some.size()) / static_cast<double>(all.size());
    const auto in = [](const std::vector<Vec3>& points, const auto& where) {
      return static_cast<double>(std::count_if(points.begin(), points.end(), where));
    };
    for (int octant = 0; octant < 8; ++octant) {
      const auto inside = [&](const Vec3& x) {
        return (x.x() > 0) == (octant & 1) && (x.y() > 0) == (octant >> 1 & 1) && (x.z() > 0) == (octant >> 2 & 1);
      };
      EXPECT_NEAR(in(some, inside) / (share * in(all, inside)), 1, 0.25) << most << " " << octant;
    }
    for (double z = -0.15; z < 0.149; z += 0.03)
      EXPECT_GT(in(some, [&](const Vec3& x) { return x.z() > z && x.z() < z + 0.03; }), 0.5 * some.size() / 10) << z;
  }
  const std::vector<Vec3> before = drawn(300);
  impact.advance(2e-5);  // before the body is there: nothing moves
  const std::vector<Vec3> after = drawn(300);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t n = 0; n < after.size(); ++n) EXPECT_LT((after[n] - before[n]).norm(), 1e-9);
}

TEST(DebugDrawing, ReachesAnyWorldsDrawerInWireframeAndInNoOtherMode) {
  rigid::BulletBody body(test::short_hcc(60));
  rigid::BulletWorld host;
  IcePlugin plugin(test::small_sheet());
  RecordingDrawer drawer;
  host.world().setDebugDrawer(&drawer);
  plugin.attach(body.body(), test::short_hcc(60).shape);
  host.world().addAction(&plugin);
  const auto drawn = [&](int mode) {
    drawer.lines.clear();
    drawer.setDebugMode(mode);
    host.world().debugDrawWorld();
    return drawer.lines.size();
  };
  using Mode = btIDebugDraw::DebugDrawModes;
  EXPECT_EQ(drawn(Mode::DBG_DrawWireframe), 3 * plugin.impact().ice().particles().size());
  for (const int mode : {Mode::DBG_NoDebug, Mode::DBG_DrawAabb, Mode::DBG_DrawNormals, Mode::DBG_DrawContactPoints})
    EXPECT_EQ(drawn(mode), 0u) << mode;
  host.world().removeAction(&plugin);
}

}  // namespace
}  // namespace nilas
