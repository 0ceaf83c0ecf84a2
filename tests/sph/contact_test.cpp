#include "sph/contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sph/ice.hpp"
#include "tests/support/particle_clouds.hpp"
#include "tests/support/surfaces.hpp"

namespace nilas::sph {
namespace {

using test::particles_at;
using test::plane;
using test::plate;
using test::Random;

constexpr double dx = 0.02, boundary_dx = 0.015;      // m
constexpr double M = 13.8978e9, impedance = 3.537e6;  // Pa, Pa s/m: K + 4G/3 and rho c_p of the ice

ContactConstants constants(double friction = 0, bool stick = false) {
  ContactSpec spec;
  spec.friction_coefficient = friction;
  spec.stick = stick;
  return {spec, ElasticConstants(MaterialSpec{}), dx};
}

struct Result {
  Vec3 force;  // N, on the ice particle
  double penetration;
};
/// Force on one ice particle of this position and velocity.
Result push(Surface surface, const Vec3& position, const Vec3& velocity = Vec3::Zero(),
            const ContactConstants& k = constants()) {
  Particles p = particles_at({position}, dx);
  p.motion[0].velocity = velocity;
  Contact contact(k, surface.spacing, 0.1 * dx);
  contact.apply(p, surface);
  return {p.mass * p.acceleration[0], contact.penetration()};
}

TEST(ContactForce, IsThePenaltyOfTheGapBelowHalfASpacing) {
  const Surface s = plane(0, 21, boundary_dx);
  for (const double gap : {0.49, 0.3, 0.1, 0.0, -0.2, -0.9}) {
    const Vec3 f = push(s, {0.003, -0.002, gap * dx}).force;
    EXPECT_NEAR(f[2] / (0.2 * M * dx * (0.5 - gap) * dx), 1, 1e-4) << gap;
    EXPECT_LT(f.head<2>().norm(), 1e-12 * f.norm());
  }
  for (const double gap : {0.5, 0.51, 1.0, 3.0}) EXPECT_EQ(push(s, {0.003, -0.002, gap * dx}).force, Vec3::Zero());
}

TEST(ContactForce, OnACurvedSurfaceIsThatOfTheTrueGap) {
  // Radius of the HCC's nose tip, 5.6 spacings. Gaps to the tangent planes of the boundary particles would be 7 % of
  // half a spacing too small here.
  const double radius = 5.625 * dx;
  const Surface s = test::sphere(Vec3::Zero(), radius, boundary_dx);
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0.6, 0, 0.8), Vec3(-0.48, 0.64, 0.6)}) {
    const Vec3 f = push(s, radius * direction).force;
    EXPECT_NEAR(f.norm() / (0.2 * M * dx * 0.5 * dx), 1, 0.01);
    EXPECT_LT(f.cross(direction).norm(), 0.03 * f.norm());
  }
}

TEST(ContactForce, HasFrictionWithoutNormalDamping) {
  ContactSpec spec;
  spec.damping = 0;
  spec.friction_coefficient = 0.3;
  const ContactConstants k(spec, ElasticConstants(MaterialSpec{}), dx);
  const Vec3 f = push(plane(0, 21, boundary_dx), {0, 0, 0.2 * dx}, {1000, 0, 0}, k).force;
  EXPECT_NEAR(-f[0] / f[2], 0.3, 1e-9);
}

TEST(ContactForce, IsDampedAgainstApproachWithTheImpedance) {
  const Surface s = plane(0, 21, boundary_dx);
  const Vec3 x(0, 0, 0.3 * dx);
  const double static_force = push(s, x).force[2], speed = 2;
  const double approaching = push(s, x, {0, 0, -speed}).force[2];
  EXPECT_NEAR((approaching - static_force) / (0.4 * impedance * dx * dx * speed), 1, 1e-3);
}

TEST(ContactForce, DependsOnRelativeVelocityOnly) {
  Surface s = plane(0, 21, boundary_dx);
  const Vec3 x(0, 0, 0.3 * dx), v(3, -1, -2), frame(100, 200, -300);
  const Vec3 before = push(s, x, v, constants(0.1)).force;
  test::set_velocity(s, frame);
  EXPECT_LT((push(s, x, v + frame, constants(0.1)).force - before).norm(), 1e-9 * before.norm());
}

TEST(ContactForce, NeverPulls) {
  const Surface s = plane(0, 21, boundary_dx);
  for (const double gap : {0.45, 0.2, -0.3})
    for (const double speed : {0.01, 1.0, 10.0, 1000.0})
      EXPECT_GE(push(s, {0, 0, gap * dx}, {0, 0, speed}).force[2], 0) << gap << " " << speed;
  EXPECT_EQ(push(s, {0, 0, 0.4 * dx}, {1, 2, 1000}, constants(0.5)).force, Vec3::Zero());
}

