#include "tests/benchmarks/scaling.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace nilas::benchmarks {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kParticles = 1e8, kCores = 64;
constexpr double kSheet = 4.8, kEnd = 0.006;  // m, s: of the scene

/// one: the run on one thread.
Json extrapolate(const Measured& one, double serial, double bandwidth, bool bandwidth_measured) {
  const StepTime t = step_time(kParticles, kCores, one.wall, serial, one.work.bytes, 1e9 * bandwidth);
  // The whole sheet at the spacing that gives so many particles; the step goes with the spacing.
  const double spacing = std::cbrt(std::numbers::pi / 4 * kSheet * kSheet * one.thickness / kParticles);
  const double steps = kEnd / (one.dt * spacing / one.spacing);
  const double enough = 1e-9 * kParticles * one.work.bytes / t.arithmetic;
  const double memory = 1e-9 * kParticles * one.resident_bytes, hours = t.longer() * steps / 3600;
  std::printf(
      "extrapolated to %.0f cores and %.0f million particles, serial fraction %.4f:\n"
      "  a step: arithmetic %.2f s, memory at least %.2f s at %.0f GB/s (%s; from %.0f GB/s on it does not limit)\n"
      "  the 4.8 m sheet at %.1f mm to 6 ms: %.0f steps, %.1f hours; %.0f GB of memory\n",
      kCores, 1e-6 * kParticles, serial, t.arithmetic, t.memory, bandwidth,
      bandwidth_measured ? "all threads of this machine" : "as stated", enough, 1e3 * spacing, steps, hours, memory);
  return {{"cores", kCores},
          {"particles", kParticles},
          {"serial_fraction", serial},
          {"arithmetic_s_per_step", t.arithmetic},
          {"memory_s_per_step", t.memory},
          {"bandwidth_GB_s", bandwidth},
          {"bandwidth_measured_here", bandwidth_measured},
          {"sufficient_bandwidth_GB_s", enough},
          {"spacing_m", spacing},
          {"steps", steps},
          {"hours", hours},
          {"memory_GB", memory}};
}

}  // namespace

double serial_fraction(double speed_up, double threads) { return (1 / speed_up - 1 / threads) / (1 - 1 / threads); }

StepTime step_time(double particles, double cores, double seconds, double serial, double bytes, double bandwidth) {
  return {particles * seconds * (serial + (1 - serial) / cores), particles * bytes / bandwidth};
}

Json run_scaling(double particles, const std::vector<int>& threads, bool single_precision, const Effort& effort,
                 double bandwidth, Probe& probe) {
  std::printf("%s precision, million particle-steps per wall second\n", single_precision ? "single" : "double");
  std::printf("%7s | strong %10s %8s %8s %8s | weak %10s %8s %10s\n", "threads", "particles", "M/s", "speed-up",
              "serial", "particles", "M/s", "efficiency");
  Json rows = Json::array();
  Measured one{};
  double serial = 0;
  for (const int p : threads) {
    const Measured strong = measure({particles, p, single_precision}, effort);
    const Measured weak = p == 1 ? strong : measure({particles * p, p, single_precision}, effort);
    if (p == 1) one = strong, warn_if_busy(one);
    const double speed_up = one.wall / strong.wall, efficiency = one.wall / weak.wall / p;
    if (p > 1) serial = serial_fraction(speed_up, p);
    std::printf("%7d | %17.0f %8.3f %8.3f %8.4f | %15.0f %8.3f %10.3f\n", p, strong.particles, 1e-6 / strong.wall,
                speed_up, serial, weak.particles, 1e-6 / weak.wall, efficiency);
    std::fflush(stdout);
    rows.push_back({{"threads", p},
                    {"strong_particles", strong.particles},
                    {"strong_particle_steps_per_s", 1 / strong.wall},
                    {"speed_up", speed_up},
                    {"serial_fraction", serial},
                    {"weak_particles", weak.particles},
                    {"weak_particle_steps_per_s", 1 / weak.wall},
                    {"weak_efficiency", efficiency},
                    {"weak_resident_bytes_per_particle", weak.resident_bytes}});
  }
  Json result{
      {"precision", single_precision ? "single" : "double"}, {"share_of_core", one.core_share()}, {"rows", rows}};
  if (threads.size() < 2) {
    std::printf("one thread shows no serial fraction: nothing to extrapolate from\n");
    return result;
  }
  const bool measured_here = bandwidth <= 0;
  result["extrapolated"] = extrapolate(one, std::max(serial, 0.0),
                                       measured_here ? probe(threads.back()).triad_GB_s : bandwidth, measured_here);
  return result;
}

}  // namespace nilas::benchmarks
