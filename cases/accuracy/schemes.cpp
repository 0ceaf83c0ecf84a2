#include "cases/accuracy/schemes.hpp"

namespace nilas::cases {

namespace {

/// nilas with one change.
template <class Change>
Scheme varied(const char* name, const Change& change) {
  Scheme scheme = nilas_scheme();
  scheme.name = name;
  change(scheme.numerics);
  return scheme;
}

Scheme stiffened(const char* name, double stiffness) {
  Scheme scheme = nilas_scheme();
  scheme.name = name;
  scheme.contact.stiffness = stiffness;
  return scheme;
}

}  // namespace

std::vector<Scheme> schemes_under_test() {
  using N = sph::NumericsSpec;
  return {nilas_scheme(),
          cai_2025_scheme(),
          varied("h/dx 1.1", [](N& n) { n.smoothing_ratio = 1.1; }),
          varied("h/dx 1.5", [](N& n) { n.smoothing_ratio = 1.5; }),
          varied("uncorrected", [](N& n) { n.gradient_correction = false; }),
          varied("uncorrected, h/dx 1.5", [](N& n) { n.gradient_correction = false, n.smoothing_ratio = 1.5; }),
          varied("no viscosity", [](N& n) { n.viscosity_alpha = n.viscosity_beta = 0; }),
          varied("alpha 0.3", [](N& n) { n.viscosity_alpha = 0.3; }),
          varied("alpha 1", [](N& n) { n.viscosity_alpha = 1; }),
          varied("cfl 0.3", [](N& n) { n.cfl = 0.3; }),
          varied("cfl 0.8", [](N& n) { n.cfl = 0.8; }),
          varied("artificial stress", [](N& n) { n.artificial_stress = 0.3; }),
          varied("hourglass control", [](N& n) { n.hourglass_control = 1; }),
          stiffened("contact stiffness 0.2", 0.2),
          stiffened("contact stiffness 2", 2),
          varied("p-wave cfl 0.6", [](N& n) { n.cfl_sound_speed = sph::SoundSpeed::p_wave; }),
          varied("density diffusion", [](N& n) { n.density_diffusion = 0.1; }),
          varied("density re-initialisation", [](N& n) { n.density_reinitialisation = 20; }),
          varied("shifting", [](N& n) { n.shifting = 0.1; }),
          varied("single precision", [](N& n) { n.precision = sph::Precision::single; })};
}

}  // namespace nilas::cases
