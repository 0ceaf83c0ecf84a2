// V9: a smooth elastic pulse along a bar whose sides are periodic, against the exact solution of the wave equation
//
//   v(x, t) = (f(x - ct) + f(x + ct)) / 2,   f(x) = V sin^2(pi (x - a)/w) for a < x < a + w,
//
// a stress-free bar that is given the velocity f. Sides that are periodic make the strain uniaxial: c = c_p. The pulse
// travels two widths past the station; a second bar ends where the first has its station, free or fixed: there the
// velocity, or the stress, doubles.
#include <cmath>
#include <numbers>

#include "cases/accuracy/advance.hpp"
#include "cases/accuracy/catalogue.hpp"

namespace nilas::cases {

namespace {

constexpr double width = 0.4, distance = 2 * width;  // m, of the pulse; that it travels
constexpr double start = 0.2;                        // m, a
constexpr double V = 0.01;                           // m/s
constexpr double nu = 0.33;

enum class End { far, free, fixed };

Vec3 initial_velocity(const Vec3& x) {
  const double s = (x[0] - start) / width;
  return {s > 0 && s < 1 ? V * std::pow(std::sin(std::numbers::pi * s), 2) : 0, 0, 0};
}

/// Cells across: at least two kernel radii with skin, so that no particle meets two images of another.
int cells_across(const sph::NumericsSpec& numerics) {
  return static_cast<int>(std::ceil(4 * numerics.smoothing_ratio * (1 + numerics.skin_ratio)));
}

sph::Ice make_bar(const Scheme& scheme, double dx, End end) {
  sph::IceSpec ice;
  sph::PieceSpec piece;
  piece.shape = sph::IceShape::block;
  const double across = cells_across(scheme.numerics) * dx;
  piece.size = {end == End::far ? 2 : start + width / 2 + distance, across, across};
  piece.centre = {piece.size.x() / 2, 0, 0};
  piece.fixed.faces[1] = end == End::fixed;
  ice.pieces = {piece};
  ice.spacing = dx;
  ice.periodic = {false, true, true};
  ice.material.model = sph::Model::elastic;
  ice.material.poisson_ratio = nu;
  ice.numerics = scheme.numerics;
  return sph::Ice(ice, {}, {.velocity = initial_velocity});
}

/// Place in order of creation of a particle of the layer nearest to x.
std::uint32_t layer_at(const sph::Ice& ice, double x) {
  const auto order = ice.creation_order();
  std::uint32_t nearest = 0;
  const auto away = [&](std::uint32_t k) { return std::abs(ice.particles().motion[order[k]].position[0] - x); };
  for (std::uint32_t k = 0; k < order.size(); ++k)
    if (away(k) < away(nearest)) nearest = k;
  return nearest;
}

/// Arrival (centroid in time of the velocity at the station), peak there, and the field's L2 error when it is there.
void pass_station(const Scheme& scheme, double dx, Measurement& m) {
  sph::Ice ice = make_bar(scheme, dx, End::far);
  const double c = ice.elastic_constants().p_wave_speed();
  const std::uint32_t station = layer_at(ice, start + width / 2 + distance);
  const double travelled = ice.particles().motion[ice.creation_order()[station]].position[0] - (start + width / 2);
  m.particles = ice.particles().size();
  double sum = 0, moment = 0, peak = 0, time_before = 0;
  const auto record = [&](double time, double dt) {
    const double v = ice.particles().motion[ice.creation_order()[station]].velocity[0];
    sum += v * dt, moment += v * (time_before + time) * dt;
    peak = std::max(peak, v);
  };
  m.steps += advance(ice, distance / c, record);
  double difference2 = 0, exact2 = 0;
  for (const sph::Motion& particle : ice.particles().motion) {
    if (particle.position[0] < start + distance / 2) continue;
    const double exact = 0.5 * initial_velocity(particle.position - Vec3(distance, 0, 0))[0];
    difference2 += std::pow(particle.velocity[0] - exact, 2);
    exact2 += exact * exact;
  }
  time_before = distance / c;
  m.steps += advance(ice, 0.8 * width / c, record);
  m.errors = {std::abs(moment / sum * c / travelled - 1), std::abs(peak / (V / 2) - 1),
              std::sqrt(difference2 / exact2)};
}

/// Largest velocity at a free end, or stress at a fixed one, while the pulse is there, against the doubled one.
double reflection_error(const Scheme& scheme, double dx, End end, Measurement& m) {
  sph::Ice ice = make_bar(scheme, dx, end);
  const double c = ice.elastic_constants().p_wave_speed(), length = start + width / 2 + distance;
  const std::uint32_t last = layer_at(ice, length);
  double velocity = 0, stress = 0;
  m.steps += advance(ice, (distance + 0.6 * width) / c, [&](double, double) {
    const sph::Particles& p = ice.particles();
    velocity = std::max(velocity, p.motion[ice.creation_order()[last]].velocity[0]);
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.motion[i].position[0] > length - width) stress = std::max(stress, -p.stress[i].xx);
  });
  return std::abs((end == End::free ? velocity / V : stress / (ice.elastic_constants().impedance() * V)) - 1);
}

Measurement run(const Scheme& scheme, int cells_per_width) {
  Measurement m;
  m.resolution = m.spacing = width / cells_per_width;
  pass_station(scheme, m.spacing, m);
  m.errors.push_back(reflection_error(scheme, m.spacing, End::free, m));
  m.errors.push_back(reflection_error(scheme, m.spacing, End::fixed, m));
  return m;
}

}  // namespace

VerificationCase elastic_pulse() {
  return {.name = "V9-elastic-pulse",
          .title = "A sin^2 pulse of uniaxial strain along a bar, past a station, onto a free end and onto a fixed end",
          .reference =
              "d'Alembert's solution, c_p = 3929.6 m/s; the velocity doubles at a free end, the stress at a "
              "fixed one",
          .metrics = {{"arrival", 0.01},
                      {"peak", 0.03},
                      {"field, L2", Metric::none, 1},
                      {"free-end velocity", 0.03},
                      {"fixed-end stress", 0.03}},
          .resolutions = {10, 20, 40},
          .stated_resolution = 20,
          .quick = 3,
          .tested = 3,
          .schemes_matter = true,
          .run = run};
}

}  // namespace nilas::cases
