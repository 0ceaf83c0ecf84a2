// V36: an impulse J at the arm d from the centre of mass of an HCC at rest: v = J/M, omega = J d/I, and the point I/(M
// d) on the other side of the centre stays at rest. The impulse comes in as many parts as the resolution says.
#include "cases/accuracy/catalogue.hpp"
#include "rigid/state.hpp"

namespace nilas::cases {

namespace {

constexpr double arm = 0.83;     // m
constexpr double impulse = 250;  // N s

Measurement run(const Scheme&, int parts) {
  const rigid::MassProperties body = rigid::from_density(rigid::Hcc{1.8, 0.3, 0.2}, 1500);
  rigid::State state;
  state.orientation = rigid::orientation_along(Vec3(0, 0.6, 0.8));
  const Vec3 axis = state.orientation * Vec3::UnitZ(), across = state.orientation * Vec3::UnitY();
  const Vec3 part = impulse / parts * across;
  for (int n = 0; n < parts; ++n) rigid::kick(state, part, (arm * axis).cross(part));

  const Vec3 v = rigid::velocity(state, body.mass), omega = rigid::angular_velocity_world(state, body.inertia);
  const Vec3 exact_v = impulse / body.mass * across;
  const Vec3 exact_omega = impulse * arm / body.inertia.x() * axis.cross(across);
  const double centre = -body.inertia.x() / (body.mass * arm);
  const Vec3 at_centre = v + omega.cross(Vec3(centre * axis));
  return {.resolution = 1. / parts,
          .steps = static_cast<std::size_t>(parts),
          .errors = {(v - exact_v).norm() / exact_v.norm(), (omega - exact_omega).norm() / exact_omega.norm(),
                     at_centre.norm() / exact_v.norm()}};
}

}  // namespace

VerificationCase off_centre_impulse() {
  return {
      .name = "V36-off-centre-impulse",
      .title = "An impulse at an arm from the centre of mass of an HCC at rest",
      .reference = "v = J/M, omega = J d/I; instantaneous centre I/(M d) = 0.310 m behind the centre of mass",
      .metrics = {{"velocity", 1e-12}, {"angular velocity", 1e-12}, {"velocity of the instantaneous centre", 1e-12}},
      .resolutions = {1, 10, 100},
      .stated_resolution = 1,
      .quick = 3,
      .tested = 3,
      .compared = 0,
      .run = run};
}

}  // namespace nilas::cases