TEST(ContactForce, IsUniformOverTheInsideOfASurface) {
  const Surface s = plane(0, 31, boundary_dx);
  Random random(1);
  const double centre = push(s, {0, 0, 0.2 * dx}).force[2];
  for (int n = 0; n < 200; ++n) {
    const Vec3 x = 10 * boundary_dx * random.vector();
    EXPECT_NEAR(push(s, {x[0], x[1], 0.2 * dx}).force[2] / centre, 1, 1e-12);
  }
}

TEST(ContactFriction, OpposesTheSlipAndIsBoundedByTheNormalForce) {
  const Surface s = plane(0, 21, boundary_dx);
  for (const double mu : {0.05, 0.3, 1.0})
    for (const double speed : {1e-4, 0.01, 1.0, 100.0}) {
      const Vec3 direction = Vec3(3, -4, 0) / 5;
      const Vec3 f = push(s, {0, 0, 0.49 * dx}, speed * direction, constants(mu)).force;
      const Vec3 tangential(f[0], f[1], 0);
      EXPECT_LE(tangential.norm(), mu * f[2] * (1 + 1e-12));
      EXPECT_NEAR(tangential.normalized().dot(direction), -1, 1e-12);
    }
  const Vec3 fast = push(s, {0, 0, 0.499 * dx}, {100, 0, 0}, constants(0.3)).force;
  EXPECT_NEAR(-fast[0] / fast[2], 0.3, 1e-12);
}

TEST(ContactFriction, IsProportionalToSlowSlipAndZeroAtRest) {
  const Surface s = plane(0, 21, boundary_dx);
  const double slow = push(s, {0, 0, 0.2 * dx}, {1e-3, 0, 0}, constants(0.3)).force[0];
  const double rho_c_s = 900 * 1979.4;
  EXPECT_NEAR(slow / (-0.4 * rho_c_s * dx * dx * 1e-3), 1, 1e-4);
  EXPECT_EQ(push(s, {0, 0, 0.2 * dx}, {0, 0, -1}, constants(0.3)).force[0], 0);
}

TEST(ContactFriction, StickHasNoBound) {
  const Surface s = plane(0, 21, boundary_dx);
  const Vec3 slow = push(s, {0, 0, 0.499 * dx}, {1, 0, 0}, constants(0, true)).force;
  const Vec3 fast = push(s, {0, 0, 0.499 * dx}, {500, 0, 0}, constants(0, true)).force;
  EXPECT_NEAR(fast[0] / slow[0], 500, 1e-9);
  EXPECT_GT(-fast[0], 10 * fast[2]);
  EXPECT_EQ(push(s, {0, 0, 0.6 * dx}, {500, 0, 0}, constants(0, true)).force, Vec3::Zero());  // out of touch
}

TEST(ContactFriction, FrictionlessContactIsNormalOnly) {
  const Vec3 f = push(plane(0, 21, boundary_dx), {0, 0, 0.2 * dx}, {50, -70, -1}).force;
  EXPECT_GT(f[2], 0);
  EXPECT_LT(f.head<2>().norm(), 1e-12 * f[2]);
}

/// Random ice over and in a sphere, both moving.
struct Crowd {
  Particles ice;
  Surface surface = test::sphere({0.3, -0.2, 5}, 0.15, boundary_dx);
  Contact contact{constants(0.2), boundary_dx, 0.1 * dx};

  Crowd() {
    Random random(2);
    std::vector<Vec3> x;
    for (int n = 0; n < 2000; ++n)
      x.push_back(surface.reference + (0.15 + dx * random()) * random.vector().normalized());
    ice = particles_at(x, dx);
    test::disturb(ice, 30, 0);
    test::set_velocity(surface, {10, -20, 30});
    surface.reference = {1, 2, 3};
    contact.apply(ice, surface);
  }
};

TEST(ContactMomentum, ForcesOnIceAndBoundaryAreEqualAndOpposite) {
  const Crowd c;
  Vec3 on_ice = Vec3::Zero(), by_acceleration = Vec3::Zero(), on_boundary = Vec3::Zero();
  double scale = 0;
  for (const ContactForce& f : c.contact.forces()) on_ice += f.force, scale += f.force.norm();
  for (const Vec3& a : c.ice.acceleration) by_acceleration += c.ice.mass * a;
  for (const BoundaryParticle& b : c.surface.particles) on_boundary += b.force;
  ASSERT_GT(c.contact.forces().size(), 500u);
  EXPECT_LT((on_ice + c.surface.force).norm(), 1e-14 * scale);
  EXPECT_LT((by_acceleration + c.surface.force).norm(), 1e-14 * scale);
  EXPECT_LT((on_boundary - c.surface.force).norm(), 1e-14 * scale);
}

