// Whole steps of an impact (measured_run.hpp): speed, memory, and the fraction of what the machine can do at most,
// measured in the same run. Sheets, precisions and numbers of threads as the command line asks.
//
// GB/s and GFLOP/s are useful work (work.hpp) over CPU time per thread, the machine's limits over the wall time of the
// best of twenty repetitions. Set OMP_WAIT_POLICY=passive: threads that wait by spinning use CPU time.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "sph/pair_passes.hpp"
#include "tests/benchmarks/measured_run.hpp"
#include "tests/benchmarks/scaling.hpp"

namespace nilas::benchmarks {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::vector<std::string> sizes{"20k", "42k"}, precisions{"double", "single"};
  std::vector<int> threads{1, std::max(2, static_cast<int>(std::thread::hardware_concurrency()))};
  Effort effort;
  bool scaling = false;
  double bandwidth = 0;
  std::string json;
};

/// Of "20k", "2.7M", "4000".
double particles(const std::string& size) {
  std::istringstream in(size);
  double value = 0;
  std::string unit;
  in >> value >> unit;
  const double scale = unit.empty() ? 1 : unit == "k" ? 1e3 : unit == "M" ? 1e6 : 0;
  if (!(value * scale >= 1000)) throw std::invalid_argument("--sizes: 20k, 2.7M or 4000 (at least), not " + size);
  return value * scale;
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

Json json_of(const MachineLimits& m) {
  return {{"threads", m.threads},
          {"triad_GB_s", m.triad_GB_s},
          {"fma_double_GFLOP_s", m.fma_double_GFLOP_s},
          {"fma_single_GFLOP_s", m.fma_single_GFLOP_s}};
}

Json json_of(const Measured& m, const Effort& effort, const MachineLimits& limits) {
  // While the threads run: what others take of the machine is not ours.
  const double seconds = m.cpu / m.of.threads;
  const double bandwidth = 1e-9 * m.work.bytes / seconds, arithmetic = 1e-9 * m.work.operations / seconds;
  const bool single = m.of.single_precision;
  return {{"particles", m.particles},
          {"diameter_m", m.diameter},
          {"threads", m.of.threads},
          {"precision", single ? "single" : "double"},
          {"steps", effort.steps},
          {"repetitions", effort.repetitions},
          {"dt_s", m.dt},
          {"rebuilds_per_step", m.rebuilds},
          {"cpu_s", m.cpu * m.particles * effort.steps},
          {"wall_s", m.wall * m.particles * effort.steps},
          {"particle_steps_per_cpu_s", 1 / m.cpu},
          {"particle_steps_per_wall_s", 1 / m.wall},
          {"share_of_cores", m.core_share()},
          {"ice_bytes_per_particle", m.ice_bytes},
          {"resident_bytes_per_particle", m.resident_bytes},
          {"operations_per_particle_step", m.work.operations},
          {"bytes_per_particle_step", m.work.bytes},
          {"GB_s", bandwidth},
          {"GFLOP_s", arithmetic},
          {"fraction_of_triad", bandwidth / limits.triad_GB_s},
          {"fraction_of_fma", arithmetic / (single ? limits.fma_single_GFLOP_s : limits.fma_double_GFLOP_s)}};
}

void print_head() {
  std::printf("%9s %7s %9s %6s %8s %8s %8s %8s %8s %8s %7s %7s %8s %7s\n", "particles", "threads", "precision", "steps",
              "CPU s", "wall s", "M/CPU s", "M/wall s", "B ice", "B peak", "GB/s", "of max", "GFLOP/s", "of max");
}

void print(const Json& j) {
  const auto value = [&](const char* key) { return j.at(key).get<double>(); };
  std::printf("%9.0f %7.0f %9s %6.0f %8.3f %8.3f %8.3f %8.3f %8.0f %8.0f %7.2f %6.1f%% %8.2f %6.1f%%\n",
              value("particles"), value("threads"), j.at("precision").get<std::string>().c_str(), value("steps"),
              value("cpu_s"), value("wall_s"), 1e-6 * value("particle_steps_per_cpu_s"),
              1e-6 * value("particle_steps_per_wall_s"), value("ice_bytes_per_particle"),
              value("resident_bytes_per_particle"), value("GB_s"), 100 * value("fraction_of_triad"), value("GFLOP_s"),
              100 * value("fraction_of_fma"));
  std::fflush(stdout);
}

Json run_sizes(const Options& o, Probe& probe) {
  for (const int threads : o.threads) {
    const MachineLimits& m = probe(threads);
    std::printf("%d thread%s: triad %.1f GB/s; fused multiply-add %.1f GFLOP/s in double, %.1f in single precision\n",
                threads, threads == 1 ? "" : "s", m.triad_GB_s, m.fma_double_GFLOP_s, m.fma_single_GFLOP_s);
  }
  print_head();
  Json list = Json::array();
  for (const std::string& size : o.sizes)
    for (const std::string& precision : o.precisions)
      for (const int threads : o.threads) {
        const Measured m = measure({particles(size), threads, precision == "single"}, o.effort);
        list.push_back(json_of(m, o.effort, probe(threads)));
        print(list.back());
        if (threads == 1) warn_if_busy(m);
      }
  return list;
}

Json run(const Options& o) {
  Probe probe;
  Json result{{"processor", processor()},
              {"hardware_threads", std::thread::hardware_concurrency()},
              {"instruction_set", sph::pair_pass_instruction_set()}};
  std::printf("%s, %u hardware threads, pair loops: %s\n", processor().c_str(), std::thread::hardware_concurrency(),
              sph::pair_pass_instruction_set());
  if (o.scaling) {
    if (o.threads.front() != 1 || !std::is_sorted(o.threads.begin(), o.threads.end()))
      throw std::invalid_argument("--scaling: --threads has to ascend from 1");
    Json list = Json::array();
    for (const std::string& precision : o.precisions)
      list.push_back(
          run_scaling(particles(o.sizes.back()), o.threads, precision == "single", o.effort, o.bandwidth, probe));
    result["scaling"] = list;
  } else {
    result["runs"] = run_sizes(o, probe);
  }
  result["limits"] = Json::array();
  for (const auto& [threads, limits] : probe.all()) result["limits"].push_back(json_of(limits));
  return result;
}

}  // namespace
}  // namespace nilas::benchmarks

