// A coarse impact for the tests of the coupling: a short HCC and a small sheet of some three thousand particles.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "coupling/impact.hpp"

namespace nilas::test {

constexpr double kSheetThickness = 0.3;  // m

/// The paper's ice as a free disc on the plane z = 0.
inline sph::IceSpec small_sheet(double spacing = 0.03, double diameter = 0.6) {
  sph::IceSpec ice;
  sph::PieceSpec disc;
  disc.shape = sph::IceShape::disc;
  disc.diameter = diameter;
  disc.thickness = kSheetThickness;
  ice.pieces = {disc};
  ice.spacing = spacing;
  return ice;
}

/// The same sheet, unbreakable and without viscosity.
inline sph::IceSpec elastic_sheet() {
  sph::IceSpec ice = small_sheet();
  ice.material.model = sph::Model::elastic;
  ice.numerics.viscosity_alpha = 0;
  return ice;
}

/// A few particles far from everything: for worlds in which no body shall meet ice.
inline sph::IceSpec ice_out_of_reach() {
  sph::IceSpec ice;
  sph::PieceSpec block;
  block.shape = sph::IceShape::block;
  block.size = Vec3::Constant(0.2);
  block.centre = Vec3(0, 0, 1000);
  ice.pieces = {block};
  ice.spacing = 0.1;
  return ice;
}

/// Angle between the velocity and the horizontal in degrees, 90 = vertical; positive y grows against it as in a scene.
inline Vec3 heading(double angle_deg) {
  const double angle = angle_deg * std::numbers::pi / 180;
  // cos(90 deg) is not zero in floating point.
  return angle_deg == 90 ? Vec3(0, 0, 1) : Vec3(0, -std::cos(angle), std::sin(angle));
}

/// A homogeneous short HCC of 900 kg/m3 at 100 m/s, axis along its velocity, tip just below the sheet.
inline rigid::BodySpec short_hcc(double angle_deg, rigid::Motion motion = rigid::Motion::free) {
  rigid::BodySpec body;
  body.name = "hcc";
  body.shape = rigid::Hcc{0.6, 0.3, 0.2};
  body.boundary_spacing = 0.02;
  body.mass = rigid::from_density(body.shape, 900);
  body.motion = motion;
  const Vec3 axis = heading(angle_deg);
  body.orientation = rigid::orientation_along(axis);
  body.velocity = 100 * axis;
  body.position = Vec3(0, 0, -0.5 * kSheetThickness - 0.02) + body.orientation * body.mass.centre_of_mass;
  return body;
}

/// Momentum of ice and bodies, without any account of what reached them.
inline Vec3 total_momentum(const Impact& impact) {
  Vec3 momentum = impact.ice().ledger().momentum;
  for (const Body& body : impact.bodies()) momentum += body.state().momentum;
  return momentum;
}

}  // namespace nilas::test
