// Arithmetic and memory traffic of a step as the method needs them, whatever the code does: so a rate in GFLOP/s or
// GB/s is a rate of useful work, and code that computes or moves more comes out lower.
//
// An operation is an addition, subtraction, multiplication, division, root, exponential, minimum or maximum. Pairs are
// those within the kernel radius, seen from both sides: an engine that evaluates each pair once needs less than is
// counted here, pairs that are listed but too far apart and lanes that are filled up count nothing.
//
//   per pair                                        operations
//   separation 3, r^2 5, t = max(1 - r/2h, 0) 4     12
//   gradient   V f 3, v_j - v_i 3, V f r 3, nine products and sums 18                              27
//     corrected  moment matrix, six of them 12                                                     12
//   force      V_i V_j f 4, sigma_i + sigma_j 6, times r 15, summed up 6                           31
//     corrected  sigma_j B_j 45, a sum of nine instead of six 3                                    48
//     viscous    v.r 8, V_i + V_j 1, mu 5, Q 5, summed up 6                                        25
//     periodic   five per axis, in both passes                                                     15
//   per particle
//   stress     strain 14, volume 4, rotation 119, trial stress 31, yield function and work 47      215   twice a step
//   kick and two drifts                                                                            18
//
// Traffic: every number that a pass needs is read once from memory, every result written once, in the precision of the
// pass (R bytes), positions always in double. Caches do the rest. The neighbour list does not count: how long it is, is
// the engine's choice.
//
//   gradient   reads x, V, v, writes L                24 + 4 R + 9 R
//   force      reads x, V, v, sigma, writes a         24 + 10 R + 3 R
//     corrected  writes or reads B                                 + 6 R in both
//   stress     reads L, V, sigma, plastic strain, failed; writes all but L        25 R + 2    twice a step
//   two drifts and a kick   x read and written twice, v read three times and written once, a read      96 + 15 R
#pragma once

namespace nilas::benchmarks {

struct Work {
  double operations = 0, bytes = 0;  // per particle
  Work operator+(const Work& o) const { return {operations + o.operations, bytes + o.bytes}; }
};

struct WorkTerms {
  double pairs;       // per particle, within the kernel radius
  double real_bytes;  // 8 or 4
  bool corrected = false, viscous = true;
};

inline Work gradient_work(const WorkTerms& t) {
  return {t.pairs * (12 + 27 + (t.corrected ? 12 : 0)), 24 + (13 + (t.corrected ? 6 : 0)) * t.real_bytes};
}
inline Work force_work(const WorkTerms& t) {
  return {t.pairs * (12 + 31 + (t.corrected ? 48 : 0) + (t.viscous ? 25 : 0)),
          24 + (13 + (t.corrected ? 6 : 0)) * t.real_bytes};
}
/// Of one of the two updates in a step, Drucker-Prager ice.
inline Work stress_work(double real_bytes) { return {215, 25 * real_bytes + 2}; }
inline Work motion_work(double real_bytes) { return {18, 96 + 15 * real_bytes}; }
inline Work step_work(const WorkTerms& t) {
  return gradient_work(t) + force_work(t) + stress_work(t.real_bytes) + stress_work(t.real_bytes) +
         motion_work(t.real_bytes);
}

/// What a pass needs of its neighbours, from whatever cache: x, V, v, the second also sigma. Bytes per pair.
inline double gradient_loads(double real_bytes) { return 7 * real_bytes; }
inline double force_loads(double real_bytes) { return 13 * real_bytes; }

}  // namespace nilas::benchmarks