TEST(ContactMomentum, MomentOnTheBodyIsOppositeToThatOnTheIce) {
  const Crowd c;
  Vec3 moment = Vec3::Zero();
  double scale = 0;
  for (std::size_t i = 0; i < c.ice.size(); ++i) {
    const Vec3 m = (c.ice.motion[i].position - c.surface.reference).cross(c.ice.mass * c.ice.acceleration[i]);
    moment += m;
    scale += m.norm();
  }
  EXPECT_LT((moment + c.surface.moment).norm(), 1e-14 * scale);
  EXPECT_GT(c.surface.moment.norm(), 1e-3 * scale);
}

TEST(ContactMomentum, ForcesAreWrittenAnewByEveryCall) {
  Crowd c;
  const Vec3 force = c.surface.force, moment = c.surface.moment, first = c.surface.particles[0].force;
  for (Vec3& a : c.ice.acceleration) a.setZero();
  c.contact.apply(c.ice, c.surface);
  EXPECT_EQ(c.surface.force, force);
  EXPECT_EQ(c.surface.moment, moment);
  EXPECT_EQ(c.surface.particles[0].force, first);
  for (Motion& m : c.ice.motion) m.position += Vec3(100, 0, 0);
  c.contact.invalidate();
  c.contact.apply(c.ice, c.surface);
  EXPECT_EQ(c.surface.force, Vec3::Zero());
  EXPECT_EQ(c.surface.moment, Vec3::Zero());
  EXPECT_TRUE(c.contact.forces().empty());
  for (const BoundaryParticle& b : c.surface.particles) EXPECT_EQ(b.force, Vec3::Zero());
}

TEST(ContactMomentum, OtherContributionsToTheAccelerationAreKept) {
  Crowd c;
  const std::vector<Vec3> alone = c.ice.acceleration;
  for (Vec3& a : c.ice.acceleration) a = Vec3(1, 2, 3);
  c.contact.apply(c.ice, c.surface);
  for (std::size_t i = 0; i < alone.size(); ++i)
    EXPECT_LT((c.ice.acceleration[i] - alone[i] - Vec3(1, 2, 3)).norm(), 1e-12 * (1 + alone[i].norm()));
}

/// Ice above and, down to the depth from which it is still pushed back, below a plane; found before it moves.
struct Layer {
  Particles ice;
  Surface surface = plane(0, 41, boundary_dx);
  Contact contact{constants(0.2), boundary_dx, 0.1 * dx};

  Layer() {
    Random random(5);
    std::vector<Vec3> x;
    for (int n = 0; n < 3000; ++n) {
      const Vec3 r = random.vector();
      x.emplace_back(0.32 * r[0], 0.32 * r[1], dx * (-0.75 + 1.3 * r[2]));
    }
    ice = particles_at(x, dx);
    contact.apply(ice, surface);
  }
};

TEST(ContactSearch, CandidatesStayValidWhileIceAndSurfaceMoveWithinTheSkin) {
  Layer moved, fresh;
  const double skin = 0.1 * dx;
  Random random(3);
  for (std::size_t i = 0; i < moved.ice.size(); ++i) {
    const Vec3 step = 0.49 * skin * random.vector().normalized();
    moved.ice.motion[i].position += step, fresh.ice.motion[i].position += step;
  }
  const auto forces = [&](Layer& c, bool anew) {
    test::move(c.surface, 0.7 * skin * Vec3(1, 0.5, -0.5));
    if (anew) c.contact.invalidate();
    for (Vec3& a : c.ice.acceleration) a.setZero();
    c.contact.apply(c.ice, c.surface);
    return c.ice.acceleration;
  };
  const auto a = forces(moved, false), b = forces(fresh, true);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i] - b[i]).norm(), 1e-12 * (1 + b[i].norm()));
}

TEST(ContactSearch, SurfaceThatMovedFartherThanTheSkinIsFoundAgain) {
  Surface s = plane(0, 21, boundary_dx);
  Particles p = particles_at({{0, 0, 1}}, dx);
  Contact contact(constants(), boundary_dx, 0.1 * dx);
  contact.apply(p, s);
  EXPECT_TRUE(contact.forces().empty());
  test::move(s, {0, 0, 1 - 0.2 * dx});
  contact.apply(p, s);
  EXPECT_EQ(contact.forces().size(), 1u);
}

