// A Bullet world at 1/240 s: ground, an HCC that tows a ball on a joint, and a block of ice frozen to the ground that
// they strike. What makes the ice is three lines, marked below; the rest is a Bullet program as it was before. Ends
// with 0 if the ice broke and the books closed.
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>

#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"

namespace {

constexpr double kStep = 1. / 240;          // s
constexpr double kLargestResidual = 1e-10;  // of the momentum of ice, HCC and what reached them

/// 0.6 m long, 36 kg, heading 60 degrees down at 20 m/s, its tip just above the ice.
nilas::rigid::BodySpec falling_hcc() {
  nilas::rigid::BodySpec spec;
  spec.shape = nilas::hcc(0.6, 0.3, 0.2);
  spec.mass = nilas::rigid::from_density(spec.shape, 900);
  const nilas::Vec3 axis(0, 0.5, -std::sqrt(0.75));
  spec.orientation = nilas::rigid::orientation_along(axis);
  spec.velocity = 20 * axis;
  spec.position = nilas::Vec3(0, 0, 0.32) + spec.orientation * spec.mass.centre_of_mass;
  return spec;
}

/// The host's own: world, ground, HCC and the ball that it tows.
struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  btStaticPlaneShape plane{btVector3(0, 0, 1), 0};
  btRigidBody ground{0, nullptr, &plane};
  btSphereShape sphere{btScalar(0.1)};
  btRigidBody ball{20, nullptr, &sphere, btVector3(btScalar(0.08), btScalar(0.08), btScalar(0.08))};

  nilas::rigid::BulletBody bullet{falling_hcc()};  // any btRigidBody will do
  btRigidBody& hcc = bullet.body();
  std::unique_ptr<btPoint2PointConstraint> joint;

  World() {
    world.setGravity(btVector3(0, 0, btScalar(-9.81)));
    world.addRigidBody(&ground);
    world.addRigidBody(&ball);
    world.addRigidBody(&hcc);
    // The ball follows the tail of the HCC, at rest relative to it.
    const btVector3 rope = hcc.getLinearVelocity().normalized() * btScalar(0.6);
    ball.setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), hcc.getCenterOfMassPosition() - rope));
    ball.setLinearVelocity(hcc.getLinearVelocity());
    const btVector3 in_hcc = hcc.getCenterOfMassTransform().inverse() * ball.getCenterOfMassPosition();
    joint = std::make_unique<btPoint2PointConstraint>(hcc, ball, in_hcc, btVector3(0, 0, 0));
    world.addConstraint(joint.get(), true);
  }
  ~World() {
    world.removeConstraint(joint.get());
    for (btRigidBody* body : {&hcc, &ball, &ground}) world.removeRigidBody(body);
  }
};

/// 0.6 x 0.6 x 0.3 m on the ground, held by its lowest layers.
nilas::sph::IceSpec frozen_block() {
  nilas::sph::PieceSpec block;
  block.shape = nilas::sph::IceShape::block;
  block.size = nilas::Vec3(0.6, 0.6, 0.3);
  block.centre = nilas::Vec3(0, 0, 0.15);
  block.fixed.faces[4] = true;  // z-
  nilas::sph::IceSpec ice;
  ice.pieces = {block};
  ice.spacing = 0.05;
  ice.gravity = nilas::Vec3(0, 0, -9.81);
  return ice;
}

int run() {
  World host;
  nilas::IcePlugin ice(frozen_block());             // 1: the ice
  ice.attach(host.hcc, nilas::hcc(0.6, 0.3, 0.2));  // 2: what it meets
  host.world.addAction(&ice);                       // 3: from now on the ice is stepped with the world

  double peak = 0;
  nilas::Vec3 impulse = nilas::Vec3::Zero();
  for (int n = 0; n < 24; ++n) {
    host.world.stepSimulation(btScalar(kStep), 1, btScalar(kStep));
    const nilas::Vec3 now = ice.impact().bodies()[0].account().ice_impulse;
    peak = std::max(peak, (now - impulse).norm() / kStep);
    impulse = now;
  }

  const nilas::sph::Ice& block = ice.impact().ice();
  const double failed = static_cast<double>(block.failed_count()) / block.particles().size();
  const double residual = ice.impact().ledger().momentum_residual;
  std::printf("Bullet in %s precision, %zu particles of ice, %.0f ms in %zu sub-steps\n",
              sizeof(btScalar) == sizeof(double) ? "double" : "single", block.particles().size(),
              1e3 * ice.impact().last_step().time, ice.impact().last_step().number);
  std::printf("largest load over a step  %.1f kN\n", 1e-3 * peak);
  std::printf("impulse of the ice        %.1f N s\n", impulse.norm());
  std::printf("HCC: speed, spin          %.2f m/s, %.2f rad/s\n", host.hcc.getLinearVelocity().length(),
              host.hcc.getAngularVelocity().length());
  std::printf("ball: speed               %.2f m/s\n", host.ball.getLinearVelocity().length());
  std::printf("failed fraction           %.3f\n", failed);
  std::printf("momentum residual         %.1e\n", residual);
  host.world.removeAction(&ice);
  return impulse.z() > 0 && failed > 0 && residual < kLargestResidual ? 0 : 1;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
