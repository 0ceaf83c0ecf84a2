#include "cases/recorder.hpp"

#include <algorithm>
#include <numbers>
#include <sstream>
#include <string_view>

namespace nilas::cases {

namespace {

// A ledger counts as open when it has been beyond its bound for this many steps on end: at the first touch the energy
// of grid-scale waves is uncertain by (omega dt)^2 / 8 of itself, which is not a failure.
constexpr std::size_t kStepsOpen = 50;
constexpr std::size_t kStepsOpenAtEnd = 10;  // at the end of a run, when no more steps can show it

constexpr double kDegrees = 180 / std::numbers::pi;

Vec3 axis_of(const rigid::State& state) { return state.orientation * Vec3::UnitZ(); }

void append_vector_names(std::vector<std::string>& names, const std::string& stem, const std::string& unit) {
  for (const char* axis : {"x", "y", "z"}) names.push_back(stem + "_" + axis + unit);
}

std::vector<std::string> history_columns(const std::vector<rigid::BodySpec>& bodies) {
  std::vector<std::string> names{"time_s", "step", "dt_s"};
  for (const rigid::BodySpec& body : bodies) {
    const std::string p = bodies.size() > 1 ? body.name + "." : "";
    append_vector_names(names, p + "force", "_N");
    append_vector_names(names, p + "moment", "_N_m");
    append_vector_names(names, p + "impulse", "_N_s");
    append_vector_names(names, p + "position", "_m");
    append_vector_names(names, p + "velocity", "_m_s");
    append_vector_names(names, p + "axis", "");
    names.push_back(p + "attitude_deg");
    append_vector_names(names, p + "angular_velocity", "_rad_s");
    names.push_back(p + "penetration_m");
  }
  append_vector_names(names, "momentum", "_N_s");
  append_vector_names(names, "angular_momentum", "_N_m_s");
  append_vector_names(names, "rim_impulse", "_N_s");
  append_vector_names(names, "rim_angular_impulse", "_N_m_s");
  for (const char* name : {"kinetic_ice_J", "kinetic_bodies_J", "elastic_J", "plastic_J", "viscous_J",
                           "stabilisation_J", "contact_J", "absorbed_J", "external_J", "energy_residual",
                           "momentum_residual", "angular_momentum_residual", "failed_fraction"})
    names.push_back(name);
  return names;
}

void append(std::vector<double>& row, const Vec3& v) { row.insert(row.end(), v.data(), v.data() + 3); }

template <class Get>
Field scalar_field(const sph::Particles& p, const std::vector<std::uint32_t>& order, const char* name, const Get& get) {
  Field field{name, 1, std::vector<float>(p.size())};
  for (std::size_t n = 0; n < order.size(); ++n) field.values[n] = static_cast<float>(get(order[n]));
  return field;
}

}  // namespace

double attitude_deg(const rigid::State& state) {
  const Vec3 axis = axis_of(state);
  return std::atan2(axis.z(), axis.head<2>().norm()) * kDegrees;
}

double attitude_change_deg(const Vec3& initial_axis, const rigid::State& state) {
  const Vec3 axis = axis_of(state);
  return std::atan2(initial_axis.cross(axis).norm(), initial_axis.dot(axis)) * kDegrees;
}

std::vector<BodyDescription> describe(const std::vector<Body>& bodies) {
  std::vector<BodyDescription> descriptions;
  for (const Body& body : bodies) {
    BodyDescription d{body.spec().name, rigid::name(body.spec().shape), {}, {}, {}, rigid::outline(body.spec().shape)};
    for (const rigid::SurfacePoint& p : body.surface_body()) {
      d.boundary_position_body.push_back(p.position);
      d.boundary_normal_body.push_back(p.normal);
      d.boundary_area.push_back(p.area);
    }
    for (Vec3& p : d.outline_body) p -= body.spec().mass.centre_of_mass;
    descriptions.push_back(std::move(d));
  }
  return descriptions;
}

Recorder::Recorder(const Scene& scene, const std::filesystem::path& directory, double force_window)
    : bounds_(scene.run),
      history_interval_(scene.output.history_interval),
      bodies_(scene.bodies.size(), BodyRecord(force_window, scene.output.loads_interval)),
      history_(directory / "history.csv", history_columns(scene.bodies)) {
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    bodies_[k].initial_axis = scene.bodies[k].orientation.normalized() * Vec3::UnitZ();
}

void Recorder::accumulate(const Impact& impact) {
  const StepRecord& step = impact.last_step();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    BodyRecord& record = bodies_[k];
    const sph::Surface& surface = impact.surfaces()[k];
    const Body& body = impact.bodies()[k];
    record.peak.add(step.time, step.dt, surface.force);
    record.loads.add(step.time, body.account());
    record.impulse.resize(surface.particles.size(), Vec3::Zero());
    for (std::size_t b = 0; b < surface.particles.size(); ++b)
      record.impulse[b] += step.dt * surface.particles[b].force;
    record.row_penetration = std::max(record.row_penetration, impact.ice().penetration(k));
    largest_penetration_ = std::max(largest_penetration_, record.row_penetration);
    record.largest_angular_velocity = std::max(record.largest_angular_velocity, body.angular_velocity().norm());
    record.largest_attitude_change_deg =
        std::max(record.largest_attitude_change_deg, attitude_change_deg(record.initial_axis, body.state()));
  }
}

