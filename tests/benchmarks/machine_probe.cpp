#include "tests/benchmarks/machine_probe.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <string>

#include "tests/benchmarks/clocks.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace nilas::benchmarks {

namespace {

constexpr int kRepetitions = 20;
constexpr std::size_t kMiB = std::size_t{1} << 20;

/// Results go here, so that nothing is computed in vain.
volatile double sink;

/// Seconds of the fastest of several runs of `work`, the first of which does not count.
template <class Work>
double best_seconds(const Work& work) {
  work();
  double best = 1e300;
  for (int n = 0; n < kRepetitions; ++n) {
    const double start = wall_seconds();
    work();
    best = std::min(best, wall_seconds() - start);
  }
  return best;
}

double triad(int threads) {
  const std::size_t n = triad_array_bytes() / sizeof(double);
  // Not touched before the threads do: pages then lie with the thread that uses them.
  const std::unique_ptr<double[]> a(new double[n]), b(new double[n]), c(new double[n]);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < n; ++i) a[i] = 0, b[i] = 1, c[i] = 2;
  double scale = 3;
  const double seconds = best_seconds([&] {
    double *x = a.get(), *y = b.get(), *z = c.get();
#pragma omp parallel for simd schedule(static) num_threads(threads)
    for (std::size_t i = 0; i < n; ++i) x[i] = y[i] + scale * z[i];
    asm volatile("" : : "r"(x) : "memory");  // every repetition's array is written
    scale += 1;
  });
  sink = a[n / 2];
  return 1e-9 * 24 * static_cast<double>(n) / seconds;
}

// Enough independent chains to fill two pipes of latency five, few enough for sixteen registers.
constexpr int kChains = 12;
constexpr int kIterations = 4'000'000;

// Known at run time only.
volatile float factor = 0.75f, addend = 0.25f;

template <class Real>
struct Vector16 {
  typedef Real type __attribute__((vector_size(16)));
};

/// x <- a x + b over and over, which tends to 1: no overflow, no denormal numbers.
template <class Real>
double multiply_add_baseline() {
  using V = typename Vector16<Real>::type;
  const V a = V{} + static_cast<Real>(factor), b = V{} + static_cast<Real>(addend);
  V x[kChains];
  for (int c = 0; c < kChains; ++c) x[c] = a * static_cast<Real>(c);
  for (int n = 0; n < kIterations; ++n)
#pragma GCC unroll 12
    for (int c = 0; c < kChains; ++c) x[c] = a * x[c] + b;
  double sum = 0;
  for (int c = 0; c < kChains; ++c) sum += static_cast<double>(x[c][0] + x[c][1]);
  return sum;
}

#if defined(__x86_64__)
// The compiler may not fuse by itself (-std=c++20), hence intrinsics.
__attribute__((target("avx2,fma"))) double multiply_add_v3(double) {
  const __m256d a = _mm256_set1_pd(factor), b = _mm256_set1_pd(addend);
  __m256d x[kChains];
  for (int c = 0; c < kChains; ++c) x[c] = _mm256_set1_pd(c);
  for (int n = 0; n < kIterations; ++n)
#pragma GCC unroll 12
    for (int c = 0; c < kChains; ++c) x[c] = _mm256_fmadd_pd(a, x[c], b);
  double sum = 0;
  for (int c = 0; c < kChains; ++c) sum += x[c][0] + x[c][3];
  return sum;
}
__attribute__((target("avx2,fma"))) double multiply_add_v3(float) {
  const __m256 a = _mm256_set1_ps(factor), b = _mm256_set1_ps(addend);
  __m256 x[kChains];
  for (int c = 0; c < kChains; ++c) x[c] = _mm256_set1_ps(static_cast<float>(c));
  for (int n = 0; n < kIterations; ++n)
#pragma GCC unroll 12
    for (int c = 0; c < kChains; ++c) x[c] = _mm256_fmadd_ps(a, x[c], b);
  double sum = 0;
  for (int c = 0; c < kChains; ++c) sum += static_cast<double>(x[c][0] + x[c][7]);
  return sum;
}
bool has_v3() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
template <class Real>
double multiply_add() {
  return has_v3() ? multiply_add_v3(Real{}) : multiply_add_baseline<Real>();
}
#else
bool has_v3() { return false; }
template <class Real>
double multiply_add() {
  return multiply_add_baseline<Real>();
}
#endif

template <class Real>
double peak_multiply_add(int threads) {
  const double seconds = best_seconds([&] {
    double sum = 0;
#pragma omp parallel num_threads(threads) reduction(+ : sum)
    sum += multiply_add<Real>();
    sink = sum;
  });
  const double lanes = (has_v3() ? 32.0 : 16.0) / sizeof(Real);
  return 1e-9 * 2 * lanes * kChains * kIterations * threads / seconds;
}

/// As the kernel states it: under virtual machines sysconf() may tell the cache of the whole host.
std::size_t last_level_cache_bytes() {
  for (const char* level : {"3", "2"}) {
    std::ifstream file(std::string("/sys/devices/system/cpu/cpu0/cache/index") + level + "/size");
    std::size_t kilobytes = 0;
    if (file >> kilobytes) return 1024 * kilobytes;
  }
  const long bytes = sysconf(_SC_LEVEL3_CACHE_SIZE);
  return bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

}  // namespace

std::size_t triad_array_bytes() { return std::clamp(4 * last_level_cache_bytes(), 128 * kMiB, 1024 * kMiB); }

MachineLimits probe_machine(int threads) {
  return {threads, triad(threads), peak_multiply_add<double>(threads), peak_multiply_add<float>(threads)};
}

}  // namespace nilas::benchmarks
