// Rigid state and its integrator: exact linear and angular momentum, free rotation by splitting.
//
// Momenta are the primary variables, in the world frame, so that an impulse is one addition and a free body conserves
// both exactly: drift does not touch them. Free rotation is the symmetric splitting of Dullweber, Leimkuhler and
// McLachlan (J. Chem. Phys. 107, 5840, 1997) of the kinetic energy into its three principal parts, half x, half y,
// full z, half y, half x, each an exact rotation about a body axis; second order, time-reversible. A body with two
// equal moments is rotated exactly, whatever dt.
#pragma once

#include "rigid/mass_properties.hpp"

#pragma GCC visibility push(default)

namespace nilas::rigid {

/// World frame. `orientation` turns body-frame vectors into world-frame vectors; the body frame has its origin at the
/// centre of mass and the axes of the shape's geometry frame.
struct State {
  Vec3 position = Vec3::Zero();          // m, centre of mass
  Quat orientation = Quat::Identity();   // unit
  Vec3 momentum = Vec3::Zero();          // kg m/s
  Vec3 angular_momentum = Vec3::Zero();  // kg m2/s, about the centre of mass, world axes
};

static_assert(alignof(State) == alignof(double));

// In all of these: mass [kg] and inertia [kg m2] (principal, body axes) are positive.

/// Free flight over dt [s], which may be negative: position by the velocity, orientation by the free rotation. Momenta
/// are untouched.
void drift(State& state, double mass, const Vec3& inertia, double dt);
/// Adds a linear impulse [N s] and an angular impulse about the centre of mass [N m s], world frame.
void kick(State& state, const Vec3& impulse, const Vec3& angular_impulse);

Vec3 velocity(const State& state, double mass);                        // m/s
Vec3 angular_velocity_world(const State& state, const Vec3& inertia);  // rad/s
/// L = R diag(I) R^T omega.
Vec3 angular_momentum_world(const Quat& orientation, const Vec3& inertia, const Vec3& angular_velocity_world);
double kinetic_energy(const State& state, double mass, const Vec3& inertia);  // J

/// Orientation that turns +z into the unit vector `axis` by the shortest arc (for -z: a half turn about x).
Quat orientation_along(const Vec3& axis);

}  // namespace nilas::rigid

#pragma GCC visibility pop