void Recorder::write_loads(const std::filesystem::path& directory, const std::vector<Body>& bodies) const {
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const std::string name = bodies_.size() > 1 ? "loads-" + bodies[k].spec().name : "loads";
    write_load_record(bodies_[k].loads, directory / (name + ".csv"));
  }
}

bool Recorder::row_due(const Impact& impact) const { return impact.last_step().time >= next_row_ * (1 - 1e-12); }

std::string Recorder::observe(const Impact& impact, const LedgerEntry& ledger) {
  record_row(impact, ledger);
  for (LedgerCheck& check : checks(ledger))
    if (check.watch.open_for(step_) >= kStepsOpen) return check.sentence();
  return {};
}

std::string Recorder::finish(const Impact& impact, const LedgerEntry& ledger) {
  if (impact.last_step().time > last_row_) record_row(impact, ledger);
  for (LedgerCheck& check : checks(ledger))
    if (check.watch.unclosed_for(step_) >= kStepsOpenAtEnd) return check.sentence();
  // However few the steps: this is no uncertainty of a first touch.
  if (energy_ratio_ > 1 + bounds_.energy_bound) return checks(ledger)[2].sentence();
  return {};
}

void Recorder::record_row(const Impact& impact, const LedgerEntry& ledger) {
  ledger_ = ledger;
  step_ = impact.last_step().number;
  history_.append(row(impact));
  note_energy(ledger);
  last_row_ = impact.last_step().time;
  next_row_ = last_row_ + history_interval_;
  for (LedgerCheck& check : checks(ledger)) check.watch.note(step_, check.residual <= check.bound);
}

void Recorder::note_energy(const LedgerEntry& l) {
  const double put_in = l.start + l.external;
  const double now = l.kinetic_ice + l.kinetic_bodies + l.elastic;
  if (put_in > 0) energy_ratio_ = now / put_in;
  energy_growth_ = std::max(energy_growth_, energy_ratio_);
}

std::array<Recorder::LedgerCheck, 3> Recorder::checks(const LedgerEntry& l) {
  return {{{l.momentum_residual, bounds_.momentum_bound, "momentum", "momentum_bound", watches_[0]},
           {l.angular_momentum_residual, bounds_.angular_momentum_bound, "angular momentum", "angular_momentum_bound",
            watches_[1]},
           {l.energy_residual, bounds_.energy_bound, "energy", "energy_bound", watches_[2]}}};
}

std::string Recorder::LedgerCheck::sentence() const {
  std::ostringstream text;
  text << "the ledger of " << what << " does not close: relative residual " << residual << ", bound " << bound
       << " (run." << key << "); ";
  if (std::string_view(key) == "angular_momentum_bound")
    text << "forces between ice particles with shear are not central: a finer ice.spacing_m closes it";
  else
    text << "the step may be too long (numerics.cfl), the exchange unstable (numerics.max_coupling_number), a body's "
         << "boundary particles coarser than the ice (body.N.spacing_m), or ice pressed against a body from the start "
         << "(impact.gap_m, body.N.position_m)";
  return text.str();
}

