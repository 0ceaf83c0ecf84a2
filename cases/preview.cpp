#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "cases/run.hpp"
#include "coupling/stability_number.hpp"
#include "sph/contact.hpp"
#include "sph/kernel.hpp"
#include "sph/lattice.hpp"
#include "sph/neo_hookean.hpp"
#include "sph/reduced_stiffness.hpp"
#include "sph/terms.hpp"
#include "sph/time_step.hpp"

namespace nilas::cases {

namespace {

// For estimates only: a run reports what it really used.
constexpr double kBytesOfProgram = 28e6;           // what a run of some particles holds
constexpr double kBytesPerBoundaryParticle = 600;  // sample, world copy, impulses, a frame's rows
constexpr double kBytesBeside = 200;               // per particle: a frame on its way to the file, sums

constexpr double kMostSteps = 1e10;  // a month of a small scene
constexpr double kMostFrames = 1e6;
constexpr double kShockWarning = 0.1;  // of the P-wave speed

/// Bytes of state, copies for the pair loops and neighbour list per particle.
double bytes_per_particle(const sph::IceSpec& ice) {
  const bool single = ice.numerics.precision == sph::Precision::single, corrected = ice.numerics.gradient_correction;
  const double state = sizeof(sph::Motion) + sizeof(sph::Sym3) * (corrected ? 2 : 1) +
                       sizeof(Mat3) * (ice.material.model == sph::Model::neo_hookean ? 2 : 1) + 3 * sizeof(Vec3) + 64;
  const double copies = single ? sizeof(float) * sph::PairRecords<float>::stride(corrected)
                               : sizeof(double) * sph::PairRecords<double>::stride(corrected);
  // Groups of 2 x 2 x 2 particles (2 x 2 x 1 in double) that come within reach of one: the volume within reach of their
  // box over their own, in spacings (Steiner's formula for a box of sides 1, 1, c).
  const double reach = 2 * ice.numerics.smoothing_ratio * (1 + ice.numerics.skin_ratio), c = single ? 1 : 0;
  const double volume = c + 2 * (1 + 2 * c) * reach + std::numbers::pi * (2 + c) * reach * reach +
                        4 * std::numbers::pi / 3 * reach * reach * reach;
  const double list = sizeof(std::uint32_t) * (5 + volume / (single ? 8 : 4));
  return state + copies + list + kBytesBeside;
}

/// CPU time, measured on the HCC at 90 degrees, 42 thousand particles.
double seconds_per_particle_step(const sph::NumericsSpec& numerics) {
  const double plain = numerics.precision == sph::Precision::single ? 0.5e-6 : 0.7e-6;
  return plain + (numerics.gradient_correction ? 0.15e-6 : 0);
}

void warn_about_layers(const sph::IceSpec& ice, std::vector<std::string>& warnings) {
  for (const sph::PieceSpec& piece : ice.pieces) {
    const double thickness = piece.shape == sph::IceShape::disc    ? piece.thickness
                             : piece.shape == sph::IceShape::block ? piece.size.minCoeff()
                                                                   : piece.diameter;
    const double layers = thickness / ice.spacing;
    std::ostringstream text;
    if (layers < 4.5)
      text << "ice of " << layers << " spacings is under-resolved: bending and spall need five or more";
    else if (std::abs(layers - std::round(layers)) > 0.01)
      text << "the thickness is " << layers << " spacings; " << std::round(layers)
           << " layers of particles stand for it";
    if (!text.str().empty()) warnings.push_back(text.str());
  }
}

/// The lattice, with the scene's line in what it refuses.
sph::Particles make_lattice(const Scene& scene) {
  try {
    return sph::lattice(scene.ice);
  } catch (const std::invalid_argument& error) {
    std::ostringstream text;
    text << scene.spacing_source << ": ice.spacing_m = " << scene.ice.spacing << ": " << error.what();
    throw SceneError(text.str());
  }
}

void warn_about_surface(const rigid::BodySpec& spec, const sph::IceSpec& ice, std::vector<std::string>& warnings) {
  if (spec.boundary_spacing <= ice.spacing) return;
  std::ostringstream text;
  text << "body " << spec.name << ": its boundary particles are coarser (" << spec.boundary_spacing
       << " m) than the ice (" << ice.spacing << " m): the force is inaccurate; use three quarters of the ice's";
  warnings.push_back(text.str());
}

/// Contact would push that ice out with energy that nobody put in.
void refuse_ice_inside(const Scene& scene, std::size_t index, const sph::Particles& particles) {
  const rigid::BodySpec& spec = scene.bodies[index];
  const double reach = rigid::enclosing_radius(spec.shape, spec.mass.centre_of_mass);
  std::size_t inside = 0;
  double deepest = 0;
  for (const sph::Motion& m : particles.motion) {
    const Vec3 r = m.position - spec.position;
    if (r.squaredNorm() > reach * reach) continue;
    const Vec3 point = spec.orientation.conjugate() * r + spec.mass.centre_of_mass;
    const double depth = -rigid::closest_point(spec.shape, point).distance;
    if (depth > 1e-9 * reach) ++inside, deepest = std::max(deepest, depth);
  }
  if (inside == 0) return;
  std::ostringstream text;
  text << scene.body_sources[index] << ": body." << index << " (" << spec.name << "): " << inside
       << " ice particles start inside it, the deepest by " << deepest
       << " m, and would be pushed out with energy that nobody put in; allowed: a body.N.position_m (or ice.centre_m) "
          "that leaves the ice outside";
  throw SceneError(text.str());
}

/// Lowers the step to what the scene allows the exchange with its bodies; refuses one that can be unstable unless the
/// scene says how much it allows.
void limit_coupling(const Scene& scene, const std::vector<Body>& bodies, const sph::ElasticConstants& elastic,
                    sph::StepLimit& limit) {
  const double number = limit.dt * stability_rate(bodies, elastic, scene.ice.contact);
  const double allowed = scene.ice.numerics.max_coupling_number;
  if (allowed > 0) {
    if (number > allowed) limit = {limit.dt * allowed / number, sph::Limiter::coupling};
    return;
  }
  if (number < kStabilityLimit) return;
  std::ostringstream text;
  text << scene.body_sources.front() << ": coupling-stability number " << number
       << ": a body this light can be thrown off by one exchange with the ice (unstable from " << kStabilityLimit
       << "); allowed: numerics.max_coupling_number = 1, which takes " << std::ceil(number)
       << " times as many steps, or a larger number, which the energy ledger then has to bear out";
  throw SceneError(text.str());
}

/// Time would stand still: a step that end_time_s cannot feel, or more steps or frames than anyone can wait for.
void refuse_endless(const Scene& scene, const sph::StepLimit& limit) {
  const double steps = scene.run.end_time / limit.dt, frames = scene.run.end_time / scene.output.interval;
  std::ostringstream text;
  text << "run.end_time_s = " << scene.run.end_time << ": needs ";
  if (!(frames <= kMostFrames))
    text << frames << " frames at output.interval_s = " << scene.output.interval << "; allowed: at most " << kMostFrames
         << " frames";
  else if (!std::isfinite(steps))  // also a step that is no number, of a material beyond all range
    text << "more steps than can be counted; allowed: at most " << kMostSteps << " steps";
  else if (steps > kMostSteps)
    text << steps << " steps of " << limit.dt << " s, limited by " << sph::name(limit.limiter) << "; allowed: at most "
         << kMostSteps << " steps";
  else
    return;
  throw SceneError(text.str());
}

/// Mass and speed each within range can make an energy that is no number.
void refuse_boundless_energy(const Scene& scene, std::size_t index, const Body& body) {
  if (std::isfinite(body.kinetic_energy())) return;
  throw SceneError(
      scene.body_sources[index] + ": body." + std::to_string(index) + " (" + body.spec().name +
      "): its kinetic energy is too large to be a number; allowed: mass, speed and spin of a finite energy");
}

void warn_about_softening(const sph::IceSpec& stated, const sph::IceSpec& ice, std::vector<std::string>& warnings) {
  if (stated.numerics.sound_speed_scale == 1) return;
  std::ostringstream text;
  text << "the ice is softened for a larger step: numerics.sound_speed_scale = " << stated.numerics.sound_speed_scale
       << ", Young's modulus " << ice.material.young_modulus << " Pa in place of " << stated.material.young_modulus
       << " Pa; its forces are not those of the stated ice: nilas accuracy --economies measures the difference";
  warnings.push_back(text.str());
}

void warn_about_restless_ice(const sph::IceSpec& ice, std::vector<std::string>& warnings) {
  if (ice.numerics.quiet_speed == 0 || sph::has_quiet_ice(ice)) return;
  warnings.push_back(
      "numerics.quiet_speed_m_s is without effect: under gravity and with density diffusion, density re-initialisation "
      "or shifting no ice sleeps");
}

/// Largest speed between a body and a piece of ice, spin left aside [m/s].
double impact_speed(const Scene& scene) {
  double speed = 0;
  for (const rigid::BodySpec& body : scene.bodies)
    for (const sph::PieceSpec& piece : scene.ice.pieces)
      speed = std::max(speed, (body.velocity - piece.velocity).norm());
  return speed;
}

void warn_about_shocks(const Scene& scene, const sph::ElasticConstants& elastic, std::vector<std::string>& warnings) {
  const double mach = impact_speed(scene) / elastic.p_wave_speed();
  if (mach <= kShockWarning) return;
  std::ostringstream text;
  text << "the impact has " << mach << " of the speed of sound in the ice: pressure that is linear in density and ice "
       << "that does not melt are not valid there";
  if (scene.ice.numerics.viscosity_beta == 0) text << "; numerics.viscosity_beta = 2 spreads its shocks";
  warnings.push_back(text.str());
}

}  // namespace

Preview preview(const Scene& scene) {
  Preview p;
  const double estimated = sph::estimated_particles(scene.ice);
  p.memory_bytes = kBytesOfProgram + estimated * bytes_per_particle(scene.ice);
  for (const rigid::BodySpec& body : scene.bodies)
    p.memory_bytes +=
        kBytesPerBoundaryParticle * rigid::surface_area(body.shape) / (body.boundary_spacing * body.boundary_spacing);
  p.machine_memory_bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (p.memory_bytes > p.machine_memory_bytes) {
    std::ostringstream text;
    text << scene.spacing_source << ": ice.spacing_m = " << scene.ice.spacing << ": makes about " << estimated
         << " particles that need, with the boundary particles (body.N.spacing_m), " << p.memory_bytes / 1e9
         << " GB; allowed: a scene that fits into this machine's " << p.machine_memory_bytes / 1e9 << " GB";
    throw SceneError(text.str());
  }
  const sph::Particles particles = make_lattice(scene);
  p.particles = particles.size();

  const sph::IceSpec ice = sph::with_reduced_stiffness(scene.ice);
  const sph::ElasticConstants elastic(ice.material);
  const sph::ContactConstants contact(scene.ice.contact, elastic, scene.ice.spacing);
  double speed = 0;
  for (const sph::PieceSpec& piece : scene.ice.pieces)
    speed = std::max(speed, (piece.velocity - scene.ice.pieces.front().velocity).norm());
  const double mass = elastic.density * std::pow(scene.ice.spacing, 3);
  p.warnings = scene.notes;
  const double h = scene.ice.numerics.smoothing_ratio * scene.ice.spacing;
  sph::StepLimit limit = sph::stable_step(ice.numerics, elastic, contact, mass, h, speed, 0, !scene.bodies.empty(),
                                          sph::kelvin_voigt_viscosity(ice.material, h));
  const std::vector<Body> bodies(scene.bodies.begin(), scene.bodies.end());
  refuse_endless(scene, limit);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    refuse_boundless_energy(scene, k, bodies[k]);
    refuse_ice_inside(scene, k, particles);
  }
  limit_coupling(scene, bodies, elastic, limit);
  p.step = limit.dt;
  p.limiter = sph::name(limit.limiter);
  p.steps = std::ceil(scene.run.end_time / limit.dt);
  refuse_endless(scene, limit);  // once more, with the step that the bodies allow
  warn_about_softening(scene.ice, ice, p.warnings);
  warn_about_restless_ice(ice, p.warnings);
  warn_about_shocks(scene, elastic, p.warnings);
  p.seconds =
      p.steps * static_cast<double>(p.particles) * seconds_per_particle_step(ice.numerics) / omp_get_max_threads();
  p.terms_left_out = sph::terms_left_out(scene.ice, !scene.bodies.empty());
  warn_about_layers(scene.ice, p.warnings);

  const bool friction = scene.ice.contact.stick || scene.ice.contact.friction_coefficient > 0;
  for (const Body& body : bodies) {
    const rigid::BodySpec& spec = body.spec();
    p.boundary_particles += body.surface_body().size();
    warn_about_surface(spec, scene.ice, p.warnings);
    const StabilityNumber n = stability_number(body, elastic, friction, limit.dt);
    p.coupling_stability_number = std::max(p.coupling_stability_number, n.largest());
    if (n.largest() <= kStabilityWarning) continue;
    std::ostringstream text;
    text << "body " << spec.name << ": coupling-stability number " << n.largest() << " (translation " << n.translation
         << ", pitch " << n.pitch << ", roll " << n.roll << ") is above " << kStabilityWarning
         << "; the explicit exchange can be unstable from " << kStabilityLimit
         << "; numerics.max_coupling_number lowers it by a shorter step";
    p.warnings.push_back(text.str());
  }
  return p;
}

}  // namespace nilas::cases
