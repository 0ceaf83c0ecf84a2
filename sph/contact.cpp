#include "sph/contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace nilas::sph {

namespace {
constexpr double kBoundaryKernelRatio = 1.2;  // h_b / boundary spacing
constexpr double kDepthRatio = 2;             // depth_ / spacing
constexpr std::size_t kBatch = 128;           // candidates that one thread takes at a time

/// Integral of the three-dimensional kernel over a plane through its centre, INT W 2 pi t dt [1/m], as a sum so
/// that it cannot disagree with the kernel.
double integral_over_plane(const WendlandC2& kernel) {
  constexpr int kIntervals = 2000;
  const double dt = kernel.support_radius() / kIntervals;
  double sum = 0;
  for (int n = 0; n < kIntervals; ++n) {
    const double t = (n + 0.5) * dt;
    sum += kernel.value(t) * 2 * std::numbers::pi * t * dt;
  }
  return sum;
}

/// Boundary particles sorted into cubic cells over their bounding box, for one search.
class SurfaceGrid {
 public:
  SurfaceGrid(std::span<const BoundaryParticle> surface, double cell) : cell_(cell) {
    lower_ = upper_ = surface[0].position;
    for (const BoundaryParticle& b : surface) {
      lower_ = lower_.cwiseMin(b.position);
      upper_ = upper_.cwiseMax(b.position);
    }
    for (int k = 0; k < 3; ++k) cells_[k] = 1 + static_cast<int>((upper_[k] - lower_[k]) / cell_);
    start_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2] + 1, 0);
    for (const BoundaryParticle& b : surface) ++start_[index(coordinates(b.position)) + 1];
    for (std::size_t c = 0; c + 1 < start_.size(); ++c) start_[c + 1] += start_[c];
    items_.resize(surface.size());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (std::uint32_t b = 0; b < surface.size(); ++b) items_[next[index(coordinates(surface[b].position))]++] = b;
  }
  bool near_box(const Vec3& x) const {
    return (x.array() > lower_.array() - cell_).all() && (x.array() < upper_.array() + cell_).all();
  }
  template <class Visit>
  void visit_near(const Vec3& x, const Visit& visit) const {
    const Eigen::Array3i c = coordinates(x);
    for (int i = std::max(0, c[0] - 1); i <= std::min(cells_[0] - 1, c[0] + 1); ++i)
      for (int j = std::max(0, c[1] - 1); j <= std::min(cells_[1] - 1, c[1] + 1); ++j)
        for (int k = std::max(0, c[2] - 1); k <= std::min(cells_[2] - 1, c[2] + 1); ++k) {
          const std::size_t cell = index({i, j, k});
          for (std::uint32_t n = start_[cell]; n < start_[cell + 1]; ++n) visit(items_[n]);
        }
  }

 private:
  Eigen::Array3i coordinates(const Vec3& x) const { return ((x - lower_) / cell_).array().floor().cast<int>(); }
  std::size_t index(const Eigen::Array3i& c) const {
    return (static_cast<std::size_t>(c[0]) * cells_[1] + c[1]) * cells_[2] + c[2];
  }
  double cell_;
  Vec3 lower_, upper_;
  std::array<int, 3> cells_;
  std::vector<std::uint32_t> start_, items_;
};

}  // namespace

ContactConstants::ContactConstants(const ContactSpec& spec, const ElasticConstants& elastic, double dx)
    : spacing(dx),
      stiffness(spec.stiffness * elastic.p_wave_modulus() * dx),
      normal_damping(spec.damping * elastic.impedance() * dx * dx),
      tangent_damping(0),
      friction(spec.stick ? std::numeric_limits<double>::infinity() : spec.friction_coefficient) {
  const double shear_impedance = std::sqrt(elastic.shear_modulus * elastic.density);
  if (friction > 0) tangent_damping = spec.tangential_damping * shear_impedance * dx * dx;
}

Contact::Contact(const ContactConstants& constants, double boundary_spacing, double skin)
    : constants_(constants),
      kernel_(kBoundaryKernelRatio * boundary_spacing),
      depth_(kDepthRatio * constants.spacing),
      reach_(std::hypot(kernel_.support_radius(), depth_)),
      skin_(skin),
      plane_weight_(integral_over_plane(kernel_)) {}

bool Contact::surface_moved(std::span<const BoundaryParticle> surface) const {
  for (std::size_t b = 0; b < surface.size(); ++b)
    if ((surface[b].position - surface_origin_[b]).squaredNorm() > skin_ * skin_) return true;
  return false;
}

void Contact::find_candidates(const Particles& particles, std::span<const BoundaryParticle> surface) {
  candidates_.clear();
  pairs_.clear();
  surface_origin_.resize(surface.size());
  for (std::size_t b = 0; b < surface.size(); ++b) surface_origin_[b] = surface[b].position;
  // The ice may move up to one skin (half a skin either side of its last rebuild), the surface another.
  const double radius = reach_ + 2 * skin_;
  const SurfaceGrid grid(surface, radius);
  for (std::uint32_t i = 0; i < particles.size(); ++i) {
    const Vec3& x = particles.motion[i].position;
    if (!grid.near_box(x)) continue;
    const auto begin = static_cast<std::uint32_t>(pairs_.size());
    grid.visit_near(x, [&](std::uint32_t b) {
      if ((surface[b].position - x).squaredNorm() < radius * radius) pairs_.push_back(b);
    });
    if (pairs_.size() > begin) candidates_.push_back({i, begin, static_cast<std::uint32_t>(pairs_.size())});
  }
  stale_ = false;
}

