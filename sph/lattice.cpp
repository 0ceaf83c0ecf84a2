#include "sph/lattice.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "sph/kernel.hpp"

namespace nilas::sph {

Vec3 extent(const PieceSpec& p) {
  switch (p.shape) {
    case IceShape::disc:
      return {p.diameter, p.diameter, p.thickness};
    case IceShape::sphere:
      return Vec3::Constant(p.diameter);
    case IceShape::block:
      return p.size;
  }
  return Vec3::Zero();
}

namespace {

bool inside(const PieceSpec& p, const Vec3& r) {
  const double radius = 0.5 * p.diameter;
  switch (p.shape) {
    case IceShape::disc:
      return r.head<2>().squaredNorm() <= radius * radius && r.head<2>().norm() >= 0.5 * p.inner_diameter;
    case IceShape::sphere:
      return r.squaredNorm() <= radius * radius;
    case IceShape::block:
      return true;
  }
  return false;
}

/// Displaces particles at random; the generator and its seed are fixed, so that a scene is one and the same ice.
void disorder(Particles& particles, double largest) {
  std::mt19937_64 bits(1);
  const auto next = [&] { return largest * (std::ldexp(static_cast<double>(bits() >> 11), -52) - 1); };
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3 displacement(next(), next(), next());
    if (!particles.held[i]) particles.motion[i].position += displacement;
  }
}

/// Cells along each axis.
Eigen::Array3i cells(const PieceSpec& p, double dx) { return (extent(p) / dx).array().round().cast<int>().max(1); }

/// Whether this position lies in the cell of one of the piece's particles.
bool occupies(const PieceSpec& p, double dx, const Vec3& position) {
  const Eigen::Array3d n = cells(p, dx).cast<double>();
  const Eigen::Array3d cell = ((position - p.centre).array() / dx + 0.5 * (n - 1)).round();
  return (cell >= 0).all() && (cell < n).all() && inside(p, dx * (cell - 0.5 * (n - 1)).matrix());
}

bool is_held(const PieceSpec& p, const Vec3& r, double depth) {
  if (p.fixed.rim && r.head<2>().norm() > 0.5 * p.diameter - depth) return true;
  const Vec3 half = 0.5 * extent(p);
  for (int axis = 0; axis < 3; ++axis) {
    if (p.fixed.faces[2 * axis] && r[axis] < -half[axis] + depth) return true;
    if (p.fixed.faces[2 * axis + 1] && r[axis] > half[axis] - depth) return true;
  }
  return false;
}

void fill(Particles& particles, const PieceSpec& p, double dx, double held_depth, const InitialState& initial) {
  const std::size_t before = particles.size();
  const Eigen::Array3i n = cells(p, dx);
  const double cell = dx * dx * dx;
  for (int ix = 0; ix < n[0]; ++ix)
    for (int iy = 0; iy < n[1]; ++iy)
      for (int iz = 0; iz < n[2]; ++iz) {
        const Vec3 r = dx * (Vec3(ix, iy, iz) - 0.5 * (n - 1).cast<double>().matrix());
        if (!inside(p, r)) continue;
        const bool held = is_held(p, r, held_depth);
        const Vec3 position = p.centre + r;
        if (initial.keep && !initial.keep(position)) continue;
        Vec3 velocity = p.velocity;
        if (initial.velocity) velocity += initial.velocity(position);
        if (held) velocity.setZero();
        const bool displaced = initial.displacement && !held;
        particles.motion.push_back(
            {displaced ? (position + initial.displacement(position)).eval() : position, cell, velocity});
        particles.held.push_back(held);
      }
  if (particles.size() == before) throw std::invalid_argument("a piece of ice holds no particle at this spacing");
}

}  // namespace

double estimated_particles(const IceSpec& spec) {
  double n = 0;
  for (const PieceSpec& p : spec.pieces) {
    const Vec3 cells = (extent(p) / spec.spacing).array().round().max(1);
    const double fill = p.shape == IceShape::block ? 1 : std::numbers::pi / (p.shape == IceShape::disc ? 4 : 6);
    const double hole = p.shape == IceShape::disc ? std::pow(p.inner_diameter / p.diameter, 2) : 0;
    n += fill * (1 - hole) * cells.prod();
  }
  return n;
}

Particles lattice(const IceSpec& spec, const InitialState& initial) {
  Particles particles;
  const double dx = spec.spacing;
  const WendlandC2 kernel(spec.numerics.smoothing_ratio * dx);
  particles.mass = spec.material.density * dx * dx * dx;
  for (const PieceSpec& piece : spec.pieces) {
    const std::size_t first = particles.size();
    particles.piece_begin.push_back(static_cast<std::uint32_t>(first));
    fill(particles, piece, dx, kernel.support_radius(), initial);
    for (const PieceSpec* earlier = spec.pieces.data(); earlier != &piece; ++earlier)
      for (std::size_t i = first; i < particles.size(); ++i)
        if (occupies(*earlier, dx, particles.motion[i].position))
          throw std::invalid_argument("two pieces of ice overlap by more than half a spacing");
  }
  if (spec.jitter > 0) disorder(particles, spec.jitter * dx);

  const std::size_t n = particles.size();
  particles.stress.assign(n, {});
  particles.velocity_gradient.assign(n, Mat3::Zero());
  particles.acceleration.assign(n, Vec3::Zero());
  particles.id.resize(n);
  for (std::size_t i = 0; i < n; ++i) particles.id[i] = static_cast<std::uint32_t>(i);
  if (spec.numerics.artificial_stress > 0 || spec.numerics.hourglass_control > 0)
    particles.stabilisation.assign(n, Vec3::Zero());
  if (spec.numerics.gradient_correction) particles.correction.assign(n, {1, 1, 1, 0, 0, 0});
  const bool rate_dependent = spec.material.model == Model::rate_dependent;
  if (spec.material.model == Model::drucker_prager || rate_dependent) {
    particles.plastic_strain.assign(n, 0);
    particles.failed.assign(n, 0);
    if (spec.material.pressure == PressureLaw::density || rate_dependent) particles.bulking.assign(n, 0);
  }
  if (rate_dependent) {
    particles.strain_rate.assign(n, 0);
    particles.tensile_damage.assign(n, 0);
    particles.shear_damage.assign(n, 0);
  }
  if (spec.material.model == Model::neo_hookean) particles.deformation_gradient.assign(n, Mat3::Identity());
  return particles;
}

}  // namespace nilas::sph
