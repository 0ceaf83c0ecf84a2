#include "coupling/host_multibody_tree.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <memory>

#include "rigid/bullet_body.hpp"

namespace nilas {
namespace {

using rigid::from_bullet;
using rigid::Quat;
using rigid::to_bullet;

const Vec3 kBaseInertia(0.5, 0.7, 0.9), kLinkInertia(0.2, 0.1, 0.25);  // kg m2
constexpr double kBaseMass = 5, kLinkMass = 2;                         // kg

using Setup = void (*)(btMultiBody&, int link, const btQuaternion& turned, const btVector3& e, const btVector3& d);

void setup_fixed(btMultiBody& b, int i, const btQuaternion& turned, const btVector3& e, const btVector3& d) {
  b.setupFixed(i, kLinkMass, to_bullet(kLinkInertia), i - 1, turned, e, d);
}
void setup_revolute(btMultiBody& b, int i, const btQuaternion& turned, const btVector3& e, const btVector3& d) {
  b.setupRevolute(i, kLinkMass, to_bullet(kLinkInertia), i - 1, turned, btVector3(0.6, 0, 0.8), e, d);
}
void setup_prismatic(btMultiBody& b, int i, const btQuaternion& turned, const btVector3& e, const btVector3& d) {
  b.setupPrismatic(i, kLinkMass, to_bullet(kLinkInertia), i - 1, turned, btVector3(0, 0.6, 0.8), e, d, true);
}
void setup_spherical(btMultiBody& b, int i, const btQuaternion& turned, const btVector3& e, const btVector3& d) {
  b.setupSpherical(i, kLinkMass, to_bullet(kLinkInertia), i - 1, turned, e, d);
}
void setup_planar(btMultiBody& b, int i, const btQuaternion& turned, const btVector3& e, const btVector3&) {
  b.setupPlanar(i, kLinkMass, to_bullet(kLinkInertia), i - 1, turned, btVector3(0, 0, 1), e);
}

/// A chain in an arbitrary configuration and motion.
std::unique_ptr<btMultiBody> chain(const std::vector<Setup>& joints, bool fixed_base) {
  auto b = std::make_unique<btMultiBody>(static_cast<int>(joints.size()), kBaseMass, to_bullet(kBaseInertia),
                                         fixed_base, false);
  for (std::size_t i = 0; i < joints.size(); ++i)
    joints[i](*b, static_cast<int>(i), btQuaternion(btVector3(1, 2, -1).normalized(), 0.4), btVector3(0.3, -0.2, 0.5),
              btVector3(0.1, 0.4, -0.2));
  b->finalizeMultiDof();
  b->setBasePos(btVector3(3, -2, 1));
  b->setWorldToBaseRot(btQuaternion(btVector3(-1, 1, 3).normalized(), 1.1));
  Eigen::VectorXd motion(6 + b->getNumDofs());
  for (Eigen::Index k = 0; k < motion.size(); ++k) motion[k] = std::sin(1.7 * k + 0.3);
  if (fixed_base) motion.head<6>().setZero();
  set_coordinate_velocities(*b, motion);
  b->stepPositionsMultiDof(0.6);  // joints away from zero
  return b;
}

struct Case {
  const char* name;
  std::vector<Setup> joints;
};
const std::vector<Case> kCases = {{"lone", {}},
                                  {"hinge", {setup_revolute}},
                                  {"slider", {setup_prismatic}},
                                  {"ball", {setup_spherical}},
                                  {"planar", {setup_planar}},
                                  {"chain", {setup_revolute, setup_fixed, setup_spherical, setup_prismatic}}};

template <class Check>
void for_all_cases(Check check) {
  for (const Case& c : kCases)
    for (const bool fixed : {false, true}) {
      SCOPED_TRACE(std::string(c.name) + (fixed ? ", fixed base" : ", floating"));
      check(*chain(c.joints, fixed), static_cast<int>(c.joints.size()) - 1);
    }
}

TEST(MultibodyTree, PlacesLinksWhereBulletDoes) {
  for_all_cases([](btMultiBody& b, int link) {
    const MultibodyTree tree(b);
    EXPECT_LT((tree.position(link) - from_bullet(b.localPosToWorld(link, btVector3(0, 0, 0)))).norm(), 1e-14);
    const Vec3 local(0.3, -0.7, 0.2);
    EXPECT_LT((tree.orientation(link) * local - from_bullet(b.localDirToWorld(link, to_bullet(local)))).norm(), 1e-14);
  });
}

TEST(MultibodyTree, JacobianIsTheDerivativeOfThePose) {
  for_all_cases([](btMultiBody& b, int link) {
    constexpr double h = 1e-7;  // s; Bullet steps planar joints to first order
    const Vec6 velocity = MultibodyTree(b).jacobian(link) * coordinate_velocities(b);
    b.stepPositionsMultiDof(h);
    const MultibodyTree after(b);
    b.stepPositionsMultiDof(-2 * h);
    const MultibodyTree before(b);
    const Eigen::AngleAxisd turn(after.orientation(link) * before.orientation(link).conjugate());
    EXPECT_LT((velocity.head<3>() - (after.position(link) - before.position(link)) / (2 * h)).norm(), 1e-6);
    EXPECT_LT((velocity.tail<3>() - turn.angle() / (2 * h) * turn.axis()).norm(), 1e-6);
  });
}

TEST(MultibodyTree, MomentumIsThatOfBulletsLinkVelocities) {
  for_all_cases([](btMultiBody& b, int link) {
    std::vector<btVector3> omega(link + 2), velocity(link + 2);  // local frames, base first
    b.compTreeLinkVelocities(omega.data(), velocity.data());
    const Vec3 point(0.5, 4, -2);
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    for (int i = -1; i <= link; ++i) {
      const double mass = i < 0 ? kBaseMass : kLinkMass;
      const Vec3 inertia = i < 0 ? kBaseInertia : kLinkInertia;
      const Vec3 p = mass * from_bullet(b.localDirToWorld(i, velocity[i + 1]));
      linear += p;
      angular += (from_bullet(b.localPosToWorld(i, btVector3(0, 0, 0))) - point).cross(p) +
                 from_bullet(b.localDirToWorld(i, to_bullet(Vec3(inertia.cwiseProduct(from_bullet(omega[i + 1]))))));
    }
    const Vec6 momentum = MultibodyTree(b).momentum(point) * coordinate_velocities(b);
    EXPECT_LT((momentum.head<3>() - linear).norm(), 1e-12);
    EXPECT_LT((momentum.tail<3>() - angular).norm(), 1e-12);
  });
}

/// Bullet's answer to a unit impulse through its contact Jacobian: along `normal` at `point`, fixed to the link.
Eigen::VectorXd bullets_response(btMultiBody& b, int link, const btVector3& point, const btVector3& normal) {
  btAlignedObjectArray<btScalar> r;
  btAlignedObjectArray<btVector3> v;
  btAlignedObjectArray<btMatrix3x3> m;
  b.computeAccelerationsArticulatedBodyAlgorithmMultiDof(0, r, v, m, false, false, false);  // fills Bullet's caches
  std::vector<btScalar> jacobian(6 + b.getNumDofs()), response(6 + b.getNumDofs());
  b.fillContactJacobianMultiDof(link, point, normal, jacobian.data(), r, v, m);
  b.calcAccelerationDeltasMultiDof(jacobian.data(), response.data(), r, v);
  return Eigen::Map<Eigen::Matrix<btScalar, -1, 1>>(response.data(), response.size()).cast<double>();
}

TEST(MultibodyTree, AnswersAnImpulseAsBulletsArticulatedBodyAlgorithm) {
  for_all_cases([](btMultiBody& b, int link) {
    const MultibodyTree tree(b);
    const Vec3 lever(0.2, -0.1, 0.3);
    for (int axis = 0; axis < 3; ++axis) {
      Vec6 impulse;
      impulse << Vec3::Unit(axis), lever.cross(Vec3::Unit(axis));
      const Eigen::VectorXd expected =
          bullets_response(b, link, to_bullet(Vec3(tree.position(link) + lever)), to_bullet(Vec3::Unit(axis)));
      EXPECT_LT((tree.response(link) * impulse - expected).norm(), 1e-12 * (1 + expected.norm()));
    }
  });
}

/// Two bodies in maximal coordinates, twelve velocities held together by the five conditions of a hinge.
Mat6 mobility_on_a_hinge(const MultibodyTree& tree, const Vec3& pivot, const Vec3& axis) {
  using Mat12 = Eigen::Matrix<double, 12, 12>;
  const auto cross = [](const Vec3& a) {
    Mat3 m;
    for (int k = 0; k < 3; ++k) m.col(k) = a.cross(Vec3::Unit(k));
    return m;
  };
  Mat12 mass = Mat12::Zero();
  for (const int link : {-1, 0}) {
    const Mat3 R = tree.orientation(link).toRotationMatrix();
    const int at = 6 * (link + 1);
    mass.block<3, 3>(at, at) = (link < 0 ? kBaseMass : kLinkMass) * Mat3::Identity();
    mass.block<3, 3>(at + 3, at + 3) = R * (link < 0 ? kBaseInertia : kLinkInertia).asDiagonal() * R.transpose();
  }
  Eigen::Matrix<double, 5, 12> held = Eigen::Matrix<double, 5, 12>::Zero();
  held.topRows<3>() << Mat3::Identity(), -cross(pivot - tree.position(-1)), -Mat3::Identity(),
      cross(pivot - tree.position(0));
  const Vec3 across = axis.unitOrthogonal(), third = axis.cross(across);
  for (int k = 0; k < 2; ++k) {
    held.row(3 + k).segment<3>(3) = (k == 0 ? across : third).transpose();
    held.row(3 + k).segment<3>(9) = -(k == 0 ? across : third).transpose();
  }
  Eigen::Matrix<double, 17, 17> system = Eigen::Matrix<double, 17, 17>::Zero();
  system << mass, held.transpose(), held, Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 17, 6> loads = Eigen::Matrix<double, 17, 6>::Zero();
  loads.block<6, 6>(6, 0).setIdentity();
  return system.fullPivLu().solve(loads).block<6, 6>(6, 0);
}

TEST(MultibodyTree, MobilityOnAHingeIsThatOfTheConstrainedEquations) {
  const auto b = chain({setup_revolute}, false);
  const MultibodyTree tree(*b);
  const btMultibodyLink& link = b->getLink(0);
  const Vec3 pivot = from_bullet(b->localPosToWorld(-1, link.m_eVector));
  const Vec3 axis = from_bullet(b->localDirToWorld(0, link.getAxisTop(0)));
  const Mat6 mobility = tree.jacobian(0) * tree.response(0), expected = mobility_on_a_hinge(tree, pivot, axis);
  EXPECT_LT((mobility - expected).norm(), 1e-13 * expected.norm());
}

TEST(MultibodyTree, AFixedBaseDoesNotAnswer) {
  const auto b = chain({setup_revolute}, true);
  EXPECT_TRUE(MultibodyTree(*b).response(0).topRows<6>().isZero(0));
  EXPECT_TRUE(MultibodyTree(*b).response(-1).isZero(0));
}

}  // namespace
}  // namespace nilas
