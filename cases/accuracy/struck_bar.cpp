#include "cases/accuracy/struck_bar.hpp"

#include <cmath>

namespace nilas::cases {

int periodic_cells(const sph::NumericsSpec& numerics) {
  return static_cast<int>(std::ceil(4 * numerics.smoothing_ratio * (1 + numerics.skin_ratio)));
}

sph::IceSpec elastic_bar(const Scheme& scheme, double length, double dx, bool fixed) {
  sph::IceSpec ice;
  sph::PieceSpec block;
  block.shape = sph::IceShape::block;
  // Held are the layers whose centres lie within one kernel radius, 2 h, of the end.
  const double held = fixed ? std::ceil(2 * scheme.numerics.smoothing_ratio - 0.5) * dx : 0;
  const double across = periodic_cells(scheme.numerics) * dx;
  block.size = {length + held, across, across};
  block.centre = {0.5 * block.size.x(), 0, 0};
  block.fixed.faces[1] = fixed;
  ice.pieces = {block};
  ice.spacing = dx;
  ice.periodic = {false, true, true};
  ice.material.model = sph::Model::elastic;
  ice.material.poisson_ratio = 0;
  ice.numerics = scheme.numerics;
  ice.contact = scheme.contact;
  return ice;
}

rigid::BodySpec mass_on_end(const sph::IceSpec& bar, double mass, double speed, rigid::Motion motion) {
  const double width = bar.pieces[0].size.y(), margin = 6 * bar.spacing;
  rigid::BodySpec body;
  body.name = "mass";
  body.shape = rigid::Box{Vec3(width, width + margin, width + margin)};
  body.boundary_spacing = bar.spacing;
  body.mass = rigid::from_mass(body.shape, mass);
  body.motion = motion;
  body.velocity = {speed, 0, 0};
  body.position = {-0.5 * width, 0, 0};
  return body;
}

}  // namespace nilas::cases