int main(int argc, char** argv) {
  nilas::benchmarks::Options o;
  CLI::App app("Speed, memory and scaling of whole steps of an impact");
  app.add_option("--sizes", o.sizes, "particles, as 20k,42k,680k,2.7M")->delimiter(',')->capture_default_str();
  app.add_option("--threads", o.threads, "numbers of threads; with --scaling ascending from 1")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--precision", o.precisions, "of the pair loops")
      ->delimiter(',')
      ->check(CLI::IsMember({"double", "single"}))
      ->capture_default_str();
  app.add_option("--steps", o.effort.steps, "timed together")->capture_default_str();
  app.add_option("--warm-up", o.effort.warm_up, "steps before")->capture_default_str();
  app.add_option("--repetitions", o.effort.repetitions, "of which the median counts")->capture_default_str();
  app.add_flag("--scaling", o.scaling, "strong and weak scaling of the last size, and what follows for 64 cores");
  app.add_option("--bandwidth", o.bandwidth, "GB/s of the machine extrapolated to (default: this one's)");
  app.add_option("--json", o.json, "file for the same as JSON");
  CLI11_PARSE(app, argc, argv);
  try {
    const auto result = nilas::benchmarks::run(o);
    if (!o.json.empty() && !(std::ofstream(o.json) << result.dump(2) << "\n"))
      throw std::runtime_error("cannot write " + o.json);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
