#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "cases/run.hpp"
#include "coupling/stability_number.hpp"
#include "sph/contact.hpp"
#include "sph/kernel.hpp"
#include "sph/lattice.hpp"
#include "sph/terms.hpp"
#include "sph/time_step.hpp"

namespace nilas::cases {

namespace {

// For estimates only: a run reports what it really used.
constexpr double kBytesPerBoundaryParticle = 600;   // sample, world copy, impulses, a frame's rows
constexpr double kBytesBeside = 200;                // per particle: a frame on its way to the file, sums
constexpr double kSecondsPerParticleStep = 1.2e-6;  // CPU time, measured at 2 cm with the paper's terms

/// Bytes of state and neighbour list per particle.
double bytes_per_particle(const sph::IceSpec& ice) {
  const double reach = 2 * ice.numerics.smoothing_ratio * (1 + ice.numerics.skin_ratio);
  const double neighbours = 4.19 * reach * reach * reach;
  const double state = sizeof(sph::Motion) + sizeof(sph::Sym3) * (ice.numerics.gradient_correction ? 2 : 1) +
                       sizeof(Mat3) + 3 * sizeof(Vec3) + 64 +
                       (ice.numerics.precision == sph::Precision::single ? 2 : 0) * sizeof(sph::SingleRecord);
  // Four bytes per neighbour; pools grow by doubling, so half of one on average stands empty.
  return state + 4 * 1.5 * neighbours + kBytesBeside;
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

/// A surface that cannot be met well: coarser than the ice, or with ice inside it from the start.
void warn_about_surface(const Body& body, const sph::IceSpec& ice, const sph::Particles& particles,
                        std::vector<std::string>& warnings) {
  const rigid::BodySpec& spec = body.spec();
  std::ostringstream text;
  if (spec.boundary_spacing > ice.spacing)
    text << "body " << spec.name << ": its boundary particles are coarser (" << spec.boundary_spacing
         << " m) than the ice (" << ice.spacing << " m): the force is inaccurate; use three quarters of the ice's";
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
  if (inside > 0)
    text << (text.str().empty() ? "" : "; ") << "body " << spec.name << " starts with " << inside
         << " ice particles inside it, the deepest by " << deepest
         << " m: they are pushed out with energy that nobody put in; move position_m or raise gap_m";
  if (!text.str().empty()) warnings.push_back(text.str());
}

}  // namespace

Preview preview(const Scene& scene) {
  Preview p;
  const double estimated = sph::estimated_particles(scene.ice);
  p.memory_bytes = estimated * bytes_per_particle(scene.ice);
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

  const sph::ElasticConstants elastic(scene.ice.material);
  const sph::ContactConstants contact(scene.ice.contact, elastic, scene.ice.spacing);
  double speed = 0;
  for (const sph::PieceSpec& piece : scene.ice.pieces)
    speed = std::max(speed, (piece.velocity - scene.ice.pieces.front().velocity).norm());
  const double mass = elastic.density * std::pow(scene.ice.spacing, 3);
  const sph::StepLimit limit =
      sph::stable_step(scene.ice.numerics, elastic, contact, mass,
                       scene.ice.numerics.smoothing_ratio * scene.ice.spacing, speed, 0, !scene.bodies.empty());
  p.step = limit.dt;
  p.limiter = sph::name(limit.limiter);
  p.steps = std::ceil(scene.run.end_time / limit.dt);
  p.seconds = p.steps * static_cast<double>(p.particles) * kSecondsPerParticleStep / omp_get_max_threads();
  p.terms_left_out = sph::terms_left_out(scene.ice, !scene.bodies.empty());
  p.warnings = scene.notes;
  warn_about_layers(scene.ice, p.warnings);

  const bool friction = scene.ice.contact.stick || scene.ice.contact.friction_coefficient > 0;
  for (const rigid::BodySpec& spec : scene.bodies) {
    const Body body(spec);
    p.boundary_particles += body.surface_body().size();
    warn_about_surface(body, scene.ice, particles, p.warnings);
    const StabilityNumber n = stability_number(body, elastic, friction, limit.dt);
    p.coupling_stability_number = std::max(p.coupling_stability_number, n.largest());
    if (n.largest() <= kStabilityWarning) continue;
    std::ostringstream text;
    text << "body " << spec.name << ": coupling-stability number " << n.largest() << " (translation " << n.translation
         << ", pitch " << n.pitch << ", roll " << n.roll << ") is above " << kStabilityWarning
         << "; the explicit exchange is unstable at 2; a smaller numerics.max_step_s lowers it in proportion";
    p.warnings.push_back(text.str());
  }
  return p;
}

}  // namespace nilas::cases