/// Forces and moments of a row are means since the previous row.
std::vector<double> Recorder::row(const Impact& impact) {
  const StepRecord& step = impact.last_step();
  const double interval = step.time - last_row_;
  std::vector<double> values{step.time, static_cast<double>(step.number), step.dt};
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Body& body = impact.bodies()[k];
    const BodyAccount& account = body.account();
    BodyRecord& record = bodies_[k];
    const Vec3 force = (account.ice_impulse - record.row_impulse) / interval;
    const Vec3 moment = (account.ice_angular_impulse - record.row_angular_impulse) / interval;
    record.row_impulse = account.ice_impulse;
    record.row_angular_impulse = account.ice_angular_impulse;
    append(values, force);
    append(values, moment);
    append(values, account.ice_impulse);
    append(values, body.state().position);
    append(values, body.velocity());
    append(values, axis_of(body.state()));
    values.push_back(attitude_deg(body.state()));
    append(values, body.angular_velocity());
    values.push_back(record.row_penetration);
    record.row_penetration = 0;
  }
  const LedgerEntry& l = ledger_;
  for (const Vec3& v : {l.momentum, l.angular_momentum, l.held_impulse, l.held_angular_impulse}) append(values, v);
  for (const double v : {l.kinetic_ice, l.kinetic_bodies, l.elastic, l.plastic, l.viscous, l.stabilisation, l.contact,
                         l.absorbed, l.external, l.energy_residual, l.momentum_residual, l.angular_momentum_residual,
                         impact.ice().failed_fraction()})
    values.push_back(v);
  return values;
}

IceFrame Recorder::ice_frame(const Impact& impact) const {
  const sph::Particles& p = impact.ice().particles();
  const std::vector<std::uint32_t> order = impact.ice().creation_order();
  IceFrame frame{impact.last_step().time, std::vector<Vec3>(p.size()), {}};
  Field velocity{"velocity_m_s", 3, std::vector<float>(3 * p.size())};
  for (std::size_t n = 0; n < order.size(); ++n) {
    frame.position[n] = p.motion[order[n]].position;
    for (int k = 0; k < 3; ++k) velocity.values[3 * n + k] = static_cast<float>(p.motion[order[n]].velocity[k]);
  }
  frame.fields.push_back(std::move(velocity));
  const auto add = [&](const char* name, const auto& get) {
    frame.fields.push_back(scalar_field(p, order, name, get));
  };
  add("pressure_Pa", [&](std::size_t i) { return -sph::trace(p.stress[i]) / 3; });
  add("von_mises_Pa", [&](std::size_t i) { return sph::von_mises(p.stress[i]); });
  add("density_kg_m3", [&](std::size_t i) { return p.density(i); });
  if (!p.plastic_strain.empty()) {
    add("plastic_strain", [&](std::size_t i) { return p.plastic_strain[i]; });
    add("failed", [&](std::size_t i) { return p.failed[i]; });
  }
  if (!p.tensile_damage.empty()) {
    add("tensile_damage", [&](std::size_t i) { return p.tensile_damage[i]; });
    add("shear_damage", [&](std::size_t i) { return p.shear_damage[i]; });
  }
  return frame;
}

std::vector<BodyFrame> Recorder::body_frames(const Impact& impact) {
  std::vector<BodyFrame> frames;
  const double time = impact.last_step().time;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Body& body = impact.bodies()[k];
    BodyRecord& record = bodies_[k];
    record.impulse.resize(body.surface_body().size(), Vec3::Zero());
    record.impulse_at_frame.resize(record.impulse.size(), Vec3::Zero());
    BodyFrame frame{body.state(), body.velocity(), body.angular_velocity(), {}, record.impulse};
    for (std::size_t b = 0; b < record.impulse.size(); ++b) {
      const double area_time = body.surface_body()[b].area * (time - last_frame_);
      const Vec3 gained = record.impulse[b] - record.impulse_at_frame[b];
      frame.traction.push_back(area_time > 0 ? Vec3(gained / area_time) : Vec3::Zero().eval());
    }
    record.impulse_at_frame = record.impulse;
    frames.push_back(std::move(frame));
  }
  last_frame_ = time;
  return frames;
}

}  // namespace nilas::cases
