// Whether the far field of a cut sheet mattered: what went out through the rim, what it could change at the body, and
// on request a second run with twice the domain.
#pragma once

#include <ostream>
#include <vector>

#include "cases/recorder.hpp"
#include "cases/run.hpp"

namespace nilas::cases {

/// What a run with domain = "auto" says about its cut.
///
/// The bounds: energy that came to the rim early enough to be back at the body by a time t, over the energy that the
/// bodies had given up by then, E_out/E. If an echo brings back the share r of the amplitude, the work done on the body
/// changes by the cross term of the two waves, at most 2 sqrt(r^2 E_out E) (Cauchy-Schwarz in the energy norm); an
/// absorbing rim returns less than half of the amplitude (r <= 1/2), so that force and impulse change by less than
///
///     sqrt(E_out / E)
///
/// of themselves. Proved for linear waves; for ice that fails it is an estimate, which README.md holds against
/// measured differences.
struct DomainReport {
  double diameter = 0, whole_diameter = 0;  // m
  double reach = 0;                         // m
  double out_energy = 0;                    // J, that went out through the rim
  double exchanged_energy = 0;              // J, that the bodies gave up
  double earliest_echo = 0;  // s: first touch + way to the rim and back at the speed of P-waves; 0: none within the run
  double peak_bound = 0;     // relative; 0: no echo before the peak's window ends
  double impulse_bound = 0;  // relative, at the end of the run
};

class DomainCheck {
 public:
  explicit DomainCheck(const Scene& scene);
  /// Every sub-step, cheap; nothing if the sheet is not cut.
  void add(const Impact& impact);
  /// bodies: as recorded so far; force_window [s].
  DomainReport report(const std::vector<BodyRecord>& bodies, double force_window) const;

 private:
  struct Sample {
    double time, out, exchanged;
  };
  const Sample& at(double time) const;
  double bound(double time) const;

  bool cut_;
  DomainReport report_;
  double one_way_ = 0;  // s, from the rim to the body
  std::vector<Sample> samples_;
};

/// The line at the end of a run; empty if the scene has domain = "full".
std::string describe(const DomainReport& report);

/// `nilas run SCENE --check-domain`: runs the scene, then once more with twice the diameter into domain-check/ of its
/// run directory, and writes how peak force and impulse differ into domain-check.json and to `log`. The outcome is that
/// of the first run, or of the second if only that one failed. Throws SceneError if the sheet is not cut; as `run`
/// does.
RunOutcome run_with_domain_check(const Scene& scene, const RunOptions& options, std::ostream& log);

}  // namespace nilas::cases
