#include "sph/time_step.hpp"

#include <cmath>

#include "sph/hourglass_control.hpp"

namespace nilas::sph {

const char* name(Limiter limiter) {
  switch (limiter) {
    case Limiter::sound_speed:
      return "sound speed";
    case Limiter::acceleration:
      return "acceleration";
    case Limiter::viscosity:
      return "viscosity";
    case Limiter::density_diffusion:
      return "density diffusion";
    case Limiter::kelvin_voigt:
      return "Kelvin-Voigt damping";
    case Limiter::hourglass_control:
      return "hourglass control";
    case Limiter::contact:
      return "contact";
    case Limiter::max_step:
      return "numerics.max_step_s";
    case Limiter::body_rotation:
      return "body rotation";
    case Limiter::body_speed:
      return "body speed";
    case Limiter::coupling:
      return "numerics.max_coupling_number";
  }
  return "";
}

StepLimit stable_step(const NumericsSpec& numerics, const ElasticConstants& elastic, const ContactConstants& contact,
                      double particle_mass, double h, double speed, double acceleration, bool has_contact,
                      double kelvin_voigt_viscosity) {
  const double c = numerics.cfl_sound_speed == SoundSpeed::bulk ? elastic.bulk_sound_speed() : elastic.p_wave_speed();
  StepLimit limit{numerics.cfl * h / (c + speed), Limiter::sound_speed};
  const auto lower = [&](double dt, Limiter limiter) {
    if (dt < limit.dt) limit = {dt, limiter};
  };
  if (acceleration > 0) lower(numerics.cfl * std::sqrt(h / acceleration), Limiter::acceleration);
  if (numerics.viscosity_alpha > 0) {
    const double longitudinal_viscosity = 0.3 * numerics.viscosity_alpha * h * elastic.bulk_sound_speed();
    lower(0.4 * numerics.cfl * h * h / longitudinal_viscosity, Limiter::viscosity);
  }
  if (numerics.density_diffusion > 0)
    lower(numerics.cfl * h / (7 * numerics.density_diffusion * elastic.bulk_sound_speed()), Limiter::density_diffusion);
  if (kelvin_voigt_viscosity > 0)
    lower(0.4 * numerics.cfl * h * h * elastic.density / kelvin_voigt_viscosity, Limiter::kelvin_voigt);
  if (numerics.hourglass_control > 0) {
    const double stiffness = 1.35 * elastic.p_wave_modulus() + 7 * numerics.hourglass_control * elastic.shear_modulus;
    const double zeta = HourglassControl::kDampingRatio;
    lower(2 * numerics.cfl * h / std::sqrt(stiffness / elastic.density) * (std::sqrt(1 + zeta * zeta) - zeta),
          Limiter::hourglass_control);
  }
  if (has_contact) {
    const double omega = std::sqrt(contact.stiffness / particle_mass);
    const double zeta = 0.5 * contact.normal_damping / (particle_mass * omega);
    lower(2 * numerics.cfl / (omega * (std::sqrt(1 + zeta * zeta) + zeta)), Limiter::contact);
  }
  if (numerics.max_step > 0) lower(numerics.max_step, Limiter::max_step);
  return limit;
}

}  // namespace nilas::sph
