// A host in one file.
#include "coupling/ice_plugin.hpp"
#include "rigid/bullet_body.hpp"

int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btSphereShape shape(btScalar(0.1));
  btRigidBody body(10, nullptr, &shape, btVector3(btScalar(0.04), btScalar(0.04), btScalar(0.04)));
  body.setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(-0.2))));
  body.setLinearVelocity(btVector3(0, 0, 10));
  world.addRigidBody(&body);

  nilas::sph::PieceSpec block;
  block.shape = nilas::sph::IceShape::block;
  block.size = nilas::Vec3::Constant(0.2);
  nilas::sph::IceSpec spec;
  spec.pieces = {block};
  spec.spacing = 0.04;
  nilas::IcePlugin ice(spec);
  ice.attach(body, nilas::rigid::Sphere{0.2});
  world.addAction(&ice);
  world.stepSimulation(btScalar(1e-3), 0);

  const bool pushed = ice.impact().bodies()[0].account().ice_impulse.z() < 0;
  world.removeAction(&ice);
  world.removeRigidBody(&body);
  return pushed && ice.impact().ledger().momentum_residual < 1e-10 ? 0 : 1;
}