// Thinner than two spacings: an ice particle at one face is within reach of the other.
TEST(ThinPlate, FarFaceHasNoSay) {
  for (const double thickness : {0.05, 0.5, 1.0, 1.9}) {
    const Surface both = plate(thickness * dx, 21, boundary_dx);
    const Surface upper = plane(0.5 * thickness * dx, 21, boundary_dx);
    for (const double gap : {0.4, 0.1, 0.0}) {
      const double z = 0.5 * thickness * dx + gap * dx;
      const Vec3 above = push(both, {0.004, 0.001, z}).force, below = push(both, {0.004, 0.001, -z}).force;
      EXPECT_GT(above[2], 0);
      EXPECT_LT((above - push(upper, {0.004, 0.001, z}).force).norm(), 1e-12 * above.norm());
      EXPECT_NEAR(above[2], -below[2], 1e-9 * above[2]);
    }
  }
}

TEST(ThinPlate, ParticleInsideIsPushedOutByTheNearerFace) {
  const Surface both = plate(dx, 21, boundary_dx);
  for (const double z : {0.05, 0.2, 0.4}) {
    EXPECT_GT(push(both, {0.004, 0.001, z * dx}).force[2], 0);
    EXPECT_LT(push(both, {0.004, 0.001, -z * dx}).force[2], 0);
  }
}

TEST(ContactEdge, ForceFadesMonotonicallyAndContinuouslyPastAnEdge) {
  const Surface s = plane(0, 21, boundary_dx);
  const double edge = 10 * boundary_dx;  // last boundary particles
  const double inside = push(s, {0, 0, 0.2 * dx}).force[2];
  double before = inside;
  for (double past = -0.5 * boundary_dx; past < 3 * boundary_dx; past += 0.01 * boundary_dx) {
    const double f = push(s, {edge + past, 0, 0.2 * dx}).force[2];
    EXPECT_LE(f, before * (1 + 1e-12));
    EXPECT_GT(f, before - 0.03 * inside);
    before = f;
    if (past <= 0) {
      EXPECT_GT(f, 0.97 * inside);
    }
    if (past > 2.4 * boundary_dx) {
      EXPECT_EQ(f, 0);
    }
  }
}

TEST(ContactPenetration, IsTheDeepestCentreBehindTheSurface) {
  const Surface s = plane(0, 21, boundary_dx);
  EXPECT_EQ(push(s, {0, 0, 0.3 * dx}).penetration, 0);
  EXPECT_NEAR(push(s, {0, 0, -0.3 * dx}).penetration, 0.3 * dx, 1e-12);
  Surface two = s;
  Particles p = particles_at({{0, 0, -0.1 * dx}, {0.05, 0, -0.4 * dx}, {-0.05, 0, 0.1 * dx}}, dx);
  Contact contact(constants(), boundary_dx, 0.1 * dx);
  contact.apply(p, two);
  EXPECT_NEAR(contact.penetration(), 0.4 * dx, 1e-12);
}

/// Smallest gap between an ice-particle centre and a ball that is pushed up through a sheet of four layers.
double closest_approach(const MaterialSpec& material, double speed) {
  const test::Threads one(1);  // too small to share
  const double radius = 3 * dx;
  IceSpec spec;
  PieceSpec sheet;
  sheet.shape = IceShape::block;
  sheet.size = {16 * dx, 16 * dx, 4 * dx};
  sheet.fixed.faces = {true, true, true, true, false, false};
  spec.pieces = {sheet};
  spec.spacing = dx;
  spec.material = material;
  std::vector<Surface> ball{test::sphere({0.003, 0.002, -2.6 * dx - radius}, radius, boundary_dx)};
  test::set_velocity(ball[0], {0, 0, speed});
  Ice ice(spec, ball);
  double closest = radius, touched = 0;
  for (double travelled = 0; travelled < 10 * dx;) {
    const double dt = ice.stable_step().dt;
    ice.drift(dt / 2);
    test::move(ball[0], {0, 0, speed * dt / 2});
    ice.interact(ball, dt);
    touched = std::max(touched, ball[0].force.norm());
    ice.kick(dt);
    ice.drift_and_differentiate(dt / 2);
    test::move(ball[0], {0, 0, speed * dt / 2});
    travelled += speed * dt;
    for (const Motion& m : ice.particles().motion)
      closest = std::min(closest, (m.position - ball[0].reference).norm() - radius);
  }
  EXPECT_GT(touched, 1e4);
  return closest;
}

TEST(ContactPenetration, BallPushedThroughASheetLetsNoParticleCentreIn) {
  MaterialSpec fluid, plastic;
  plastic.after_failure = AfterFailure::plastic;
  EXPECT_GT(closest_approach(fluid, 100), 0);
  EXPECT_GT(closest_approach(fluid, 200), 0);
  EXPECT_GT(closest_approach(plastic, 100), 0);
}

}  // namespace
}  // namespace nilas::sph
