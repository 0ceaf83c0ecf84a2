// The kernels of a step one by one, on one thread: in the second-level cache, and far beyond the last level.
//
// Counters: steps/s: particles treated per second; GB/s, GFLOP/s: useful traffic to memory and arithmetic (work.hpp);
// load GB/s: useful numbers read of the neighbours, from whatever cache.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <memory>

#include "tests/benchmarks/ice_state.hpp"
#include "tests/benchmarks/work.hpp"

namespace {

using namespace nilas::benchmarks;
using benchmark::Counter;

// Half a MiB and some hundred MiB at 0.4 to 0.6 kB per particle.
constexpr int kInCache = 900, kInMemory = 340'000;

enum Variant { doubles, singles, doubles_corrected, singles_corrected };

nilas::sph::PairTerms terms_of(int variant) {
  return {.corrected = variant >= doubles_corrected,
          .viscous = true,
          .periodic = false,
          .single_precision = variant == singles || variant == singles_corrected};
}

/// The last one asked for is kept: making it takes longer than measuring it.
IceState& ice(const benchmark::State& state) {
  static std::unique_ptr<IceState> kept;
  static std::pair<std::int64_t, std::int64_t> of;
  const std::pair wanted{state.range(0), state.range(1)};
  if (!kept || of != wanted) {
    kept.reset();
    kept = std::make_unique<IceState>(static_cast<double>(wanted.first), terms_of(static_cast<int>(wanted.second)));
    of = wanted;
  }
  return *kept;
}

void count(benchmark::State& state, const IceState& s, const Work& work, double loads) {
  const double n = s.particles() * static_cast<double>(state.iterations());
  state.counters["particles"] = s.particles();
  state.counters["pairs"] = s.pairs();
  state.counters["groups"] = s.listed_groups();
  state.counters["steps/s"] = Counter(n, Counter::kIsRate);
  state.counters["GB/s"] = Counter(1e-9 * n * work.bytes, Counter::kIsRate);
  state.counters["GFLOP/s"] = Counter(1e-9 * n * work.operations, Counter::kIsRate);
  if (loads > 0) state.counters["load GB/s"] = Counter(1e-9 * n * s.pairs() * loads, Counter::kIsRate);
}

WorkTerms work_terms(const benchmark::State& state, const IceState& s) {
  const nilas::sph::PairTerms t = terms_of(static_cast<int>(state.range(1)));
  return {s.pairs(), t.single_precision ? 4.0 : 8.0, t.corrected, t.viscous};
}

void gradient_pass(benchmark::State& state) {
  IceState& s = ice(state);
  for (auto _ : state) s.gradient_pass();
  const WorkTerms t = work_terms(state, s);
  count(state, s, gradient_work(t), gradient_loads(t.real_bytes));
}

void force_pass(benchmark::State& state) {
  IceState& s = ice(state);
  for (auto _ : state) s.force_pass();
  const WorkTerms t = work_terms(state, s);
  count(state, s, force_work(t), force_loads(t.real_bytes));
}

void stress_update(benchmark::State& state) {
  IceState& s = ice(state);
  for (auto _ : state) s.update_stress();
  count(state, s, stress_work(8), 0);
}

/// Search and sort. Traffic: positions read, list of groups written; arithmetic: distances within the kernel radius.
void neighbour_build(benchmark::State& state) {
  IceState& s = ice(state);
  for (auto _ : state) s.rebuild_neighbours();
  count(state, s, {8 * s.pairs(), 24 + 4 * s.listed_groups()}, 0);
}

/// Only particles that touch count.
void contact(benchmark::State& state, bool search) {
  IceState& s = ice(state);
  for (auto _ : state) s.contact(search);
  state.counters["particles"] = s.particles();
  state.counters["touching"] = s.touching();
  state.counters["steps/s"] = Counter(s.touching() * static_cast<double>(state.iterations()), Counter::kIsRate);
}

}  // namespace

int main(int argc, char** argv) {
  omp_set_num_threads(1);
  for (const int size : {kInCache, kInMemory})
    for (const int variant : {doubles, singles, doubles_corrected, singles_corrected}) {
      const auto add = [&](const std::string& kernel, const std::string& terms, void (*function)(benchmark::State&)) {
        const std::string name = kernel + ", " + terms + (size == kInCache ? "L2" : "memory");
        benchmark::RegisterBenchmark(name.c_str(), function)->Args({size, variant})->Unit(benchmark::kMicrosecond);
      };
      const std::string terms = std::string(terms_of(variant).single_precision ? "single, " : "double, ") +
                                (terms_of(variant).corrected ? "corrected, " : "");
      add("gradient pass", terms, gradient_pass);
      add("force pass", terms, force_pass);
      if (variant != doubles) continue;
      add("stress update", "", stress_update);
      add("neighbour build", "", neighbour_build);
      add("contact", "", [](benchmark::State& s) { contact(s, false); });
      add("contact with search", "", [](benchmark::State& s) { contact(s, true); });
    }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
