// The same oblique impact in hosts with different steps: what the step of the world changes.
//
// Prints two tables in Markdown: the HCC alone, and the HCC towing a ball on a joint, whose reactions reach the ice
// once per Bullet step. Each row is compared with the host at 1e-5 s. Takes some minutes.
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>

#include "coupling/ice_plugin.hpp"
#include "coupling/simulation.hpp"
#include "rigid/bullet_body.hpp"
#include "rigid/bullet_world.hpp"

namespace {

using nilas::Vec3;
using nilas::rigid::from_bullet;
using nilas::rigid::to_bullet;

constexpr double kEnd = 1.0 / 60;  // s: one step of the slowest host
constexpr int kSubSteps = 3200;    // of one length: a multiple of all numbers of host steps below
constexpr int kHostSteps[] = {1, 4, 16, 160, 1600};

struct Variant {
  const char* title;
  bool equal_sub_steps, towing;
};

/// A sheet of 1.2 m with a fixed rim, the ice of the scene hcc-oblique at 4 cm.
nilas::sph::IceSpec sheet(bool equal_sub_steps) {
  nilas::sph::IceSpec ice;
  nilas::sph::PieceSpec disc;
  disc.shape = nilas::sph::IceShape::disc;
  disc.diameter = 1.2;
  disc.thickness = 0.3;
  disc.fixed.rim = true;
  ice.pieces = {disc};
  ice.spacing = 0.04;
  if (equal_sub_steps) ice.numerics.max_step = kEnd / kSubSteps * (1 + 1e-6);
  return ice;
}

/// 100 m/s at 60 degrees from below, the tip 2 cm under the sheet.
nilas::rigid::BodySpec hcc() {
  nilas::rigid::BodySpec body;
  body.name = "hcc";
  body.shape = nilas::hcc(1.8, 0.3, 0.2);
  body.boundary_spacing = 0.03;
  body.mass = nilas::rigid::from_density(body.shape, 1500);
  const double angle = std::numbers::pi / 3;
  const Vec3 axis(0, -std::cos(angle), std::sin(angle));
  body.orientation = nilas::rigid::orientation_along(axis);
  body.velocity = 100 * axis;
  body.position = Vec3(0, 0, -0.17) + body.orientation * body.mass.centre_of_mass;
  return body;
}

struct Outcome {
  Vec3 position, velocity, axis;
  double momentum_residual;
  std::size_t sub_steps;
};

Outcome outcome(const nilas::rigid::State& state, double mass, nilas::Impact& impact) {
  return {state.position, state.momentum / mass, state.orientation * Vec3::UnitZ(), impact.ledger().momentum_residual,
          impact.last_step().number};
}

/// A host of its own; towing: a ball of 20 kg on a joint at the tail.
Outcome host(int steps, const Variant& variant) {
  const nilas::rigid::BodySpec spec = hcc();
  nilas::rigid::BulletWorld world;
  nilas::rigid::BulletBody body(spec);
  world.world().addRigidBody(&body.body());

  nilas::rigid::BodySpec towed;
  towed.shape = nilas::rigid::Sphere{0.3};
  towed.mass = nilas::rigid::from_mass(towed.shape, 20);
  const Vec3 tail = spec.position + spec.orientation * (Vec3(0, 0, -1.9) - spec.mass.centre_of_mass);
  towed.position = tail + spec.orientation * Vec3(0, 0, -0.3);
  towed.velocity = spec.velocity;
  nilas::rigid::BulletBody ball(towed);
  const btVector3 pivot = to_bullet(tail);
  btPoint2PointConstraint joint(body.body(), ball.body(), body.body().getCenterOfMassTransform().inverse() * pivot,
                                ball.body().getCenterOfMassTransform().inverse() * pivot);
  if (variant.towing) {
    world.world().addRigidBody(&ball.body());
    world.world().addConstraint(&joint);
  }

  nilas::IcePlugin ice(sheet(variant.equal_sub_steps));
  ice.attach(body.body(), spec.shape, spec.boundary_spacing, spec.mass.centre_of_mass, spec.name);
  world.world().addAction(&ice);
  for (int n = 0; n < steps; ++n) world.world().stepSimulation(to_bullet(kEnd / steps), 0);

  world.world().removeAction(&ice);
  if (variant.towing) {
    world.world().removeConstraint(&joint);
    world.world().removeRigidBody(&ball.body());
  }
  world.world().removeRigidBody(&body.body());
  return outcome(ice.impact().bodies()[0].state(), spec.mass.mass, ice.impact());
}

/// The loop of the command line, with its default step.
Outcome command_line() {
  nilas::Simulation simulation(sheet(false), {hcc()}, 1e-4);
  simulation.advance_to(kEnd);
  return outcome(simulation.impact().bodies()[0].state(), hcc().mass.mass, simulation.impact());
}

void print_row(const std::string& name, const Outcome& o, const Outcome& reference) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const nilas::rigid::BodySpec start = hcc();
  const double turn = std::acos(std::min(1.0, (start.orientation * Vec3::UnitZ()).dot(reference.axis)));
  const double off = std::asin(std::min(1.0, o.axis.cross(reference.axis).norm()));
  std::printf("| %s | %zu | %.1e | %.2g %% | %.2g %% | %.2g deg | %.2g %% |\n", name.c_str(), o.sub_steps,
              o.momentum_residual,
              100 * (o.position - reference.position).norm() / (reference.position - start.position).norm(),
              100 * (o.velocity - reference.velocity).norm() / (reference.velocity - start.velocity).norm(),
              kDegrees * off, 100 * off / turn);
}

void print_table(const Variant& variant) {
  std::printf(
      "\n%s\n\n| step of the host | sub-steps | momentum residual | position, of the way | velocity, of its "
      "change | attitude | of its change |\n|---|---:|---:|---:|---:|---:|---:|\n",
      variant.title);
  const Outcome reference = host(kHostSteps[4], variant);
  if (!variant.equal_sub_steps) print_row("command line, 1e-4 s", command_line(), reference);
  const char* const names[] = {"1/60 s", "1/240 s", "1/960 s", "1.04e-4 s"};
  for (int n = 0; n < 4; ++n) print_row(names[n], host(kHostSteps[n], variant), reference);
  print_row("1.04e-5 s", reference, reference);
}

}  // namespace

int main() {
  const Variant variants[] = {{"HCC alone", false, false},
                              {"HCC alone, sub-steps of one length", true, false},
                              {"HCC towing a ball of 20 kg, sub-steps of one length", true, true}};
  for (const Variant& variant : variants) print_table(variant);
}
