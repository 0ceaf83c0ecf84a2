// Where the benchmarks of single kernels meet the engine: ice in motion, and each kernel of a step as one call. A
// change of the engine's interfaces is followed here and nowhere else.
#pragma once

#include "sph/contact.hpp"
#include "sph/material.hpp"
#include "sph/neighbours.hpp"
#include "sph/pair_passes.hpp"
#include "sph/spec.hpp"

namespace nilas::benchmarks {

/// A disc of Drucker-Prager ice, 30 cm and 2 cm spacing, of about so many particles, as an impact leaves it: disordered
/// by a tenth of a spacing, ice within 10 cm of the axis thrown upwards and failed, waves elsewhere. A sphere of 30 cm
/// (less in a small disc) sits in a hole in its lower face.
class IceState {
 public:
  IceState(double particles, sph::PairTerms terms);

  void gradient_pass();
  void force_pass();
  void rebuild_neighbours();
  /// Half a step; every other call goes back, so that the state stays what it is.
  void update_stress();
  /// search: the candidates are found anew, as after a rebuild.
  void contact(bool search);

  double particles() const { return static_cast<double>(particles_.size()); }
  double touching() const { return static_cast<double>(contact_.forces().size()); }
  /// Per particle: neighbours within the kernel radius, and groups in the list, which hold more.
  double pairs() const { return pairs_; }
  double listed_groups() const { return groups_; }

 private:
  void count_pairs();

  sph::IceSpec spec_;
  sph::ElasticConstants elastic_;
  sph::WendlandC2 kernel_;
  double skin_;
  sph::Particles particles_;
  sph::Neighbours neighbours_;
  sph::PairPasses passes_;
  sph::PairConstants constants_;
  sph::Material material_;
  sph::Surface sphere_;
  sph::Contact contact_;
  double half_step_;  // s, its sign alternates
  double pairs_ = 0, groups_ = 0;
};

}  // namespace nilas::benchmarks
