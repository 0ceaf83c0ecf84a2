#include "coupling/stability_number.hpp"

#include <algorithm>

namespace nilas {

double StabilityNumber::largest() const { return std::max({translation, pitch, roll}); }

StabilityNumber stability_number(const Body& body, const sph::ElasticConstants& ice, bool friction, double dt) {
  StabilityNumber number;
  const rigid::BodySpec& spec = body.spec();
  if (!body.moves_freely()) return number;
  const double zdt = ice.impedance() * dt;

  const Vec3 v_body = body.state().orientation.conjugate() * body.velocity();
  const Vec3 heading = v_body.norm() > 0 ? v_body.normalized() : Vec3::UnitZ().eval();
  double frontal = 0;
  Vec3 moment_area = Vec3::Zero();
  for (const rigid::SurfacePoint& p : body.surface_body()) {
    frontal += p.area * std::max(0.0, p.normal.dot(heading));
    const Vec3 arm = p.position.cross(p.normal);
    moment_area += p.area * arm.cwiseAbs2();
    // A body that rolls slips along t, the part of z x r in the tangent plane: |r x t|_z^2 = |z x r|^2 - |r x n|_z^2.
    if (friction) moment_area[2] += p.area * (p.position.head<2>().squaredNorm() - arm[2] * arm[2]);
  }
  number.translation = zdt * frontal / spec.mass.mass;
  if (body.is_free()) {
    number.pitch = zdt * std::max(moment_area[0] / spec.mass.inertia[0], moment_area[1] / spec.mass.inertia[1]);
    number.roll = zdt * moment_area[2] / spec.mass.inertia[2];
  }
  return number;
}

double stability_rate(const std::vector<Body>& bodies, const sph::ElasticConstants& ice,
                      const sph::ContactSpec& contact) {
  const bool friction = contact.stick || contact.friction_coefficient > 0;
  double rate = 0;
  for (const Body& body : bodies) rate = std::max(rate, stability_number(body, ice, friction, 1).largest());
  return rate;
}

}  // namespace nilas
