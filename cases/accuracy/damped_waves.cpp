// V11: a standing wave v = V sin(kx) in periodic ice, damped by artificial viscosity or by Kelvin-Voigt's stress,
// against the continuum's rates of decay (physics reference A.4, A.7), in units of c_b h k^2 with c_b = sqrt(K/rho):
//
//   artificial viscosity   alpha 3/40   nu_L = 3 alpha h c_b/10 in three dimensions, rate nu_L k^2/2, and half of that
//                                       because only pairs that approach are damped (half of the wave at any time)
//   Kelvin-Voigt           1/4          chi = rho c_b h/2 on the strain rate, rate chi k^2/(2 rho)
//
// The amplitude is A^2 = a^2 + (da/dt / omega)^2 with a the share of sin(kx) in the velocity, over whole periods.
#include <numbers>

#include "cases/accuracy/advance.hpp"
#include "cases/accuracy/catalogue.hpp"
#include "cases/accuracy/periodic_bar.hpp"

namespace nilas::cases {

namespace {

constexpr double wavelength = 1;  // m
constexpr double V = 0.01;        // m/s
constexpr double k = 2 * std::numbers::pi / wavelength;
constexpr int periods = 4;

double amplitude(const sph::Ice& ice, double omega) {
  const sph::Particles& p = ice.particles();
  double a = 0, slope = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double share = 2 * std::sin(k * p.motion[i].position[0]) / static_cast<double>(p.size());
    a += share * p.motion[i].velocity[0];
    slope += share * p.acceleration[i][0];
  }
  return std::hypot(a, slope / omega);
}

/// rate: in units of c_b h k^2.
Measurement measure(sph::IceSpec spec, double dx, double rate) {
  spec.periodic = {true, true, true};
  sph::Ice ice(spec, {}, {.velocity = [](const Vec3& x) { return Vec3(V * std::sin(k * x[0]), 0, 0); }});
  const sph::ElasticConstants& elastic = ice.elastic_constants();
  const double omega = k * elastic.p_wave_speed(), period = 2 * std::numbers::pi / omega;
  Measurement m;
  m.resolution = m.spacing = dx;
  m.particles = ice.particles().size();
  m.steps = advance(ice, period, [](double, double) {});
  const double before = amplitude(ice, omega);
  m.steps += advance(ice, periods * period, [](double, double) {});
  const double decay = std::log(before / amplitude(ice, omega)) / (periods * period);
  const double exact = rate * elastic.bulk_sound_speed() * ice.smoothing_length() * k * k;
  m.errors = {std::abs(decay / exact - 1)};
  return m;
}

Measurement run_viscous(const Scheme& scheme, int cells_per_wavelength) {
  const double dx = wavelength / cells_per_wavelength;
  sph::IceSpec spec = periodic_bar(scheme, dx, wavelength);
  spec.numerics.viscosity_alpha = 1;
  spec.numerics.viscosity_beta = 0;
  return measure(spec, dx, 3. / 40);
}

Measurement run_kelvin_voigt(const Scheme& scheme, int cells_per_wavelength) {
  const double dx = wavelength / cells_per_wavelength;
  sph::IceSpec spec = periodic_bar(scheme, dx, wavelength);
  spec.material.model = sph::Model::neo_hookean;
  spec.material.kelvin_voigt = 1;
  spec.numerics.viscosity_alpha = 0;
  spec.numerics.viscosity_beta = 0;
  return measure(spec, dx, 1. / 4);
}

VerificationCase damped_wave(const char* name, const char* title, const char* reference) {
  return {.name = name,
          .title = title,
          .reference = reference,
          .metrics = {{"rate of decay", 0.05}},
          .resolutions = {25, 50, 100},
          .stated_resolution = 50,
          .quick = 3,
          .tested = 2,
          .compared = 0,
          .run = {}};
}

}  // namespace

VerificationCase viscous_damping() {
  VerificationCase c =
      damped_wave("V11-artificial-viscosity", "A standing wave damped by artificial viscosity, alpha 1",
                  "Monaghan's viscosity in the continuum limit: 3 alpha c_b h k^2/40");
  c.run = run_viscous;
  return c;
}

VerificationCase kelvin_voigt_damping() {
  VerificationCase c = damped_wave("V11-kelvin-voigt", "A standing wave in neo-Hookean ice with Kelvin-Voigt damping",
                                   "linear viscoelasticity, chi = rho c_b h/2: c_b h k^2/4");
  c.run = run_kelvin_voigt;
  return c;
}

}  // namespace nilas::cases
