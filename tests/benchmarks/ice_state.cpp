#include "tests/benchmarks/ice_state.hpp"

#include <algorithm>
#include <cmath>

#include "sph/lattice.hpp"
#include "sph/stress_update.hpp"
#include "tests/benchmarks/struck_sheet.hpp"
#include "tests/support/surfaces.hpp"

namespace nilas::benchmarks {

namespace {

using namespace sph;

constexpr double kSpacing = 0.02, kThickness = 0.3;  // m
constexpr double kSpeed = 100, kWave = 0.5;          // m/s
constexpr double kStep = 4.5e-6;                     // s

const Vec3 kCentre(0, 0, -kThickness / 2);                                                         // of the sphere
double radius(const IceSpec& spec) { return std::min(0.15, 0.2 * spec.pieces.front().diameter); }  // m

IceSpec spec_of(double particles, const PairTerms& terms) {
  IceSpec spec;
  PieceSpec disc;
  disc.shape = IceShape::disc;
  disc.thickness = kThickness;
  disc.diameter = disc_diameter(particles, kThickness, kSpacing);
  spec.pieces = {disc};
  spec.spacing = kSpacing;
  spec.jitter = 0.1;
  spec.numerics.gradient_correction = terms.corrected;
  spec.numerics.viscosity_alpha = terms.viscous ? 0.1 : 0;
  spec.numerics.precision = terms.single_precision ? Precision::single : Precision::double_;
  return spec;
}

Vec3 velocity(const Vec3& x) {
  const double thrown = kSpeed * std::exp(-x.head<2>().squaredNorm() / (0.1 * 0.1));
  return kWave * Vec3(std::sin(20 * x[1]), std::cos(17 * x[2]), std::sin(23 * x[0])) + thrown * Vec3::UnitZ();
}

Particles moving_ice(const IceSpec& spec) {
  const auto outside = [r = radius(spec)](const Vec3& x) { return (x - kCentre).norm() > r + 0.25 * kSpacing; };
  return lattice(spec, {.velocity = velocity, .keep = outside, .displacement = {}});
}

Neighbours neighbours_of(const IceSpec& spec, double reach) {
  const double half = 0.5 * spec.pieces.front().diameter + kThickness;
  return Neighbours(reach, kSpacing, Period::Zero(), Vec3(-half, -half, -kThickness), Vec3(half, half, kThickness),
                    static_cast<std::size_t>(estimated_particles(spec)), spec.numerics.precision);
}

}  // namespace

IceState::IceState(double particles, PairTerms terms)
    : spec_(spec_of(particles, terms)),
      elastic_(spec_.material),
      kernel_(spec_.numerics.smoothing_ratio * kSpacing),
      skin_(spec_.numerics.skin_ratio * kernel_.support_radius()),
      particles_(moving_ice(spec_)),
      neighbours_(neighbours_of(spec_, kernel_.support_radius() + skin_)),
      passes_(pair_passes(terms)),
      constants_{kernel_.smoothing_length(),
                 kernel_.gradient_scale(),
                 elastic_.bulk_sound_speed(),
                 spec_.numerics.viscosity_alpha,
                 0,
                 Period::Zero(),
                 particles_.mass / elastic_.density},
      material_(make_material(spec_.material, kSpacing, kernel_.smoothing_length())),
      sphere_(test::sphere(kCentre, radius(spec_), 0.75 * kSpacing)),
      contact_(ContactConstants(spec_.contact, elastic_, kSpacing), 0.75 * kSpacing, skin_),
      half_step_(0.5 * kStep) {
  test::set_velocity(sphere_, Vec3(0, 0, kSpeed));
  rebuild_neighbours();
  gradient_pass();
  update_stress();
  count_pairs();
}

void IceState::gradient_pass() { passes_.velocity_gradient(particles_, neighbours_, constants_); }
void IceState::force_pass() { passes_.acceleration(particles_, neighbours_, constants_, kStep); }
void IceState::rebuild_neighbours() { neighbours_.rebuild(particles_); }

void IceState::update_stress() {
  sph::update_stress(particles_, material_, elastic_.density, half_step_);
  half_step_ = -half_step_;
}

void IceState::contact(bool search) {
  if (search) contact_.invalidate();
  contact_.apply(particles_, sphere_);
}

void IceState::count_pairs() {
  const double radius2 = kernel_.support_radius() * kernel_.support_radius();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    groups_ += static_cast<double>(neighbours_.groups_near(i).size());
    neighbours_.for_each_near(i, [&](std::uint32_t j) {
      pairs_ += (particles_.motion[i].position - particles_.motion[j].position).squaredNorm() < radius2;
    });
  }
  groups_ /= particles();
  pairs_ /= particles();
}

}  // namespace nilas::benchmarks
