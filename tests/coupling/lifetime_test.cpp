// Compiled once per precision of Bullet, and once more with the address and undefined-behaviour sanitizers.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

/// World, body and plugin, each destroyed on demand as Bullet asks it of a host: what goes first leaves the world.
struct Parts {
  std::unique_ptr<rigid::BulletWorld> world = std::make_unique<rigid::BulletWorld>();
  std::unique_ptr<rigid::BulletBody> body;
  std::unique_ptr<IcePlugin> plugin;

  explicit Parts(const rigid::BodySpec& spec) : body(std::make_unique<rigid::BulletBody>(spec)) {
    world->world().addRigidBody(&body->body());
    plugin = std::make_unique<IcePlugin>(test::small_sheet(0.06));
    plugin->attach(body->body(), spec.shape, spec.boundary_spacing);
    world->world().addAction(plugin.get());
  }
  void destroy(char part) {
    if (part == 'w') world.reset();
    if (part == 'b') {
      if (world) world->world().removeRigidBody(&body->body());
      body.reset();
    }
    if (part == 'p') {
      if (world) world->world().removeAction(plugin.get());
      plugin.reset();
    }
  }
};

TEST(Lifetime, WorldBodyAndPluginMayGoInAnyOrder) {
  for (const bool stepped : {true, false}) {
    std::string order = "bpw";
    do {
      SCOPED_TRACE(order);
      Parts parts(test::short_hcc(60));
      if (stepped) parts.world->world().stepSimulation(btScalar(2e-4), 0);
      for (const char part : order) parts.destroy(part);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(Lifetime, AWorldIsSteppedOnAfterAnAttachedBodyWasDeleted) {
  Parts parts(test::short_hcc(60));
  parts.world->world().stepSimulation(btScalar(2e-4), 0);
  parts.destroy('b');
  parts.world->world().stepSimulation(btScalar(2e-4), 0);
  EXPECT_EQ(parts.plugin->presence(0), Presence::away);
  parts.destroy('p');
}

TEST(Lifetime, ABodyOutlivesItsPluginAndFliesOn) {
  const rigid::BodySpec spec = test::short_hcc(60);
  Parts parts(spec);
  parts.world->world().stepSimulation(btScalar(2e-4), 0);
  parts.destroy('p');
  const Vec3 before = rigid::from_bullet(parts.body->body().getLinearVelocity());
  parts.world->world().stepSimulation(btScalar(2e-4), 0);
  EXPECT_EQ(rigid::from_bullet(parts.body->body().getLinearVelocity()), before);
  parts.destroy('b');
}

TEST(Lifetime, APluginMayBeMadeAndDroppedWithoutAWorld) {
  IcePlugin plugin(test::small_sheet(0.06));
  EXPECT_GT(plugin.impact().ice().particles().size(), 0u);
}

}  // namespace
}  // namespace nilas
