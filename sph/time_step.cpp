#include "sph/time_step.hpp"

#include <cmath>

namespace nilas::sph {

const char* name(Limiter limiter) {
  switch (limiter) {
    case Limiter::sound_speed:
      return "sound speed";
    case Limiter::acceleration:
      return "acceleration";
    case Limiter::viscosity:
      return "viscosity";
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
                      double particle_mass, double h, double speed, double acceleration, bool has_contact) {
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
  if (has_contact) {
    const double omega = std::sqrt(contact.stiffness / particle_mass);
    const double zeta = 0.5 * contact.normal_damping / (particle_mass * omega);
    lower(2 * numerics.cfl / (omega * (std::sqrt(1 + zeta * zeta) + zeta)), Limiter::contact);
  }
  if (numerics.max_step > 0) lower(numerics.max_step, Limiter::max_step);
  return limit;
}

}  // namespace nilas::sph
