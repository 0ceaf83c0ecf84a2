// What every optional term costs: time per particle-step and bytes per particle, each switched on alone in bare ice
// (elastic, plain gradient, no viscosity) that a body breaks. The bare ice is measured twice: the difference is the
// noise.
#include <malloc.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/benchmarks/clocks.hpp"
#include "tests/benchmarks/in_child.hpp"
#include "tests/benchmarks/struck_sheet.hpp"

namespace nilas::benchmarks {
namespace {

using Json = nlohmann::ordered_json;
using sph::IceSpec;

constexpr double kSpacing = 0.02, kThickness = 0.3, kDepth = 0.15;  // m
constexpr double kSpeed = 100;                                      // m/s, of the body

struct Options {
  double side = 0.84;  // m, of the square sheet
  int steps = 20, warm_up = 5, repetitions = 3;
  std::string json;
};

/// A term, what it needs to be switched on with, and how.
struct Term {
  const char* name;
  const char* over;  // row that it is compared with
  std::function<void(IceSpec&)> change;
};

void drucker_prager(IceSpec& s) {
  s.material.model = sph::Model::drucker_prager, s.material.after_failure = sph::AfterFailure::plastic;
}
void corrected(IceSpec& s) { s.numerics.gradient_correction = true; }
void neo_hookean(IceSpec& s) { s.material.model = sph::Model::neo_hookean; }

constexpr const char* kBare = "bare";
constexpr const char* kPlastic = "Drucker-Prager, perfectly plastic";
constexpr const char* kCorrected = "gradient correction";
constexpr const char* kNeoHookean = "neo-Hookean (instead of hypo-elastic)";

std::vector<Term> terms() {
  return {
      {kBare, kBare, [](IceSpec&) {}},
      {"artificial viscosity", kBare, [](IceSpec& s) { s.numerics.viscosity_alpha = 0.1; }},
      {kCorrected, kBare, corrected},
      {"hourglass control", kCorrected, [](IceSpec& s) { corrected(s), s.numerics.hourglass_control = 1; }},
      {"artificial stress", kBare, [](IceSpec& s) { s.numerics.artificial_stress = 0.3; }},
      {"density diffusion", kBare, [](IceSpec& s) { s.numerics.density_diffusion = 0.1; }},
      {"density re-initialisation, every step", kBare, [](IceSpec& s) { s.numerics.density_reinitialisation = 1; }},
      {"particle shifting", kBare, [](IceSpec& s) { s.numerics.shifting = 0.1; }},
      {"gravity", kBare, [](IceSpec& s) { s.gravity = Vec3(0, 0, -9.81); }},
      {"friction", kBare, [](IceSpec& s) { s.contact.friction_coefficient = 0.1; }},
      {"periodic images", kBare,
       [](IceSpec& s) {
         s.periodic = {true, true, false};
       }},
      {"fixed part", kBare, [](IceSpec& s) { s.pieces.front().fixed.faces[0] = true; }},
      {"pressure from density (elastic)", kBare, [](IceSpec& s) { s.material.pressure = sph::PressureLaw::density; }},
      {kPlastic, kBare, drucker_prager},
      {"fluid after failure", kPlastic,
       [](IceSpec& s) { drucker_prager(s), s.material.after_failure = sph::AfterFailure::fluid; }},
      {"softening", kPlastic,
       [](IceSpec& s) {
         drucker_prager(s), s.material.after_failure = sph::AfterFailure::softening;
         s.material.residual_strength = 0.1, s.material.softening_strain = 0.01;
       }},
      {"hardening", kPlastic, [](IceSpec& s) { drucker_prager(s), s.material.hardening_modulus = 1e9; }},
      {"bulking (pressure from density)", kPlastic,
       [](IceSpec& s) { drucker_prager(s), s.material.pressure = sph::PressureLaw::density; }},
      {"rate-dependent ice", kBare,
       [](IceSpec& s) {
         s.material.model = sph::Model::rate_dependent, s.material.pressure = sph::PressureLaw::density;
       }},
      {kNeoHookean, kBare, neo_hookean},
      {"Kelvin-Voigt damping", kNeoHookean, [](IceSpec& s) { neo_hookean(s), s.material.kelvin_voigt = 0.1; }},
      {"single precision", kBare, [](IceSpec& s) { s.numerics.precision = sph::Precision::single; }},
      {"bare, once more", kBare, [](IceSpec&) {}},
  };
}

/// Elastic ice, plain gradient, no viscosity.
IceSpec bare_sheet(double side) {
  IceSpec ice;
  sph::PieceSpec block;
  block.shape = sph::IceShape::block;
  block.size = Vec3(side, side, kThickness);
  ice.pieces = {block};
  ice.spacing = kSpacing;
  ice.material.model = sph::Model::elastic;
  ice.numerics.viscosity_alpha = 0;
  return ice;
}

/// The paper's HCC, homogeneous, from below, its tip on the face of the sheet.
rigid::BodySpec hcc() {
  rigid::BodySpec body;
  body.name = "hcc";
  body.shape = rigid::Hcc{1.8, 0.3, 0.2};
  body.boundary_spacing = 0.75 * kSpacing;
  body.mass = rigid::from_density(body.shape, 1500);
  body.velocity = Vec3(0, 0, kSpeed);
  body.position = Vec3(0, 0, -0.5 * kThickness) + body.mass.centre_of_mass;
  return body;
}

struct Cost {
  double particles;
  double step, mean;             // CPU seconds per particle: of the median step, in which no list is rebuilt; of all
  double rebuilds;               // per step
  double ice_bytes, heap_bytes;  // per particle: as the ice counts them, and as the allocator does
};

double heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

Cost measure(const Term& term, const Options& o) {
  omp_set_num_threads(1);
  IceSpec ice = bare_sheet(o.side);
  term.change(ice);
  const double heap_before = heap_bytes();
  Impact impact = struck(ice, hcc(), kDepth);
  for (int k = 0; k < o.warm_up; ++k) step(impact);
  const double n = static_cast<double>(impact.ice().particles().size());
  const std::size_t rebuilds_before = impact.ice().rebuilds();
  std::vector<double> seconds;
  for (int k = 0; k < o.steps; ++k) {
    const double start = cpu_seconds();
    step(impact);
    seconds.push_back((cpu_seconds() - start) / n);
  }
  return {n,
          median(seconds),
          std::accumulate(seconds.begin(), seconds.end(), 0.0) / o.steps,
          static_cast<double>(impact.ice().rebuilds() - rebuilds_before) / o.steps,
          static_cast<double>(impact.ice().bytes()) / n,
          (heap_bytes() - heap_before) / n};
}

/// Every term once per round, so that a slow spell of the machine meets all of them alike.
std::vector<std::vector<Cost>> measure_rounds(const std::vector<Term>& list, const Options& o) {
  std::vector<std::vector<Cost>> costs(list.size());
  for (int round = 0; round < o.repetitions; ++round)
    for (std::size_t k = 0; k < list.size(); ++k) costs[k].push_back(in_child([&] { return measure(list[k], o); }));
  return costs;
}

Json run(const Options& o) {
  const std::vector<Term> list = terms();
  const auto costs = measure_rounds(list, o);
  std::printf("%-42s %8s %7s %8s %8s %8s %8s %8s %8s\n", "term", "ns", "+-", "added", "mean ns", "rebuilds", "B ice",
              "added", "B heap");
  std::map<std::string, std::pair<double, double>> known;  // ns and bytes
  Json rows = Json::array();
  for (std::size_t k = 0; k < list.size(); ++k) {
    std::vector<double> ns, means;
    for (const Cost& c : costs[k]) ns.push_back(1e9 * c.step), means.push_back(1e9 * c.mean);
    const auto [least, most] = std::minmax_element(ns.begin(), ns.end());
    const Cost& c = costs[k].front();
    const double middle = median(ns), spread = 0.5 * (*most - *least);
    known[list[k].name] = {middle, c.ice_bytes};
    const auto [over_ns, over_bytes] = known.at(list[k].over);
    std::printf("%-42s %8.1f %7.1f %+8.1f %8.1f %8.3f %8.1f %+8.1f %8.1f\n", list[k].name, middle, spread,
                middle - over_ns, median(means), c.rebuilds, c.ice_bytes, c.ice_bytes - over_bytes, c.heap_bytes);
    rows.push_back({{"term", list[k].name},
                    {"over", list[k].over},
                    {"particles", c.particles},
                    {"ns_per_particle_step", middle},
                    {"half_range_ns", spread},
                    {"added_ns", middle - over_ns},
                    {"mean_ns_with_rebuilds", median(means)},
                    {"rebuilds_per_step", c.rebuilds},
                    {"ice_bytes_per_particle", c.ice_bytes},
                    {"added_bytes", c.ice_bytes - over_bytes},
                    {"heap_bytes_per_particle", c.heap_bytes}});
  }
  return {{"steps", o.steps}, {"repetitions", o.repetitions}, {"terms", rows}};
}

}  // namespace
}  // namespace nilas::benchmarks

int main(int argc, char** argv) {
  nilas::benchmarks::Options o;
  CLI::App app("What every optional term of the ice costs");
  app.add_option("--side", o.side, "of the square sheet [m]")->capture_default_str();
  app.add_option("--steps", o.steps, "timed together")->capture_default_str();
  app.add_option("--repetitions", o.repetitions, "of every term, of which the median counts")->capture_default_str();
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
