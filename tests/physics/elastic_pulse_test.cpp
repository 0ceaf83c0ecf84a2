// What the verification case V9 leaves out: a smooth elastic pulse along a bar whose sides are periodic, with corrected
// and with plain gradients, with and without Poisson's ratio, against the exact solution of the wave equation
//
//   v(x, t) = (f(x - ct) + f(x + ct)) / 2,   f(x) = V sin^2(pi (x - a)/w) for a < x < a + w,
//
// a stress-free bar that is given the velocity f. Sides that are periodic make the strain uniaxial: c = c_p; without
// Poisson's ratio c_p is the bar's own speed sqrt(E/rho). No artificial viscosity; the pulse travels two widths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sph/ice.hpp"
#include "tests/support/pair_sums.hpp"
#include "tests/support/particle_clouds.hpp"

namespace nilas::sph {
namespace {

constexpr double width = 0.4, distance = 2 * width;  // m, of the pulse; that it travels
constexpr double V = 0.01;                           // m/s
constexpr double start = 0.2;                        // m, a
constexpr double E = 9.38e9, rho = 900;

struct Bar {
  double poisson_ratio = 0;
  int cells = 20;  // per pulse width
  bool corrected = true;
  double length = 2;  // m

  double wave_speed() const {
    const double nu = poisson_ratio;
    return std::sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / rho);
  }
  double spacing() const { return width / cells; }
  Ice make() const {
    IceSpec ice;
    PieceSpec piece;
    piece.shape = IceShape::block;
    piece.size = {length, 6 * spacing(), 6 * spacing()};
    piece.centre = {length / 2, 0, 0};
    ice.pieces = {piece};
    ice.spacing = spacing();
    ice.periodic = {false, true, true};
    ice.material.model = Model::elastic;
    ice.material.poisson_ratio = poisson_ratio;
    ice.numerics.viscosity_alpha = 0;
    ice.numerics.gradient_correction = corrected;
    return Ice(ice, {}, {.velocity = initial_velocity});
  }
  static Vec3 initial_velocity(const Vec3& x) {
    const double s = (x[0] - start) / width;
    return {s > 0 && s < 1 ? V * std::pow(std::sin(std::numbers::pi * s), 2) : 0, 0, 0};
  }
};

/// Steps to `end` and calls record(time, dt) after every step.
template <class Record>
void run(Ice& ice, double end, const Record& record) {
  const test::Threads one(1);  // too small to share
  std::vector<Surface> none;
  for (double time = 0; time < end * (1 - 1e-9);) {
    const double dt = std::min(ice.stable_step().dt, end - time);
    ice.step(none, dt);
    time += dt;
    record(time, dt);
  }
}

/// Place in order of creation of a particle of the layer nearest to x.
std::uint32_t layer_at(const Ice& ice, double x) {
  const auto order = ice.creation_order();
  const auto distance_of = [&](std::uint32_t k) { return std::abs(ice.particles().motion[order[k]].position[0] - x); };
  std::uint32_t nearest = 0;
  for (std::uint32_t k = 0; k < order.size(); ++k)
    if (distance_of(k) < distance_of(nearest)) nearest = k;
  return nearest;
}

struct Passage {
  double speed;  // m/s, of the pulse between its start and the station: from the centroid in time of v there
  double peak;   // m/s
};
Passage pass_station(const Bar& bar) {
  Ice ice = bar.make();
  const std::uint32_t station = layer_at(ice, start + width / 2 + distance);
  const double travelled = ice.particles().motion[ice.creation_order()[station]].position[0] - (start + width / 2);
  double sum = 0, moment = 0, peak = 0;
  run(ice, (distance + 0.8 * width) / bar.wave_speed(), [&](double time, double dt) {
    const double v = ice.particles().motion[ice.creation_order()[station]].velocity[0];
    sum += v * dt, moment += v * time * dt;
    peak = std::max(peak, v);
  });
  return {travelled * sum / moment, peak};
}

TEST(ElasticPulse, WaveSpeedsAreThoseOfTheReference) {
  Bar bar;
  EXPECT_NEAR(bar.wave_speed(), 3228.3, 0.1);
  bar.poisson_ratio = 0.33;
  EXPECT_NEAR(bar.wave_speed(), 3929.6, 0.1);
}

// Gradient and divergence are both small by the same factor, so that waves are slow by it: 2.1 % at h = 1.3 spacings.
TEST(ElasticPulse, PlainGradientsSlowItByTheKernelSumOfTheLattice) {
  for (const double nu : {0.0, 0.33}) {
    Bar bar;
    bar.poisson_ratio = nu;
    bar.corrected = false;
    const Passage passage = pass_station(bar);
    EXPECT_NEAR(passage.speed / (test::lattice_factor(1.3) * bar.wave_speed()), 1, 0.01);
    EXPECT_NEAR(passage.peak / (V / 2), 1, 0.03);
  }
}

/// Relative error of the velocity in the L2 norm over the right half, where only the pulse that travels right is.
double error(const Bar& bar) {
  Ice ice = bar.make();
  run(ice, distance / bar.wave_speed(), [](double, double) {});
  double difference2 = 0, exact2 = 0;
  for (const Motion& m : ice.particles().motion) {
    if (m.position[0] < start + distance / 2) continue;
    const double exact = 0.5 * Bar::initial_velocity(m.position - Vec3(distance, 0, 0))[0];
    difference2 += std::pow(m.velocity[0] - exact, 2);
    exact2 += exact * exact;
  }
  return std::sqrt(difference2 / exact2);
}

TEST(ElasticPulse, ConvergesAtLeastAtFirstOrder) {
  for (const double nu : {0.0, 0.33}) {
    double e[3];
    for (int k = 0; k < 3; ++k) {
      Bar bar;
      bar.poisson_ratio = nu;
      bar.cells = 10 << k;
      e[k] = error(bar);
    }
    RecordProperty(nu == 0 ? "order_nu_0" : "order_nu_033", std::to_string(std::log2(e[1] / e[2])));
    EXPECT_GE(std::log2(e[0] / e[1]), 1) << "nu = " << nu;
    EXPECT_GE(std::log2(e[1] / e[2]), 1) << "nu = " << nu;
  }
}

/// Largest tension [Pa] once the pulse has turned at a free right end.
double tension_after_reflection(Bar bar) {
  bar.length = start + width / 2 + distance;
  Ice ice = bar.make();
  // The pulse has left the end and is met by nothing yet; its twin from the left end follows 0.3 widths behind.
  run(ice, (distance + 0.6 * width) / bar.wave_speed(), [](double, double) {});
  double tension = 0;
  for (std::size_t i = 0; i < ice.particles().size(); ++i)
    if (ice.particles().motion[i].position[0] > bar.length - 0.75 * width)
      tension = std::max(tension, ice.particles().stress[i].xx);
  return tension;
}

// Stress is rougher next to a surface than velocity: twice the resolution.
TEST(ElasticPulse, FreeEndTurnsCompressionIntoTension) {
  for (const double nu : {0.0, 0.33}) {
    Bar bar;
    bar.poisson_ratio = nu;
    bar.cells = 40;
    EXPECT_NEAR(tension_after_reflection(bar) / (rho * bar.wave_speed() * V / 2), 1, 0.03) << "nu = " << nu;
  }
}

}  // namespace
}  // namespace nilas::sph
