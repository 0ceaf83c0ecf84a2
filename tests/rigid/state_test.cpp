#include "rigid/state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace nilas::rigid {
namespace {

using std::numbers::pi;

const Vec3 asymmetric(1, 2, 3);  // kg m2
const Vec3 true_hcc = from_density(Hcc{1.8, 0.3, 0.2}, 1500).inertia;

State spinning(const Vec3& inertia, const Vec3& angular_velocity, const Quat& orientation = Quat::Identity()) {
  State state;
  state.orientation = orientation;
  state.angular_momentum = angular_momentum_world(orientation, inertia, angular_velocity);
  return state;
}

Vec3 angular_velocity_body(const State& state, const Vec3& inertia) {
  return state.orientation.conjugate() * angular_velocity_world(state, inertia);
}

void fly(State& state, const Vec3& inertia, double time, int steps) {
  for (int i = 0; i < steps; ++i) drift(state, 1, inertia, time / steps);
}

double angle_between(const Quat& a, const Quat& b) { return a.angularDistance(b); }

/// Oracle: Euler's equations and the quaternion's kinematics by classical Runge-Kutta, body frame.
struct Top {
  Vec3 omega;
  Quat orientation;
};
Top runge_kutta(Top top, const Vec3& inertia, double time, int steps) {
  using Vec7 = Eigen::Matrix<double, 7, 1>;
  const auto rate = [&](const Vec7& y) {
    const Vec3 w = y.head<3>();
    const Quat q(y[3], y[4], y[5], y[6]);
    const Quat dq = q * Quat(0, w.x(), w.y(), w.z());
    const Vec3 dw = Vec3(inertia.cwiseProduct(w)).cross(w).cwiseQuotient(inertia);
    Vec7 f;
    f << dw, 0.5 * dq.w(), 0.5 * dq.x(), 0.5 * dq.y(), 0.5 * dq.z();
    return f;
  };
  Vec7 y;
  y << top.omega, top.orientation.w(), top.orientation.x(), top.orientation.y(), top.orientation.z();
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const Vec7 k1 = rate(y), k2 = rate(y + h / 2 * k1), k3 = rate(y + h / 2 * k2), k4 = rate(y + h * k3);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return {y.head<3>(), Quat(y[3], y[4], y[5], y[6]).normalized()};
}

struct Sample {
  double time;
  Vec3 omega_body;
};
// Verification problem V37, Jacobi's elliptic functions.
const std::vector<Sample> euler_top = {{1, {-0.1266429229, 1.408531707, 0.8197638745}},
                                       {2, {-1.199580742, 0.7490033661, 1.070668632}},
                                       {5, {1.007980331, -0.9919554689, 1.002667168}},
                                       {10, {-0.6034704231, -1.278993139, 0.8877267882}}};
// Verification problem V38.
const std::vector<Sample> dzhanibekov = {{2, {-1.16125006, 4.863290892, 0.6704977507}},
                                         {3, {-3.868141808, -3.168213842, 2.23328764}},
                                         {5, {-0.0113256939, -4.999997173, 0.01046058}},
                                         {10, {0.01271487063, 4.999993833, 0.01097979865}}};

TEST(EulerTop, FollowsJacobisSolution) {
  for (const auto& [time, omega_body] : euler_top) {
    State state = spinning(asymmetric, {1, 1, 1});
    fly(state, asymmetric, time, static_cast<int>(std::lround(time / 1e-3)));
    EXPECT_LT((angular_velocity_body(state, asymmetric) - omega_body).norm(), 1e-4) << "t = " << time;
  }
}

TEST(EulerTop, ConvergesAtSecondOrder) {
  for (const auto& [time, omega_body] : euler_top) {
    std::vector<double> errors;
    for (const double dt : {4e-3, 2e-3, 1e-3}) {
      State state = spinning(asymmetric, {1, 1, 1});
      fly(state, asymmetric, time, static_cast<int>(std::lround(time / dt)));
      errors.push_back((angular_velocity_body(state, asymmetric) - omega_body).norm());
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.05) << "t = " << time;
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.05) << "t = " << time;
  }
}

