#include "tests/benchmarks/measured_run.hpp"

#include <omp.h>

#include <cstdio>
#include <string>

#include "cases/scene.hpp"
#include "tests/benchmarks/clocks.hpp"
#include "tests/benchmarks/in_child.hpp"
#include "tests/benchmarks/struck_sheet.hpp"

namespace nilas::benchmarks {

namespace {

constexpr double kQuiet = 0.97;  // share of the core that a run on one thread gets on a free machine
constexpr double kDepth = 0.15;  // m, of the tip at the start

cases::Scene scene_of(const Configuration& c) {
  const std::string precision = c.single_precision ? "single" : "double";
  cases::Scene scene =
      cases::read_scene(cases::find_scene("cai-2025-90"), {"impact.gap_m=0", "numerics.precision=" + precision});
  sph::PieceSpec& sheet = scene.ice.pieces.front();
  sheet.diameter = disc_diameter(c.particles, sheet.thickness, scene.ice.spacing);
  return scene;
}

Measured run(const Configuration& c, const Effort& effort) {
  omp_set_num_threads(c.threads);
  const cases::Scene scene = scene_of(c);
  const sph::PieceSpec& sheet = scene.ice.pieces.front();
  const double resident_before = peak_resident_bytes();
  Impact impact = struck(scene.ice, scene.bodies.front(), kDepth);
  const sph::Ice& ice = impact.ice();
  for (int k = 0; k < effort.warm_up; ++k) step(impact);

  const double n = static_cast<double>(ice.particles().size()), steps = effort.steps * effort.repetitions;
  const std::size_t rebuilds_before = ice.rebuilds();
  const double time_before = impact.last_step().time;
  std::vector<double> cpu, wall;
  for (int r = 0; r < effort.repetitions; ++r) {
    const double cpu_start = cpu_seconds(), wall_start = wall_seconds();
    for (int k = 0; k < effort.steps; ++k) step(impact);
    cpu.push_back((cpu_seconds() - cpu_start) / (n * effort.steps));
    wall.push_back((wall_seconds() - wall_start) / (n * effort.steps));
  }
  const double pairs =
      pairs_per_particle(sheet.diameter, sheet.thickness, scene.ice.spacing, 2 * ice.smoothing_length());
  Measured m{};
  m.of = c;
  m.particles = n;
  m.diameter = sheet.diameter, m.thickness = sheet.thickness, m.spacing = scene.ice.spacing;
  m.dt = (impact.last_step().time - time_before) / steps;
  m.cpu = median(cpu), m.wall = median(wall);
  m.rebuilds = static_cast<double>(ice.rebuilds() - rebuilds_before) / steps;
  m.ice_bytes = static_cast<double>(ice.bytes()) / n;
  m.resident_bytes = (peak_resident_bytes() - resident_before) / n;
  m.work = step_work({.pairs = pairs, .real_bytes = c.single_precision ? 4.0 : 8.0});
  return m;
}

}  // namespace

Measured measure(const Configuration& configuration, const Effort& effort) {
  return in_child([&] { return run(configuration, effort); });
}

void warn_if_busy(const Measured& on_one_thread) {
  if (on_one_thread.core_share() < kQuiet)
    std::fprintf(stderr, "warning: other processes took %.0f %% of the core; wall times do not count\n",
                 100 * (1 - on_one_thread.core_share()));
}

const MachineLimits& Probe::operator()(int threads) {
  const auto found = limits_.find(threads);
  if (found != limits_.end()) return found->second;
  return limits_.emplace(threads, in_child([&] { return probe_machine(threads); })).first->second;
}

}  // namespace nilas::benchmarks
