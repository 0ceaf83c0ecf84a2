#include "cases/summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cases/material_presets.hpp"
#include "cases/scene_words.hpp"

namespace nilas::cases {

namespace {

using Json = nlohmann::ordered_json;

Json array(const Vec3& v) { return {v[0], v[1], v[2]}; }

double peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

Json body_json(const Body& body, const BodyRecord& record) {
  const rigid::BodySpec& spec = body.spec();
  Json j;
  j["motion"] = words::word_of(words::motion, spec.motion);
  j["mass_kg"] = spec.mass.mass;
  j["inertia_kg_m2"] = array(spec.mass.inertia);
  j["peak_force_N"] = record.peak.raw();
  j["peak_force_raw_time_s"] = record.peak.raw_time();
  j["peak_force_filtered_N"] = record.peak.filtered();
  j["peak_force_time_s"] = record.peak.filtered_time();
  j["peak_force_components_N"] = array(record.peak.components());
  j["largest_force_components_N"] = array(record.peak.largest_components());
  j["impulse_N_s"] = array(body.account().ice_impulse);
  j["initial_velocity_m_s"] = array(spec.motion == rigid::Motion::fixed ? Vec3::Zero().eval() : spec.velocity);
  j["final_position_m"] = array(body.state().position);
  j["final_velocity_m_s"] = array(body.velocity());
  j["final_angular_velocity_rad_s"] = array(body.angular_velocity());
  j["largest_angular_velocity_rad_s"] = record.largest_angular_velocity;
  j["attitude_change_deg"] = attitude_change_deg(record.initial_axis, body.state());
  j["largest_attitude_change_deg"] = record.largest_attitude_change_deg;
  return j;
}

Json domain_json(const DomainReport& r) {
  if (r.whole_diameter == 0) return {{"kind", "full"}};
  return {{"kind", "auto"},
          {"diameter_m", r.diameter},
          {"whole_diameter_m", r.whole_diameter},
          {"reach_m", r.reach},
          {"out_energy_J", r.out_energy},
          {"exchanged_energy_J", r.exchanged_energy},
          {"earliest_echo_s", r.earliest_echo},
          {"peak_bound", r.peak_bound},
          {"impulse_bound", r.impulse_bound}};
}

}  // namespace

void write_summary(const std::filesystem::path& file, const Scene& scene, const Impact& impact,
                   const Recorder& recorder, const RunFacts& facts) {
  const std::size_t n = impact.ice().particles().size();
  const StepRecord& step = impact.last_step();
  std::size_t boundary_particles = 0;
  for (const sph::Surface& s : impact.surfaces()) boundary_particles += s.particles.size();
  Json j;
  j["scene"] = facts.scene_name;
  j["title"] = scene.title;
  j["ice"] = ice_name(scene.ice);
  j["sound_speed_scale"] = scene.ice.numerics.sound_speed_scale;
  j["quiet_speed_m_s"] = scene.ice.numerics.quiet_speed;
  j["stopped_by"] = facts.stopped_by;
  j["particles"] = n;
  j["boundary_particles"] = boundary_particles;
  j["spacing_m"] = scene.ice.spacing;
  j["steps"] = step.number;
  j["last_step_s"] = step.dt;
  j["limited_by"] = sph::name(step.limiter);
  j["simulated_time_s"] = step.time;
  j["end_time_s"] = scene.run.end_time;
  j["wall_time_s"] = facts.wall_time;
  j["threads"] = facts.threads;
  j["particle_steps_per_s"] =
      facts.wall_time > 0 ? static_cast<double>(n) * static_cast<double>(step.number) / facts.wall_time : 0;
  j["peak_rss_bytes"] = peak_rss_bytes();
  j["bytes_per_particle"] = static_cast<double>(impact.ice().bytes()) / static_cast<double>(n);
  j["force_window_s"] = facts.force_window;
  for (std::size_t k = 0; k < impact.bodies().size(); ++k) {
    const Json body = body_json(impact.bodies()[k], recorder.bodies()[k]);
    if (impact.bodies().size() == 1)
      j.update(body);
    else
      j["bodies"][impact.bodies()[k].spec().name] = body;
  }
  const LedgerEntry& l = recorder.ledger();
  j["momentum_residual"] = l.momentum_residual;
  j["angular_momentum_residual"] = l.angular_momentum_residual;
  j["energy_residual"] = l.energy_residual;
  j["momentum_N_s"] = array(l.momentum);
  j["angular_momentum_N_m_s"] = array(l.angular_momentum);
  j["rim_impulse_N_s"] = array(l.held_impulse);
  j["rim_angular_impulse_N_m_s"] = array(l.held_angular_impulse);
  j["energy_J"] = {{"kinetic_ice", l.kinetic_ice}, {"kinetic_bodies", l.kinetic_bodies},
                   {"elastic", l.elastic},         {"plastic", l.plastic},
                   {"viscous", l.viscous},         {"stabilisation", l.stabilisation},
                   {"contact", l.contact},         {"absorbed", l.absorbed},
                   {"external", l.external}};
  j["energy_growth"] = recorder.energy_growth();
  j["domain"] = domain_json(facts.domain);
  j["max_penetration_m"] = recorder.largest_penetration();
  j["failed_fraction"] = impact.ice().failed_fraction();
  j["coupling_stability_number"] = facts.coupling_stability_number;
  j["asleep_fraction"] = impact.ice().asleep_fraction();
  j["correction_fallbacks"] = impact.ice().correction_fallbacks();
  j["neighbour_rebuilds"] = impact.ice().rebuilds();
  j["terms_left_out"] = impact.ice().terms_left_out();
  j["calibrated"] = scene.calibrated;
  j["warnings"] = facts.warnings;

  std::ofstream out(file);
  // A name that is no UTF-8 is written with replacement characters rather than not at all.
  out << j.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
  if (!out.flush()) throw IoError("cannot write " + file.string());
}

std::string summary_text(const Scene& scene, const Impact& impact, const Recorder& recorder, const RunFacts& facts) {
  std::string text;
  for (std::size_t k = 0; k < impact.bodies().size(); ++k) {
    const Body& body = impact.bodies()[k];
    const ForcePeak& peak = recorder.bodies()[k].peak;
    const Vec3 dv = body.velocity() - body.spec().velocity, c = peak.components();
    text += fmt::format(
        "{}: peak force {:.4g} kN filtered ({:.3g} ms window) at {:.3g} ms, components [{:.4g}, {:.4g}, {:.4g}] kN; "
        "{:.4g} kN "
        "raw; ice: {}\n",
        body.spec().name, peak.filtered() / 1e3, facts.force_window * 1e3, peak.filtered_time() * 1e3, c[0] / 1e3,
        c[1] / 1e3, c[2] / 1e3, peak.raw() / 1e3, ice_name(scene.ice));
    if (body.moves_freely())
      text += fmt::format(
          "{}: velocity change [{:.4g}, {:.4g}, {:.4g}] m/s, attitude change {:.4g} deg at most, "
          "angular velocity {:.4g} rad/s at most\n",
          body.spec().name, dv[0], dv[1], dv[2], recorder.bodies()[k].largest_attitude_change_deg,
          recorder.bodies()[k].largest_angular_velocity);
  }
  text += describe(facts.domain);
  const LedgerEntry& l = recorder.ledger();
  text += fmt::format("ledger: momentum {:.2g}, angular momentum {:.2g}, energy {:.2g} (relative residuals)\n",
                      l.momentum_residual, l.angular_momentum_residual, l.energy_residual);
  text += fmt::format("{} steps of {} particles in {:.1f} s on {} threads, the last of {:.3g} us limited by {}\n",
                      impact.last_step().number, impact.ice().particles().size(), facts.wall_time, facts.threads,
                      impact.last_step().dt * 1e6, sph::name(impact.last_step().limiter));
  return text;
}

}  // namespace nilas::cases
