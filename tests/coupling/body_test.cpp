#include "coupling/body.hpp"

#include <gtest/gtest.h>

#include <random>

#include "sph/ice.hpp"
#include "tests/coupling/small_impact.hpp"

namespace nilas {
namespace {

using rigid::Motion;
using rigid::Quat;

const Vec3 kAll(1, 1, 1), kNone(0, 0, 0);

/// A body in general position: three different moments, turned, moving and spinning about no principal axis.
rigid::BodySpec tumbling_box(Motion motion = Motion::free) {
  rigid::BodySpec spec;
  spec.name = "box";
  spec.shape = rigid::Box{Vec3(0.4, 0.6, 1.0)};
  spec.boundary_spacing = 0.1;
  spec.mass = rigid::from_density(spec.shape, 500);
  spec.motion = motion;
  spec.position = Vec3(3, -2, 1);
  spec.orientation = Quat(Eigen::AngleAxisd(0.8, Vec3(1, 2, -0.5).normalized()));
  spec.velocity = Vec3(5, -7, 11);
  spec.angular_velocity = Vec3(2, -1, 3);
  return spec;
}

struct PointForce {
  Vec3 point, force;  // m, N; world frame
};

/// A surface that carries a list of forces, reduced to force and moment about `reference`.
sph::Surface loaded(const Vec3& reference, const std::vector<PointForce>& forces) {
  sph::Surface surface;
  surface.reference = reference;
  for (const PointForce& f : forces) {
    surface.force += f.force;
    surface.moment += (f.point - reference).cross(f.force);
  }
  return surface;
}

class RandomVectors {
 public:
  Vec3 operator()(double size) { return size * Vec3(uniform_(engine_), uniform_(engine_), uniform_(engine_)); }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

Vec3 angular_momentum_about_origin(const Body& body) {
  return body.state().position.cross(body.state().momentum) + body.state().angular_momentum;
}

TEST(PosesIn, BoundaryParticlesLieOnTheTurnedShapeWithItsNormalsAndAreas) {
  for (const rigid::Shape& shape :
       {rigid::Shape(rigid::Hcc{0.6, 0.3, 0.2}), rigid::Shape(rigid::Sphere{0.3}),
        rigid::Shape(rigid::Box{Vec3(0.4, 0.6, 1.0)}), rigid::Shape(rigid::Cylinder{0.5, 0.2})}) {
    rigid::BodySpec spec = tumbling_box();
    spec.shape = shape;
    spec.boundary_spacing = 0.03;
    spec.mass = rigid::from_density(shape, 900);
    spec.mass.centre_of_mass += Vec3(0.01, -0.02, 0.03);
    Body body(spec);
    sph::Surface surface = body.make_surface();
    body.drift(0.3);
    body.place(surface);

    EXPECT_EQ(surface.spacing, spec.boundary_spacing);
    EXPECT_EQ(surface.reference, body.state().position);
    double area = 0;
    for (const sph::BoundaryParticle& b : surface.particles) {
      const Vec3 in_body = body.state().orientation.conjugate() * (b.position - body.state().position);
      const auto closest = rigid::closest_point(shape, in_body + spec.mass.centre_of_mass);
      EXPECT_NEAR(closest.distance, 0, 1e-12) << rigid::name(shape);
      EXPECT_LT((body.state().orientation * closest.normal - b.normal).norm(), 1e-6) << rigid::name(shape);
      area += b.area;
    }
    EXPECT_NEAR(area, rigid::surface_area(shape), 1e-12 * area) << rigid::name(shape);
  }
}

TEST(PosesIn, VelocitiesAreTheRatesOfThePositions) {
  Body body(tumbling_box());
  sph::Surface before = body.make_surface(), now = before, after = before;
  const double dt = 1e-4;
  body.drift(dt);
  body.place(now);
  body.drift(dt);
  body.place(after);
  const double rate = body.angular_velocity().norm();
  // Central difference: error dt^2/6 of the third derivative, at most rate^3 times the lever.
  const double bound = dt * dt / 6 * rate * rate * rate * rigid::enclosing_radius(body.spec().shape, Vec3::Zero()) * 2;
  for (std::size_t b = 0; b < now.particles.size(); ++b) {
    const Vec3 difference = (after.particles[b].position - before.particles[b].position) / (2 * dt);
    EXPECT_LT((difference - now.particles[b].velocity).norm(), bound);
  }
}

TEST(PosesIn, AnUnplacedSurfaceCarriesNoLoad) {
  const sph::Surface surface = Body(tumbling_box()).make_surface();
  EXPECT_TRUE(surface.force.isZero(0) && surface.moment.isZero(0));
  for (const sph::BoundaryParticle& b : surface.particles) EXPECT_TRUE(b.force.isZero(0));
}

// V36.
TEST(LoadsOut, AnOffCentreImpulseTurnsTheHccAboutItsInstantaneousCentre) {
  rigid::BodySpec spec = test::short_hcc(90);
  spec.shape = rigid::Hcc{1.8, 0.3, 0.2};
  spec.mass = rigid::from_density(spec.shape, 1500);
  spec.velocity = Vec3::Zero();
  Body body(spec);
  const double arm = 0.83, impulse = 12, dt = 1e-6, inertia = spec.mass.inertia.x();
  const Vec3 x = spec.position;
  body.kick(loaded(x, {{x + Vec3(0, 0, arm), Vec3(0, impulse / dt, 0)}}), {}, dt);

  EXPECT_LT((body.velocity() - Vec3(0, impulse / spec.mass.mass, 0)).norm(), 1e-12);
  EXPECT_LT((body.angular_velocity() - Vec3(-impulse * arm / inertia, 0, 0)).norm(), 1e-12);
  const double behind = inertia / (spec.mass.mass * arm);
  EXPECT_NEAR(behind, 0.310, 0.0005);
  const Vec3 at_centre = body.velocity() + body.angular_velocity().cross(Vec3(0, 0, -behind));
  EXPECT_LT(at_centre.norm(), 1e-12);
}

// V40. Drift, kick, drift is exact under a constant load.
TEST(LoadsOut, AConstantListOfForcesGivesTheClosedFormMotion) {
  RandomVectors random;
  for (const int count : {1, 2, 7, 100}) {
    rigid::BodySpec spec = tumbling_box();
    spec.orientation = Quat::Identity();
    spec.velocity = spec.angular_velocity = Vec3::Zero();
    Body body(spec);
    std::vector<PointForce> forces;  // points in the y-z plane of the centre, forces in it: a couple about x only
    Vec3 force = Vec3::Zero();
    double torque = 0;
    for (int n = 0; n < count; ++n) {
      const Vec3 lever = random(1), f = random(1000);
      forces.push_back({spec.position + Vec3(0, lever.y(), lever.z()), Vec3(0, f.y(), f.z())});
      force += forces.back().force;
      torque += lever.y() * f.z() - lever.z() * f.y();
    }
    const sph::Surface load = loaded(spec.position, forces);
    const int steps = 200;
    const double time = 0.01, dt = time / steps;
    for (int n = 0; n < steps; ++n) {
      body.drift(dt / 2);
      body.kick(load, {}, dt);
      body.drift(dt / 2);
    }
    const Vec3 v = time / spec.mass.mass * force;
    const double turn = 0.5 * time * time * torque / spec.mass.inertia.x();
    EXPECT_LT((body.velocity() - v).norm(), 1e-10 * v.norm()) << count;
    EXPECT_LT((body.state().position - spec.position - 0.5 * time * v).norm(), 1e-10) << count;
    EXPECT_NEAR(body.angular_velocity().x(), 2 * turn / time, 1e-10 * std::abs(2 * turn / time)) << count;
    EXPECT_LT(body.state().orientation.angularDistance(Quat(Eigen::AngleAxisd(turn, Vec3::UnitX()))), 1e-10) << count;
  }
}

TEST(LoadsOut, TheWrenchDoesNotDependOnTheWorldOrigin) {
  RandomVectors random;
  std::vector<PointForce> forces, moved;
  rigid::BodySpec spec = tumbling_box(), far = spec;
  const Vec3 shift(1000, -500, 250);  // exact in binary, as the positions are nearly
  far.position += shift;
  for (int n = 0; n < 20; ++n) {
    forces.push_back({spec.position + random(1), random(1e5)});
    moved.push_back({forces.back().point + shift, forces.back().force});
  }
  Body here(spec), there(far);
  here.kick(loaded(spec.position, forces), {}, 1e-3);
  there.kick(loaded(far.position, moved), {}, 1e-3);
  EXPECT_EQ(here.velocity(), there.velocity());
  EXPECT_LT((here.angular_velocity() - there.angular_velocity()).norm(), 1e-11 * here.angular_velocity().norm());
}

/// Ice pressed into the flank of a turned box, one interaction old. Neither stress nor viscosity has acted yet, so the
/// accelerations of the ice are those of contact alone.
TEST(LoadsOut, TheBodyGetsTheOppositeWrenchOfWhatTheIceGot) {
  rigid::BodySpec spec = tumbling_box();
  spec.position = Vec3(0, 0, 0);
  const Body body(spec);
  sph::IceSpec ice_spec = test::elastic_sheet();
  ice_spec.contact.friction_coefficient = 0.3;
  ice_spec.pieces[0].centre = Vec3(0, 0.4, 0.3);
  std::vector<sph::Surface> surfaces{body.make_surface()};
  sph::Ice ice(ice_spec, surfaces);
  const double dt = 1e-6;
  ice.drift(dt / 2);
  ice.interact(surfaces, dt);

  const sph::Particles& particles = ice.particles();
  const sph::Surface& surface = surfaces[0];
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero(), boundary = Vec3::Zero();
  double scale = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3 f = particles.mass * particles.acceleration[i];
    force += f;
    moment += (particles.motion[i].position - spec.position).cross(f);
    scale += f.norm();
  }
  for (const sph::BoundaryParticle& b : surface.particles) boundary += b.force;
  ASSERT_GT(surface.force.norm(), 0);
  EXPECT_LT((force + surface.force).norm(), 1e-12 * scale);
  EXPECT_LT((moment + surface.moment).norm(), 1e-12 * scale);
  EXPECT_LT((boundary - surface.force).norm(), 1e-12 * scale);
}

/// Random loads of ice and host on a body that also drifts; returns what the ice gave, about the world origin.
struct IceGave {
  Vec3 impulse = Vec3::Zero(), angular_impulse = Vec3::Zero();
};
IceGave shake(Body& body) {
  RandomVectors random;
  IceGave gave;
  const double dt = 1e-3;
  for (int n = 0; n < 300; ++n) {
    body.drift(dt / 2);
    const Vec3 x = body.state().position;
    const sph::Surface surface = loaded(x, {{x + random(0.5), random(1e5)}, {x + random(0.5), random(1e5)}});
    body.kick(surface, {random(3e4), random(3e4)}, dt);
    gave.impulse += dt * surface.force;
    gave.angular_impulse += dt * (x.cross(surface.force) + surface.moment);
    body.drift(dt / 2);
  }
  return gave;
}

/// The locks of Motion and locks along single world axes, as Bullet's factors.
struct Lock {
  std::string name;
  Body body;
  Vec3 linear, angular;
};
std::vector<Lock> locks(const rigid::BodySpec& spec) {
  const auto with = [&](Motion motion) {
    rigid::BodySpec moved = spec;
    moved.motion = motion;
    return Body(moved);
  };
  return {{"free", with(Motion::free), kAll, kAll},
          {"translation only", with(Motion::translation_only), kAll, kNone},
          {"fixed path", with(Motion::fixed_path), kNone, kNone},
          {"slider", Body(spec, Vec3(0, 0, 1), kNone), Vec3(0, 0, 1), kNone},
          {"turntable", Body(spec, kNone, Vec3(0, 0, 1)), kNone, Vec3(0, 0, 1)},
          {"no roll", Body(spec, kAll, Vec3(1, 1, 0)), kAll, Vec3(1, 1, 0)}};
}

TEST(BodyAccount, ClosesMomentumAndAngularMomentumUnderEveryLock) {
  for (Lock& lock : locks(tumbling_box())) {
    Body& body = lock.body;
    const Vec3 p0 = body.state().momentum, L0 = angular_momentum_about_origin(body);
    const IceGave gave = shake(body);
    const BodyAccount& account = body.account();
    const double scale = gave.impulse.norm() + account.external_impulse.norm() + p0.norm();
    const double length = body.state().position.norm() + 1;
    EXPECT_LT((account.ice_impulse - gave.impulse).norm(), 1e-12 * scale) << lock.name;
    EXPECT_LT((body.state().momentum - p0 - gave.impulse - account.external_impulse).norm(), 1e-11 * scale)
        << lock.name;
    EXPECT_LT(
        (angular_momentum_about_origin(body) - L0 - gave.angular_impulse - account.external_angular_impulse).norm(),
        1e-11 * scale * length)
        << lock.name;
  }
}

// The free rotation of a body with an axis of revolution is exact; that of others keeps energy to second order only.
TEST(BodyAccount, ClosesEnergyUnderEveryLock) {
  rigid::BodySpec spec = tumbling_box();
  spec.shape = rigid::Box{Vec3(0.4, 0.4, 1.0)};
  spec.mass = rigid::from_density(spec.shape, 500);
  for (const Lock& lock : locks(spec)) {
    Body body = lock.body;
    const double E0 = body.kinetic_energy();
    shake(body);
    const double E = body.kinetic_energy(), ice = body.account().ice_work, external = body.account().external_work;
    EXPECT_NEAR(E - E0, ice + external, 1e-11 * (E + E0 + std::abs(ice) + std::abs(external))) << lock.name;
  }
}

TEST(Locks, KeepTheLockedVelocitiesExactlyUnderAnyLoad) {
  for (Lock& lock : locks(tumbling_box())) {
    const Vec3 v0 = lock.body.velocity(), w0 = lock.body.angular_velocity();
    shake(lock.body);
    const Vec3 dv = lock.body.velocity() - v0, dw = lock.body.angular_velocity() - w0;
    for (int k = 0; k < 3; ++k) {
      if (lock.linear[k] == 0)
        EXPECT_EQ(dv[k], 0) << lock.name << " " << k;
      else
        EXPECT_NE(dv[k], 0) << lock.name << " " << k;
      if (lock.angular[k] == 0)
        EXPECT_NEAR(dw[k], 0, 1e-11 * w0.norm()) << lock.name << " " << k;
      else
        EXPECT_NE(dw[k], 0) << lock.name << " " << k;
    }
  }
}

TEST(Locks, AFixedPathIsStraightAndItsSpinSteady) {
  const rigid::BodySpec spec = tumbling_box(Motion::fixed_path);
  Body body(spec);
  shake(body);
  EXPECT_LT((body.state().position - spec.position - 0.3 * spec.velocity).norm(), 1e-13 * 300 * 10);
  const Quat turned = Quat(Eigen::AngleAxisd(0.3 * spec.angular_velocity.norm(), spec.angular_velocity.normalized())) *
                      spec.orientation;
  EXPECT_LT(body.state().orientation.angularDistance(turned), 1e-12);
}

TEST(Locks, TranslationOnlyKeepsItsAttitude) {
  rigid::BodySpec spec = tumbling_box(Motion::translation_only);
  spec.angular_velocity = Vec3::Zero();
  Body body(spec);
  shake(body);
  EXPECT_EQ(body.state().orientation.coeffs(), Body(spec).state().orientation.coeffs());
  EXPECT_GT((body.velocity() - spec.velocity).norm(), 0.1);
}

TEST(Locks, AFixedBodyNeverMoves) {
  Body body(tumbling_box(Motion::fixed));
  shake(body);
  EXPECT_EQ(body.state().position, Vec3(3, -2, 1));
  EXPECT_EQ(body.state().orientation.coeffs(), Body(tumbling_box()).state().orientation.coeffs());
  EXPECT_TRUE(body.velocity().isZero(0) && body.angular_velocity().isZero(0));
  EXPECT_EQ(body.account().external_impulse, -body.account().ice_impulse);
}

// A hinge about world z with moment I_zz of the turned body: d(omega_z) = T_z / I_zz, whatever its principal axes are.
TEST(Locks, AHingedBodyTurnsWithItsMomentAboutTheHinge) {
  rigid::BodySpec spec = tumbling_box();
  spec.angular_velocity = Vec3(0, 0, 2);
  Body body(spec, kNone, Vec3(0, 0, 1));
  const Mat3 R = body.state().orientation.toRotationMatrix();
  const double moment = (R * spec.mass.inertia.asDiagonal() * R.transpose())(2, 2);
  sph::Surface surface;
  surface.moment = Vec3(300, -200, 100);
  body.kick(surface, {}, 0.01);
  EXPECT_NEAR(body.angular_velocity().z(), 2 + 0.01 * 100 / moment, 1e-12);
}

/// Mobility of a free body of that mass and inertia; body axes.
Mat6 mobility_of(const rigid::MassProperties& mass) {
  Vec6 inverse;
  inverse << Vec3::Constant(1 / mass.mass), mass.inertia.cwiseInverse();
  return inverse.asDiagonal();
}

TEST(Mechanism, WithTheMobilityOfTheFreeBodyAnswersAsTheFreeBody) {
  const rigid::BodySpec spec = tumbling_box();
  Body free(spec), joined(spec);
  joined.join_mechanism(mobility_of(spec.mass), Vec3::Zero());
  const sph::Surface surface = loaded(spec.position, {{spec.position + Vec3(0.1, -0.2, 0.3), Vec3(300, -200, 500)}});
  free.kick(surface, {}, 0.01);
  joined.kick(surface, {}, 0.01);
  EXPECT_LT((joined.state().momentum - free.state().momentum).norm(), 1e-13 * free.state().momentum.norm());
  EXPECT_LT((joined.state().angular_momentum - free.state().angular_momentum).norm(),
            1e-13 * free.state().angular_momentum.norm());
}

TEST(Mechanism, KeepsItsSpinAndMovesItsPivotStraight) {
  const rigid::BodySpec spec = tumbling_box();
  Body body(spec);
  const Vec3 pivot(0.2, -0.5, 0.3), lever = spec.orientation * pivot;
  body.join_mechanism(Mat6::Zero(), pivot);
  const Vec3 straight = spec.velocity + spec.angular_velocity.cross(lever);
  for (int n = 0; n < 5; ++n) body.drift(0.1);
  const rigid::State& now = body.state();
  EXPECT_LT((now.position + now.orientation * pivot - spec.position - lever - 0.5 * straight).norm(), 1e-14);
  EXPECT_LT((body.angular_velocity() - spec.angular_velocity).norm(), 1e-14);
  EXPECT_LT((body.velocity() + spec.angular_velocity.cross(now.orientation * pivot) - straight).norm(), 1e-13);
}

TEST(Mechanism, BooksWhatItsJointsTakeAsExternalAndKeepsTheIcesImpulseForTheHost) {
  const rigid::BodySpec spec = tumbling_box();
  Body body(spec);
  const Vec3 p0 = body.state().momentum, L0 = angular_momentum_about_origin(body);
  const double E0 = body.kinetic_energy();
  body.join_mechanism(0.3 * mobility_of(spec.mass), Vec3(0.2, -0.5, 0.3));
  RandomVectors random;
  Vec3 impulse = Vec3::Zero(), about_origin = Vec3::Zero();
  for (int n = 0; n < 10; ++n) {
    body.drift(0.01);
    const PointForce f{random(1), random(1e4)};
    body.kick(loaded(body.state().position, {f}), {}, 0.02);
    impulse += 0.02 * f.force;
    about_origin += 0.02 * f.point.cross(f.force);
    body.drift(0.01);
  }
  const BodyAccount& account = body.account();
  EXPECT_LT((body.mechanism_load().momentum - impulse).norm(), 1e-11);
  EXPECT_LT((body.mechanism_load().angular_momentum - about_origin).norm(), 1e-11);
  EXPECT_LT((body.state().momentum - p0 - impulse - account.external_impulse).norm(), 1e-11);
  EXPECT_LT((angular_momentum_about_origin(body) - L0 - about_origin - account.external_angular_impulse).norm(), 1e-10);
  EXPECT_NEAR(body.kinetic_energy() - E0, account.ice_work + account.external_work, 1e-8);
}

TEST(Mechanism, KeepsTheImpulseAlongTheBodysAxesAndItsIntegralOverTime) {
  const rigid::BodySpec spec = tumbling_box();
  Body body(spec);
  body.join_mechanism(Mat6::Zero(), Vec3::Zero());
  sph::Surface surface;
  surface.force = spec.orientation * Vec3(100, 200, -300);
  surface.moment = spec.orientation * Vec3(7, -8, 9);
  body.kick(surface, {}, 0.01);
  body.drift(0.5);
  Vec6 expected;
  expected << 1, 2, -3, 0.07, -0.08, 0.09;
  EXPECT_LT((body.mechanism_load().impulse - expected).norm(), 1e-14);
  EXPECT_LT((body.mechanism_load().impulse_time - 0.5 * expected).norm(), 1e-14);
  EXPECT_LT((body.mechanism_load().momentum_time - 0.5 * (spec.orientation * Vec3(1, 2, -3))).norm(), 1e-14);
  body.join_mechanism(Mat6::Zero(), Vec3::Zero());
  EXPECT_TRUE(body.mechanism_load().impulse.isZero(0));
}

TEST(Accept, BooksWhatTheHostDidAsExternal) {
  Body body(tumbling_box());
  const Vec3 p0 = body.state().momentum, L0 = angular_momentum_about_origin(body);
  const double E0 = body.kinetic_energy();
  body.accept(Vec3(30, -20, 10), Vec3(1, 2, 3), Vec3(0.01, 0.02, -0.03),
              Quat(Eigen::AngleAxisd(0.2, Vec3(0, 1, 1).normalized())));
  EXPECT_LT((body.state().position - Vec3(3.01, -1.98, 0.97)).norm(), 1e-15);
  EXPECT_LT((body.state().momentum - p0 - body.account().external_impulse).norm(), 1e-12);
  EXPECT_LT((angular_momentum_about_origin(body) - L0 - body.account().external_angular_impulse).norm(), 1e-11);
  EXPECT_NEAR(body.kinetic_energy() - E0, body.account().external_work, 1e-9);
  EXPECT_TRUE(body.account().ice_impulse.isZero(0));
}

}  // namespace
}  // namespace nilas
