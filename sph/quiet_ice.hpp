// Quiet ice sleeps until a wave reaches it. (Whole ice at rest, of hosts, is another matter: coupling/rest.hpp.)
//
// Ice is untouched while its velocity, velocity gradient and stress are exactly zero. The particles are kept in blocks
// (neighbours.hpp), and a block of untouched ice sleeps: it is left out of both pair passes, the stress update, move
// and kick, and stays as it is. A particle stirs once it is faster than the quiet speed v_q, has a stress |sigma| > rho
// c_p v_q (what a wave of that speed carries), or is touched by a contact force. Every block wakes that holds a
// neighbour of a stirring particle or a neighbour of such a neighbour: within a step nothing gets farther than the two
// kernel radii of the two passes, so that what a stirring particle does meets ice that is awake. A block falls asleep
// again only where a new neighbour list draws the blocks anew and all in it is still untouched. Bit-identical for any
// number of threads.
//
// What it changes. Only ice that is slower than v_q and under less than rho c_p v_q (3.5 kPa at 1 mm/s) borders on
// sleeping ice, which holds it as fixed parts do: waves as weak as that come back from it, until a stronger one wakes
// it. The impulse on it is evaluated on the sleeping blocks next to awake ones and booked as held, so that momentum
// closes to round-off; it does no work, so that no energy is lost. With v_q -> 0 the run is that without sleep.
//
// There is no quiet ice under gravity, nor with density diffusion, density re-initialisation or shifting, which work on
// ice at rest, too: all of it is awake. Artificial stress and hourglass control keep their loops over all particles.
// Singular moment matrices are not counted in sleeping ice.
#pragma once

#include <cstdint>
#include <vector>

#include "sph/contact.hpp"
#include "sph/elastic_constants.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"
#include "sph/spec.hpp"

namespace nilas::sph {

/// Keeps Particles::sleep.
class QuietIce {
 public:
  /// quiet_speed [m/s] > 0, in the world frame.
  QuietIce(double quiet_speed, const ElasticConstants& elastic)
      : quiet_speed_(quiet_speed), quiet_stress_(elastic.impedance() * quiet_speed) {}

  /// Decides anew, for a list just rebuilt, from the state of the particles.
  void follow(const Neighbours& neighbours, Particles& particles);
  /// Wakes what contact forces touch; before the force pass.
  void wake_touched(const Neighbours& neighbours, const std::vector<Contact>& contacts, Particles& particles);
  /// Wakes what particles that are no longer quiet may reach; after the kick.
  void wake_stirred(const Neighbours& neighbours, Particles& particles);

  std::size_t bytes() const;

 private:
  bool find_stirred(const Neighbours& neighbours, const Particles& particles);
  void find_near(const Neighbours& neighbours);
  void spread(const Neighbours& neighbours);
  void wake(const Neighbours& neighbours, Particles& particles);

  double quiet_speed_, quiet_stress_;  // m/s, Pa
  bool all_awake_ = false;
  std::vector<std::uint8_t> rings_;               // by group: lists from a stirred group to this one, 3: more than 2
  std::vector<std::uint8_t> spread_;              // by group: the rings when they were last counted on from there
  std::vector<std::uint8_t> in_use_, sleep_;      // by block: not untouched when the list was built; Particles::sleep
  std::vector<std::vector<std::uint32_t>> near_;  // by block: others in the neighbour lists of its particles
};

}  // namespace nilas::sph
