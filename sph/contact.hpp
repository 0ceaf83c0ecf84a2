// Contact between ice particles and the boundary particles of one body: damped penalty with optional friction or stick.
//
// For ice particle i near a surface, with weights over the surface's boundary particles b
//     w_b = A_b W(|tangential part of x_i - x_b|),   W: Wendland C2, h_b = 1.2 boundary spacings
// (only those b within reach that face the same way as the nearest one: the far face of a thin plate has no say)
//     n = SUM w_b n_b / |SUM w_b n_b|,  v = v_i - SUM w_b v_b / SUM w_b
//     g = SUM w_b (x_i - x_b).(n_b + n)/2 / SUM w_b      (gap between particle centre and surface)
// (with n_b alone the gap is measured to the tangent planes, and a surface of radius R stands t^2/(2R) proud of itself;
// with the mean of n_b and n that error cancels)
// it presses once the gap is below half a spacing:
//     f_n = E max(0, stiffness M dx (dx/2 - g) - damping rho c_p dx^2 v.n),   M = rho c_p^2
// E = min(1, 2 SUM w_b / w_plane) fades the contact out past an edge of the surface; w_plane is the sum over an
// unbounded plane, so E = 1 wherever the surface covers half of the kernel.
// The tangential force opposes the slip, tangential_damping rho c_s dx^2 |v_t|, at most friction_coefficient f_n
// (stick: no such limit). The force on i and its opposite, shared over b by w_b, are applied at the same time: momentum
// closes.
//
// Known limits. Near a sharp edge the nearest boundary particle, and with it the facing surface, changes at once: with
// boundary particles as coarse as the ice a box can make energy there (booked in the ledger as energy made by contact);
// at three quarters of the ice's spacing it does not in the scenes tried. Boundary particles have no periodic images:
// in periodic ice a body either stays clear of the seam or reaches across it.
//
// Penalty form: found to behave in a prototype; it does not hold the ice off the surface as density-based contact does.
#pragma once

#include <span>
#include <vector>

#include "sph/boundary.hpp"
#include "sph/elastic_constants.hpp"
#include "sph/kernel.hpp"
#include "sph/particles.hpp"

#pragma GCC visibility push(default)

namespace nilas::sph {

struct ContactConstants {
  double spacing;          // m, of the ice
  double stiffness;        // N/m per ice particle
  double normal_damping;   // N s/m per ice particle
  double tangent_damping;  // N s/m per ice particle; 0: frictionless
  double friction;         // coefficient; infinite: stick

  ContactConstants(const ContactSpec& spec, const ElasticConstants& elastic, double spacing);
};

/// Force of one surface on one ice particle in this step.
struct ContactForce {
  std::uint32_t particle;
  Vec3 force;  // N, on the ice particle, world
};

/// Contact with one surface. Keeps a list of candidate pairs, found anew when the ice's neighbour list was rebuilt or
/// when the surface has moved farther than the skin.
class Contact {
 public:
  /// boundary_spacing: of this surface [m]. skin: of the ice's neighbour list [m].
  Contact(const ContactConstants& constants, double boundary_spacing, double skin);

  /// Forgets the candidates: the ice's neighbour list was rebuilt and its particles re-sorted.
  void invalidate() { stale_ = true; }

  /// Adds force/mass to the accelerations of touching ice particles and writes the surface's forces and moment: zero
  /// for a surface that is not present.
  void apply(Particles& particles, Surface& surface);

  /// Forces of the last apply(), for work and diagnostics.
  const std::vector<ContactForce>& forces() const { return forces_; }
  /// Deepest ice-particle centre behind the surface in the last apply() [m], >= 0.
  double penetration() const { return penetration_; }
  std::size_t bytes() const;

 private:
  struct Weight {
    std::uint32_t boundary;
    Vec3 separation;  // m, ice particle minus boundary particle
    double weight;
  };
  struct Candidate {
    std::uint32_t particle;
    std::uint32_t begin, end;  // boundary indices in pairs_
  };
  void find_candidates(const Particles& particles, std::span<const BoundaryParticle> surface);
  bool surface_moved(std::span<const BoundaryParticle> surface) const;
  /// The piece of surface that one ice particle meets.
  struct Patch {
    double weight;  // SUM w_b
    double gap;     // m
    Vec3 normal;    // unit, out of the body
    Vec3 velocity;  // m/s
  };
  using Weights = std::vector<Weight>;
  Patch average(const Weights& weights, std::span<const BoundaryParticle> surface) const;
  Vec3 penalty(const Patch& patch, const Vec3& slip) const;
  void weigh(const Vec3& position, const Candidate& candidate, std::span<const BoundaryParticle> surface,
             Weights& weights) const;
  /// What some candidates that follow each other exert: found by any thread, added up in order.
  struct Touch {
    std::uint32_t particle;
    Vec3 force;              // N, on the ice particle
    std::size_t begin, end;  // its shares
  };
  struct Batch {
    std::vector<Touch> touches;
    std::vector<std::pair<std::uint32_t, double>> shares;  // boundary particle, share of the force
    Weights weights;                                       // work space
    double penetration = 0;
  };
  void find_touches(const Particles& particles, std::span<const BoundaryParticle> surface, std::size_t begin,
                    std::size_t end, Batch& batch) const;

  ContactConstants constants_;
  WendlandC2 kernel_;
  double depth_;         // m, how far behind the surface ice is still pushed back
  double reach_;         // m, largest distance of a boundary particle that can carry weight
  double skin_;          // m
  double plane_weight_;  // 1/m, SUM w_b over an unbounded plane
  bool stale_ = true;
  double penetration_ = 0;
  std::vector<Candidate> candidates_;
  std::vector<std::uint32_t> pairs_;
  std::vector<Vec3> surface_origin_;  // positions when the candidates were found
  std::vector<Batch> batches_;
  std::vector<ContactForce> forces_;
};

}  // namespace nilas::sph

#pragma GCC visibility pop
