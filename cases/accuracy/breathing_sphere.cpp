// V15: the first breathing mode of a free elastic sphere of radius R (Lamb 1882): radial displacement
//
//   u ~ j1(kr) = sin(kr)/(kr)^2 - cos(kr)/(kr),   f = x c_p/(2 pi R),  x = kR,
//   x cot x = 1 - x^2 (c_p/c_s)^2/4   (no traction on the surface):  x = 2.7363 for nu = 0.33.
//
// The sphere starts with that velocity; the frequency is that of the velocity's share of the mode.
#include "cases/accuracy/breathing_sphere.hpp"

#include <numbers>

#include "cases/accuracy/advance.hpp"
#include "cases/accuracy/catalogue.hpp"

namespace nilas::cases {

double breathing_root(double nu) {
  const double ratio = 2 * (1 - nu) / (1 - 2 * nu);  // (c_p/c_s)^2
  // x cos x - (1 - x^2 ratio/4) sin x is positive just above 0 and negative at pi: bisection.
  double low = 0.1, high = std::numbers::pi;
  for (int k = 0; k < 60; ++k) {
    const double x = 0.5 * (low + high);
    (x * std::cos(x) - (1 - x * x * ratio / 4) * std::sin(x) > 0 ? low : high) = x;
  }
  return 0.5 * (low + high);
}

namespace {

constexpr double diameter = 0.061;  // m
constexpr double V = 0.1;           // m/s
constexpr int periods = 6;

/// j1(kr) in the direction of r.
Vec3 mode(const Vec3& r, double k) {
  const double s = k * r.norm();
  return s < 1e-3 ? Vec3(k * r / 3) : Vec3((std::sin(s) / (s * s) - std::cos(s) / s) / s * k * r);
}

Measurement run(const Scheme& scheme, int cells_per_diameter) {
  Measurement m;
  m.resolution = m.spacing = diameter / cells_per_diameter;
  sph::IceSpec spec;
  sph::PieceSpec piece;
  piece.shape = sph::IceShape::sphere;
  piece.diameter = diameter;
  spec.pieces = {piece};
  spec.spacing = m.spacing;
  spec.material.model = sph::Model::elastic;
  spec.numerics = scheme.numerics;
  const double x = breathing_root(spec.material.poisson_ratio), k = 2 * x / diameter;
  sph::Ice ice(spec, {}, {.velocity = [&](const Vec3& r) { return Vec3(V * mode(r, k)); }});
  m.particles = ice.particles().size();
  const double exact = k * ice.elastic_constants().p_wave_speed() / (2 * std::numbers::pi);

  // Zeros of the mode's share, at odd quarters of the period; from the first to the last.
  double before = 1, time_before = 0, first = 0, last = 0;
  int zeros = 0;
  m.steps = advance(ice, (periods + 0.5) / exact, [&](double time, double) {
    double share = 0;
    for (const sph::Motion& p : ice.particles().motion) share += p.velocity.dot(mode(p.position, k));
    if (share * before < 0) {
      last = time_before + (time - time_before) * before / (before - share);
      if (zeros++ == 0) first = last;
    }
    before = share, time_before = time;
  });
  m.errors = {std::abs(0.5 * (zeros - 1) / (last - first) / exact - 1)};
  return m;
}

}  // namespace

VerificationCase breathing_sphere() {
  return {.name = "V15-breathing-sphere",
          .title = "The first breathing mode of a free elastic ice ball of 61 mm",
          .reference = "Lamb 1882: x cot x = 1 - x^2 (c_p/c_s)^2/4, x = 2.7363, f = 56.11 kHz",
          .metrics = {{"frequency", 0.03}},
          .resolutions = {15, 20, 30, 40},
          .stated_resolution = 30,
          .quick = 3,
          .tested = 3,
          .compared = 2,
          .run = run};
}

}  // namespace nilas::cases
