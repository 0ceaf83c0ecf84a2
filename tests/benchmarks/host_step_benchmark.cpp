// What one step of a host's world costs: without ice, and with sleeping ice of about 100 thousand particles.
#include <benchmark/benchmark.h>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"

namespace {

using nilas::Vec3;

nilas::rigid::BodySpec hcc() {
  nilas::rigid::BodySpec spec;
  spec.name = "hcc";
  spec.shape = nilas::hcc(1.8, 0.3, 0.2);
  spec.boundary_spacing = 0.0113;
  spec.mass = nilas::rigid::from_density(spec.shape, 1500);
  spec.position = Vec3(0, 0, -1000);
  spec.angular_velocity = Vec3(0.1, 0.2, 5);
  return spec;
}

nilas::sph::IceSpec sheet() {
  nilas::sph::IceSpec ice;
  nilas::sph::PieceSpec disc;
  disc.shape = nilas::sph::IceShape::disc;
  disc.diameter = 1.2;
  disc.thickness = 0.3;
  ice.pieces = {disc};
  ice.spacing = 0.015;
  return ice;
}

/// A tumbling HCC far from the ice; range(0): whether there is ice.
void host_step(benchmark::State& state) {
  const nilas::rigid::BodySpec spec = hcc();
  nilas::rigid::BulletBody body(spec);
  nilas::rigid::BulletWorld world;
  world.world().addRigidBody(&body.body());
  nilas::IcePlugin plugin(sheet());
  plugin.attach(body.body(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, spec.name);
  if (state.range(0)) world.world().addAction(&plugin);
  for (auto _ : state) world.world().stepSimulation(1. / 240, 0);
  if (state.range(0) && !plugin.last_step().asleep) state.SkipWithError("the ice is awake");
  state.counters["particles"] = static_cast<double>(plugin.impact().ice().particles().size());
  world.world().removeAction(&plugin);
  world.world().removeRigidBody(&body.body());
}
BENCHMARK(host_step)->ArgName("ice")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