// The angular velocity in the body frame does not see the angle about L: the orientation needs its own oracle.
TEST(EulerTop, OrientationConvergesToThatOfRungeKuttaAtSecondOrder) {
  const Quat start(Eigen::AngleAxisd(0.7, Vec3(1, -2, 0.5).normalized()));
  const Vec3 omega_body(1, 1, 1);
  const Top expected = runge_kutta({omega_body, start}, asymmetric, 3, 30000);
  std::vector<double> errors;
  for (const int steps : {750, 1500, 3000}) {
    State state = spinning(asymmetric, start * omega_body, start);
    fly(state, asymmetric, 3, steps);
    errors.push_back(angle_between(state.orientation, expected.orientation));
  }
  EXPECT_LT(errors.back(), 1e-4);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.05);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.05);
}

TEST(EulerTop, KeepsAngularMomentumExactlyAndEnergyWithoutDrift) {
  State state = spinning(asymmetric, {1, 1, 1});
  const Vec3 momentum = state.angular_momentum;
  EXPECT_NEAR(momentum.squaredNorm(), 14, 1e-14);
  double early = 0, late = 0;
  for (int i = 0; i < 100000; ++i) {
    drift(state, 1, asymmetric, 1e-3);
    const double error = std::abs(kinetic_energy(state, 1, asymmetric) / 3 - 1);
    (i < 10000 ? early : late) = std::max(i < 10000 ? early : late, error);
  }
  EXPECT_EQ(state.angular_momentum, momentum);
  const Vec3 rebuilt = angular_momentum_world(state.orientation, asymmetric, angular_velocity_world(state, asymmetric));
  EXPECT_LT((rebuilt - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LT(early, 1e-6);
  EXPECT_LT(late, 1.5 * early);  // bounded, as of a symplectic method
}

TEST(EulerTop, RunsBackToItsStart) {
  State state = spinning(asymmetric, {1, -2, 0.3});
  state.momentum = {3, 4, 5};
  const State start = state;
  fly(state, asymmetric, 5, 500);
  fly(state, asymmetric, -5, 500);
  EXPECT_LT(angle_between(state.orientation, start.orientation), 1e-12);
  EXPECT_LT((state.position - start.position).norm(), 1e-12);
}

TEST(EulerTop, OrientationStaysAUnitQuaternion) {
  State state = spinning(asymmetric, {1, 5, 0.01});
  fly(state, asymmetric, 1000, 100000);
  EXPECT_NEAR(state.orientation.norm(), 1, 4e-16);
}

TEST(Dzhanibekov, FollowsJacobisSolution) {
  for (const auto& [time, omega_body] : dzhanibekov) {
    State state = spinning(asymmetric, {0.01, 5, 0.01});
    fly(state, asymmetric, time, static_cast<int>(std::lround(time / 1e-4)));
    EXPECT_LT((angular_velocity_body(state, asymmetric) - omega_body).norm(), 1e-3) << "t = " << time;
  }
}

TEST(Dzhanibekov, FlipsAfterHalfAPeriod) {
  State state = spinning(asymmetric, {0.01, 5, 0.01});
  const double dt = 1e-3;
  std::vector<double> crossings;
  double before = 5;
  for (int i = 1; crossings.size() < 3; ++i) {
    ASSERT_LT(i, 100000);
    drift(state, 1, asymmetric, dt);
    const double now = angular_velocity_body(state, asymmetric).y();
    if (before * now < 0) crossings.push_back(dt * (i - now / (now - before)));
    before = now;
  }
  EXPECT_NEAR(crossings[1] - crossings[0], 5.025929138, 1e-3);
  EXPECT_NEAR(crossings[2] - crossings[1], 5.025929138, 1e-3);
}

// Verification problem V39.
TEST(SymmetricTop, OfTheHccNutatesAsInClosedFormWhateverTheStep) {
  const double rate = (true_hcc.x() - true_hcc.z()) / true_hcc.x() * 100;
  EXPECT_NEAR(rate, 95.69005, 0.5e-5);
  const Vec3 exact(std::cos(rate), -std::sin(rate), 100);
  EXPECT_LT((exact - Vec3(0.12817265, -0.99175187, 100)).norm(), 0.5e-5);  // no closer than the rate is given
  for (const int steps : {1, 7, 1000, 100000}) {
    State state = spinning(true_hcc, {1, 0, 100});
    fly(state, true_hcc, 1, steps);
    EXPECT_LT((angular_velocity_body(state, true_hcc) - exact).norm(), 1e-9) << steps;
  }
}

TEST(SymmetricTop, OfTheHccPrecessesAboutItsAngularMomentum) {
  State state = spinning(true_hcc, {1, 0, 100});
  const Vec3 about = state.angular_momentum.normalized();
  const double rate = state.angular_momentum.norm() / true_hcc.x();
  EXPECT_NEAR(rate, 4.42444, 0.5e-5);
  EXPECT_NEAR(std::acos(about.z()) * 180 / pi, 13.0627, 0.5e-4);
  const double dt = 1e-3;
  for (int i = 1; i <= 1000; ++i) {
    drift(state, 1, true_hcc, dt);
    const Vec3 expected = Eigen::AngleAxisd(rate * dt * i, about) * Vec3::UnitZ();
    ASSERT_LT((state.orientation * Vec3::UnitZ() - expected).norm(), 1e-11) << i;
  }
}

TEST(SymmetricTop, HasTheOrientationOfRungeKuttaAboutAnyAxis) {
  const Quat start(Eigen::AngleAxisd(1.1, Vec3(-1, 0.3, 2).normalized()));
  const Vec3 omega_body(0.4, -1.5, 2.5);
  for (const Vec3& inertia : {Vec3(2, 2, 0.7), Vec3(2, 0.7, 2), Vec3(0.7, 2, 2), Vec3(1, 1, 1.9), Vec3(2, 2, 2)}) {
    const Top expected = runge_kutta({omega_body, start}, inertia, 2, 20000);
    State state = spinning(inertia, start * omega_body, start);
    fly(state, inertia, 2, 1);
    EXPECT_LT(angle_between(state.orientation, expected.orientation), 1e-10) << inertia.transpose();
  }
}

TEST(SymmetricTop, IsTheLimitOfTheSplittingForNearlyEqualMoments) {
  const Vec3 equal(2, 2, 0.7), nearly(2, 2 * (1 + 1e-11), 0.7);
  State a = spinning(equal, {0.4, -1.5, 2.5}), b = a;
  fly(a, equal, 1, 20000);
  fly(b, nearly, 1, 20000);
  EXPECT_LT(angle_between(a.orientation, b.orientation), 1e-6);
}

// Verification problem V36: impulse J at the arm d from the centre of mass.
TEST(OffCentreImpulse, TurnsTheBodyAboutItsInstantaneousCentre) {
  const MassProperties mass = from_density(Hcc{1.8, 0.3, 0.2}, 1500);
  const Quat upright = orientation_along({0, 0, 1});
  State state;
  state.orientation = upright;
  const double d = 0.83, impulse = 250;
  const Vec3 arm(0, 0, d), J(0, impulse, 0);
  kick(state, J, arm.cross(J));
  const Vec3 v = velocity(state, mass.mass), w = angular_velocity_world(state, mass.inertia);
  EXPECT_LT((v - Vec3(0, impulse / mass.mass, 0)).norm(), 1e-12 * v.norm());
  EXPECT_LT((w - Vec3(-impulse * d / mass.inertia.x(), 0, 0)).norm(), 1e-12 * w.norm());
  const double behind = mass.inertia.x() / (mass.mass * d);
  EXPECT_NEAR(behind, 0.310, 0.0005);
  EXPECT_LT((v + w.cross(Vec3(0, 0, -behind))).norm(), 1e-12 * v.norm());
  EXPECT_NEAR(kinetic_energy(state, mass.mass, mass.inertia),
              0.5 * impulse * impulse * (1 / mass.mass + d * d / mass.inertia.x()), 1e-12 * impulse * impulse);
}

// Verification problem V40: constant force, constant torque about a principal axis.
TEST(ConstantLoad, GivesTheClosedFormUnderKickDriftKick) {
  const Vec3 force(3, -2, 7), inertia(1, 2, 3);
  const double mass = 4, torque = 0.6, time = 2;
  const int steps = 50;
  const double dt = time / steps;
  for (int axis = 0; axis < 3; ++axis) {
    const Quat start(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()));
    const Vec3 direction = start * Vec3::Unit(axis);
    State state;
    state.orientation = start;
    state.momentum = {1, 2, 3};
    for (int i = 0; i < steps; ++i) {
      kick(state, 0.5 * dt * force, 0.5 * dt * torque * direction);
      drift(state, mass, inertia, dt);
      kick(state, 0.5 * dt * force, 0.5 * dt * torque * direction);
    }
    const Vec3 position = time / mass * Vec3(1, 2, 3) + 0.5 * time * time / mass * force;
    const Quat turned = Quat(Eigen::AngleAxisd(0.5 * torque / inertia[axis] * time * time, direction)) * start;
    EXPECT_LT((state.position - position).norm(), 1e-10);
    EXPECT_LT(angle_between(state.orientation, turned), 1e-10);
    EXPECT_LT((angular_velocity_world(state, inertia) - torque * time / inertia[axis] * direction).norm(), 1e-10);
    EXPECT_LT((velocity(state, mass) - Vec3((Vec3(1, 2, 3) + time * force) / mass)).norm(), 1e-10);
  }
}

TEST(Drift, OfABodyWithoutAngularMomentumOnlyTranslates) {
  State state;
  state.orientation = orientation_along(Vec3(0, 0.6, 0.8));
  state.momentum = {10, 20, 30};
  const State start = state;
  drift(state, 10, asymmetric, 0.5);
  EXPECT_LT((state.position - Vec3(0.5, 1, 1.5)).norm(), 1e-15);
  EXPECT_LT((state.orientation.coeffs() - start.orientation.coeffs()).norm(), 1e-15);
  EXPECT_EQ(state.momentum, start.momentum);
}

TEST(AngularMomentum, AndAngularVelocityAreInverse) {
  const Quat orientation(Eigen::AngleAxisd(2.1, Vec3(1, -1, 0.2).normalized()));
  const Vec3 omega(0.3, -7, 2);
  EXPECT_LT((angular_velocity_world(spinning(asymmetric, omega, orientation), asymmetric) - omega).norm(), 1e-14);
  const Mat3 R = orientation.toRotationMatrix();
  const Vec3 expected = R * asymmetric.asDiagonal() * R.transpose() * omega;
  EXPECT_LT((angular_momentum_world(orientation, asymmetric, omega) - expected).norm(), 1e-13);
}

TEST(OrientationAlong, TurnsZIntoTheAxisByTheShortestArc) {
  std::vector<Vec3> axes = {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {0, -0.5, std::sqrt(0.75)}, {0.48, 0.6, -0.64}};
  for (const double tilt : {1e-3, 1e-7, 1e-9, 1e-15, 1e-100}) {
    axes.push_back(Vec3(tilt, -2 * tilt, 1).normalized());
    axes.push_back(Vec3(tilt, -2 * tilt, -1).normalized());
  }
  for (const Vec3& axis : axes) {
    const Quat q = orientation_along(axis);
    EXPECT_NEAR(q.norm(), 1, 1e-15) << axis.transpose();
    EXPECT_LT((q * Vec3::UnitZ() - axis).norm(), 1e-15) << axis.transpose();
    EXPECT_EQ(q.z(), 0) << axis.transpose();  // no turn about z: the shortest arc
    EXPECT_GE(q.w(), 0) << axis.transpose();
  }
}

TEST(OrientationAlong, MinusZIsAHalfTurnAboutX) {
  const Quat q = orientation_along({0, 0, -1});
  EXPECT_EQ(q * Vec3::UnitX(), Vec3(1, 0, 0));
  EXPECT_EQ(q * Vec3::UnitY(), Vec3(0, -1, 0));
  EXPECT_EQ(q * Vec3::UnitZ(), Vec3(0, 0, -1));
}

}  // namespace
}  // namespace nilas::rigid
