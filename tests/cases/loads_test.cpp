// loads.csv of a run directory.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cases/run.hpp"
#include "coupling/load_replay.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"
#include "tests/support/scene_text.hpp"
#include "tests/support/scratch_directory.hpp"

namespace nilas::cases {
namespace {

using rigid::from_bullet;

/// A run in a directory of its own.
class Loads : public testing::Test {
 protected:
  nlohmann::json run(const Scene& scene) {
    RunOptions options;
    options.scene_name = "small";
    options.out = scratch.path() / "out";
    options.overwrite = true;
    options.threads = 1;
    std::ostringstream log;
    end = cases::run(scene, options, log).end;
    return nlohmann::json::parse(scratch.read("out/summary.json"));
  }
  Scene read(const std::string& text, std::vector<std::string> overrides = {}) const {
    overrides.push_back("run.end_time_s=1e-3");
    return read_scene(scratch.write("scene.toml", text), overrides);
  }
  LoadRecord record(const std::string& file = "loads.csv") const {
    return read_load_record(scratch.path() / "out" / file);
  }
  std::set<std::string> load_files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(scratch.path() / "out"))
      if (const std::string name = entry.path().filename(); name.starts_with("loads")) names.insert(name);
    return names;
  }

  const test::ScratchDirectory scratch;
  RunEnd end = RunEnd::finished;
};

Vec3 vector(const nlohmann::json& array) { return Vec3(array[0], array[1], array[2]); }

TEST_F(Loads, HaveARowForTheStartAndEverySubStepAndEndWithTheImpulseOfTheSummary) {
  const auto summary = run(read(test::oblique_scene()));
  const std::vector<LoadRow> rows = record().rows();
  EXPECT_EQ(rows.size(), summary["steps"].get<std::size_t>() + 1);
  EXPECT_EQ(rows.front().time, 0);
  EXPECT_NEAR(rows.back().time, 1e-3, 1e-15);
  EXPECT_EQ(rows.back().impulse, vector(summary["impulse_N_s"]));
  EXPECT_GT(rows.back().impulse.norm(), 1);
  EXPECT_EQ(load_files(), std::set<std::string>{"loads.csv"});
}

TEST_F(Loads, PlayedBackInABulletWorldGiveTheMotionOfTheSummary) {
  const Scene scene = read(test::oblique_scene(), {"run.gravity_m_s2=[0, 0, -981]"});
  const auto summary = run(scene);
  rigid::BulletBody body(scene.bodies[0]);
  rigid::BulletWorld host;
  host.world().setGravity(btVector3(0, 0, -981));
  host.world().addRigidBody(&body.body());
  LoadReplay replay(record(), body.body());
  host.world().addAction(&replay);
  for (int n = 0; n < 5; ++n) host.world().stepSimulation(btScalar(2e-4), 0);
  host.world().removeAction(&replay);
  host.world().removeRigidBody(&body.body());

  const Vec3 speed = vector(summary["final_velocity_m_s"]), spin = vector(summary["final_angular_velocity_rad_s"]);
  const Vec3 place = vector(summary["final_position_m"]);
  EXPECT_GT((speed - scene.bodies[0].velocity).norm(), 1);
  EXPECT_LT((from_bullet(body.body().getLinearVelocity()) - speed).norm(),
            1e-6 * (speed - scene.bodies[0].velocity).norm());
  EXPECT_LT((from_bullet(body.body().getAngularVelocity()) - spin).norm(), 1e-6 * spin.norm());
  EXPECT_LT((from_bullet(body.body().getCenterOfMassTransform().getOrigin()) - place).norm(),
            1e-6 * (place - scene.bodies[0].position).norm());
}

TEST_F(Loads, HaveFewerRowsAndTheSameEndWithAnInterval) {
  const auto summary = run(read(test::oblique_scene(), {"output.loads_interval_s=1e-4"}));
  const std::vector<LoadRow> rows = record().rows();
  EXPECT_GE(rows.size(), 10u);
  EXPECT_LE(rows.size(), 12u);
  for (std::size_t n = 2; n + 1 < rows.size(); ++n) EXPECT_GT(rows[n].time - rows[n - 1].time, 1e-4 * (1 - 1e-9));
  EXPECT_EQ(rows.back().impulse, vector(summary["impulse_N_s"]));
}

TEST_F(Loads, OfSeveralBodiesAreAFileForEachAndThoseOfAnOldRunAreRemoved) {
  const std::string wall =
      "[[body]]\nname = \"wall\"\nshape = \"box\"\nsize_m = [1, 1, 1]\nmotion = \"fixed\"\nposition_m = [0, 0, 5]\n";
  const std::string scene = test::replaced(test::oblique_scene(), "[[body]]\n", wall + "[[body]]\nname = \"hcc\"\n");
  const auto summary = run(read(scene));
  EXPECT_EQ(load_files(), (std::set<std::string>{"loads-hcc.csv", "loads-wall.csv"}));
  EXPECT_EQ(record("loads-hcc.csv").rows().back().impulse, vector(summary["bodies"]["hcc"]["impulse_N_s"]));
  EXPECT_TRUE(record("loads-wall.csv").rows().back().impulse.isZero(0));
  run(read(test::oblique_scene()));
  EXPECT_EQ(load_files(), std::set<std::string>{"loads.csv"});
}

TEST_F(Loads, OfARunThatFailsGoAsFarAsItCame) {
  run(read(test::oblique_scene(), {"numerics.cfl=5", "numerics.max_coupling_number=10"}));
  EXPECT_EQ(end, RunEnd::numerical_failure);
  EXPECT_GE(record().rows().size(), 1u);
}

}  // namespace
}  // namespace nilas::cases