/// Fills `weights` with the boundary particles that the surface at `position` is made of.
void Contact::weigh(const Vec3& position, const Candidate& candidate, std::span<const BoundaryParticle> surface,
                    Weights& weights) const {
  weights.clear();
  std::uint32_t nearest = 0;
  double nearest2 = reach_ * reach_;
  for (std::uint32_t n = candidate.begin; n < candidate.end; ++n) {
    const Vec3 d = position - surface[pairs_[n]].position;
    const double d2 = d.squaredNorm();
    if (d2 > reach_ * reach_) continue;
    weights.push_back({pairs_[n], d, 0});
    if (d2 < nearest2) nearest2 = d2, nearest = pairs_[n];
  }
  const Vec3 facing = weights.empty() ? Vec3::Zero().eval() : surface[nearest].normal;
  std::erase_if(weights, [&](Weight& w) {
    const BoundaryParticle& b = surface[w.boundary];
    const double gap = w.separation.dot(b.normal);
    const double tangential = std::sqrt(std::max(0.0, w.separation.squaredNorm() - gap * gap));
    w.weight = b.area * kernel_.value(tangential);
    return w.weight <= 0 || b.normal.dot(facing) <= 0 || std::abs(gap) > depth_;
  });
}

void Contact::apply(Particles& particles, Surface& surface) {
  const std::span<BoundaryParticle> boundary = surface.particles;
  for (BoundaryParticle& b : boundary) b.force.setZero();
  surface.force.setZero();
  surface.moment.setZero();
  forces_.clear();
  penetration_ = 0;
  if (!surface.present) return;
  if (stale_ || surface_moved(boundary)) find_candidates(particles, boundary);

  const std::size_t count = (candidates_.size() + kBatch - 1) / kBatch;
  if (batches_.size() < count) batches_.resize(count);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t k = 0; k < count; ++k)
    find_touches(particles, boundary, k * kBatch, std::min(candidates_.size(), (k + 1) * kBatch), batches_[k]);

  for (const Batch& batch : std::span(batches_).first(count)) {
    penetration_ = std::max(penetration_, batch.penetration);
    for (const Touch& touch : batch.touches) {
      const Vec3& force = touch.force;
      forces_.push_back({touch.particle, force});
      particles.acceleration[touch.particle] += force / particles.mass;
      for (std::size_t n = touch.begin; n < touch.end; ++n)
        boundary[batch.shares[n].first].force -= batch.shares[n].second * force;
      surface.force -= force;
      surface.moment -= (particles.motion[touch.particle].position - surface.reference).cross(force);
    }
  }
}

/// Candidates [begin, end) that touch, in order.
void Contact::find_touches(const Particles& particles, std::span<const BoundaryParticle> surface, std::size_t begin,
                           std::size_t end, Batch& batch) const {
  batch.touches.clear();
  batch.shares.clear();
  batch.penetration = 0;
  for (std::size_t c = begin; c < end; ++c) {
    const Candidate& candidate = candidates_[c];
    const Motion& ice = particles.motion[candidate.particle];
    weigh(ice.position, candidate, surface, batch.weights);
    const Patch patch = average(batch.weights, surface);
    if (patch.weight <= 0 || patch.gap >= 0.5 * constants_.spacing) continue;
    if (2 * patch.weight >= plane_weight_) batch.penetration = std::max(batch.penetration, -patch.gap);
    const Vec3 force = penalty(patch, ice.velocity - patch.velocity);
    if (force.isZero(0)) continue;
    const std::size_t first = batch.shares.size();
    for (const Weight& w : batch.weights) batch.shares.push_back({w.boundary, w.weight / patch.weight});
    batch.touches.push_back({candidate.particle, force, first, batch.shares.size()});
  }
}

/// Weighted means.
Contact::Patch Contact::average(const Weights& weights, std::span<const BoundaryParticle> surface) const {
  Patch patch{0, 0, Vec3::Zero(), Vec3::Zero()};
  for (const Weight& w : weights) {
    const BoundaryParticle& b = surface[w.boundary];
    patch.weight += w.weight;
    patch.normal += w.weight * b.normal;
    patch.velocity += w.weight * b.velocity;
  }
  if (patch.weight <= 0) return patch;
  patch.velocity /= patch.weight;
  patch.normal.normalize();
  for (const Weight& w : weights)
    patch.gap += 0.5 * w.weight * w.separation.dot(surface[w.boundary].normal + patch.normal);
  patch.gap /= patch.weight;
  return patch;
}

/// Force on the ice particle; slip: its velocity relative to the surface.
Vec3 Contact::penalty(const Patch& patch, const Vec3& slip) const {
  const double cover = std::min(1.0, 2 * patch.weight / plane_weight_);
  const double approach = -slip.dot(patch.normal);
  const double press = cover * std::max(0.0, constants_.stiffness * (0.5 * constants_.spacing - patch.gap) +
                                                 constants_.normal_damping * approach);
  Vec3 force = press * patch.normal;
  if (constants_.tangent_damping > 0) {
    const Vec3 tangential = slip + approach * patch.normal;
    const double speed = tangential.norm();
    const double drag = std::min(constants_.friction * press, cover * constants_.tangent_damping * speed);
    if (press > 0 && speed > 0) force -= (drag / speed) * tangential;
  }
  return force;
}

std::size_t Contact::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = of(candidates_) + of(pairs_) + of(surface_origin_) + of(forces_) + of(batches_);
  for (const Batch& batch : batches_) total += of(batch.touches) + of(batch.shares) + of(batch.weights);
  return total;
}

}  // namespace nilas::sph
