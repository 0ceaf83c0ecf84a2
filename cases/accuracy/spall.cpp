// V12: a slab of ice spalls where a compression pulse is reflected at its free face. The layer x < a of the slab starts
// with velocity V, over a ramp r down to 0: until tension fails the ice, with F the start's velocity continued as an
// even function about both faces,
//
//   v = (F(x - ct) + F(x + ct))/2,   sigma_xx = rho c_p (F(x + ct) - F(x - ct))/2:
//
// a trapezoid of compression, peak S = rho c_p V/2, no tension before the reflection. Uniaxial compression never yields
// this ice (physics reference A.11). The reflected front meets the pulse's tail at a depth a below the far face, and
// there the tension grows evenly, 2 S (ct - L)/r, over what is left of the ramps. The ice yields at
//
//   sigma_y = k / ((1 - 2nu)/((1 - nu) sqrt 3) + alpha (1 + nu)/(1 - nu)) = 0.672 MPa
//
// and, being perfectly plastic here, carries at most the tension of the cone's apex, k/(3 alpha) = c/tan(phi) =
// 0.798 MPa.
#include "cases/accuracy/advance.hpp"
#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/periodic_bar.hpp"
#include "cases/material_presets.hpp"
#include "sph/drucker_prager.hpp"

namespace nilas::cases {

namespace {

constexpr double length = 1, depth = 0.2, ramp = 0.1;  // m, L, a, r
constexpr double peak = 1e6;                           // Pa, S

/// Axial stress at first yield in uniaxial tension strain [Pa].
double yield_stress(const sph::MaterialSpec& ice) {
  const double tan_phi = std::tan(ice.friction_angle_deg * std::numbers::pi / 180), nu = ice.poisson_ratio;
  const double root = std::sqrt(9 + 12 * tan_phi * tan_phi);
  return 3 * ice.cohesion / root / ((1 - 2 * nu) / ((1 - nu) * std::sqrt(3.)) + tan_phi / root * (1 + nu) / (1 - nu));
}

/// What failed first.
struct FirstYield {
  double time = 0;    // s
  double place = 0;   // m, mean x of the particles that yielded in that step
  double stress = 0;  // Pa, largest axial stress among them
};
FirstYield first_yield(const sph::Ice& ice, double time) {
  FirstYield first{.time = time};
  const sph::Particles& p = ice.particles();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!p.failed[i]) continue;
    first.place += p.motion[i].position[0] / static_cast<double>(ice.failed_count());
    first.stress = std::max(first.stress, p.stress[i].xx);
  }
  return first;
}

Measurement run(const Scheme& scheme, int cells_per_depth) {
  Measurement m;
  m.resolution = m.spacing = depth / cells_per_depth;
  sph::IceSpec spec = periodic_bar(scheme, m.spacing, length);
  spec.material = cai_2025_ice();
  spec.material.after_failure = sph::AfterFailure::plastic;
  const sph::ElasticConstants elastic(spec.material);
  const double V = 2 * peak / elastic.impedance(), c = elastic.p_wave_speed();
  sph::Ice ice(spec, {}, {.velocity = [&](const Vec3& x) {
                 return Vec3(V * std::clamp(0.5 - (x[0] - depth) / ramp, 0., 1.), 0, 0);
               }});
  m.particles = ice.particles().size();

  FirstYield first;
  double tension = 0;  // Pa, largest axial one anywhere, ever
  m.steps = advance(ice, (length + 2 * depth) / c, [&](double time, double) {
    if (first.time == 0 && ice.failed_count() > 0) first = first_yield(ice, time);
    for (const sph::Sym3& s : ice.particles().stress) tension = std::max(tension, s.xx);
  });
  const double expected = yield_stress(spec.material);
  const double apex = spec.material.cohesion / std::tan(spec.material.friction_angle_deg * std::numbers::pi / 180);
  m.errors = {std::abs(first.stress / expected - 1),
              std::abs(first.time * c / (length + ramp / 2 * expected / peak) - 1),
              std::abs(first.place - (length - depth)) / m.spacing, std::max(0., tension / apex - 1),
              std::max(0., 1 - tension / apex)};
  return m;
}

}  // namespace

VerificationCase spall() {
  return {.name = "V12-spall",
          .title = "A trapezoidal compression pulse is reflected at the free face of an ice slab",
          .reference =
              "d'Alembert's solution until first yield; Drucker-Prager in uniaxial strain: 0.672 MPa, apex 0.798 MPa",
          .metrics = {{"stress at first yield", 0.05},
                      {"time of first yield", 0.05},
                      {"place of first yield, in spacings", 1},
                      {"largest tension above the apex", 1e-6},
                      {"largest tension below the apex"}},
          .resolutions = {10, 20, 40},
          .stated_resolution = 20,
          .quick = 3,
          .tested = 2,
          .compared = 0,
          .run = run};
}

}  // namespace nilas::cases
