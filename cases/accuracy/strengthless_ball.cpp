// V29: a ball without strength on a rigid plate, as a drop on a wall: F_peak = 0.85 rho v^2 D^2 at 0.15-0.2 D/v,
// impulse m v (Gordillo, Sun and Cheng, J. Fluid Mech. 840, 190, 2018; Sanjay et al., arXiv 2311.03012).
//
// The ball carries pressure and nothing else: no shear, no tension, and where it has opened it must close first. Its
// sound speed is ten times its speed; the drop's theory is incompressible. The force is averaged over 0.06 D/v.
#include <cmath>

#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/force_history.hpp"
#include "coupling/impact.hpp"

namespace nilas::cases {

namespace {

constexpr double diameter = 0.061;  // m, D
constexpr double speed = 81.2;      // m/s, v
constexpr double mach = 0.1;
constexpr double window = 0.06, end = 2.5;  // D/v

sph::IceSpec ball(const Scheme& scheme, double dx) {
  sph::IceSpec ice;
  sph::PieceSpec sphere;
  sphere.shape = sph::IceShape::sphere;
  sphere.diameter = diameter;
  sphere.centre = {0, 0, diameter / 2};
  sphere.velocity = {0, 0, -speed};
  ice.pieces = {sphere};
  ice.spacing = dx;
  sph::MaterialSpec& material = ice.material;
  // K = E/(3 (1 - 2 nu)) = rho c^2
  material.young_modulus = 3 * (1 - 2 * material.poisson_ratio) * material.density * std::pow(speed / mach, 2);
  material.cohesion = material.friction_angle_deg = material.dilation_angle_deg = 0;
  material.after_failure = sph::AfterFailure::fluid;
  material.pressure = sph::PressureLaw::density;
  ice.numerics = scheme.numerics;
  ice.numerics.skin_ratio = 0.4;  // speed only: what spreads over the plate outruns a thinner one every other step
  ice.contact = scheme.contact;
  return ice;
}

Body plate(double dx) {
  rigid::BodySpec body;
  body.name = "plate";
  body.shape = rigid::Box{Vec3(3 * diameter, 3 * diameter, 0.2 * diameter)};
  body.boundary_spacing = dx;
  body.mass = rigid::from_mass(body.shape, 1);
  body.motion = rigid::Motion::fixed;
  body.position = {0, 0, -0.1 * diameter};
  return Body(body);
}

Measurement run(const Scheme& scheme, int cells_per_diameter) {
  const double dx = diameter / cells_per_diameter;
  const double unit = diameter / speed;
  ForceHistory force;
  std::vector<Body> bodies;
  bodies.push_back(plate(dx));
  Impact impact(ball(scheme, dx), std::move(bodies),
                [&](const Impact& i) { force.add(i.last_step().time, -i.bodies()[0].account().ice_impulse.z()); });
  impact.advance(end * unit);
  const double exact = 0.85 * sph::MaterialSpec{}.density * std::pow(speed * diameter, 2);
  const double mass = impact.ice().particles().mass * static_cast<double>(impact.ice().particles().size());
  return {.resolution = dx,
          .spacing = dx,
          .particles = impact.ice().particles().size(),
          .steps = impact.last_step().number,
          .errors = {std::abs(force.peak(window * unit) / exact - 1),
                     std::abs(force.impulse(end * unit) / (mass * speed) - 1)}};
}

}  // namespace

VerificationCase strengthless_ball() {
  return {.name = "V29-strengthless-ball",
          .title = "A ball without strength strikes a rigid plate",
          .reference = "Drop on a wall: F_peak = 0.85 rho v^2 D^2, impulse m v",
          .metrics = {{"peak force", 0.15}, {.name = "impulse", .tolerance = 0.02, .missed = true}},
          .resolutions = {12, 16, 24, 32, 48},
          .stated_resolution = 16,
          .quick = 3,
          .tested = 2,
          .compared = 2,
          .run = run};
}

}  // namespace nilas::cases
