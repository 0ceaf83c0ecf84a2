#include "cases/domain_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cases/domain.hpp"
#include "sph/reduced_stiffness.hpp"

namespace nilas::cases {

namespace {

using Json = nlohmann::ordered_json;

Json read_summary(const std::filesystem::path& directory) {
  std::ifstream file(directory / "summary.json");
  if (!file) throw IoError("cannot read " + (directory / "summary.json").string());
  return Json::parse(file);
}

double norm(const Json& vector) {
  return std::hypot(vector[0].get<double>(), vector[1].get<double>(), vector[2].get<double>());
}

/// Of one body, in the run and in the one with twice the domain.
Json difference(const Json& body, const Json& wider) {
  const double peaks[] = {body["peak_force_filtered_N"], wider["peak_force_filtered_N"]};
  const double impulses[] = {norm(body["impulse_N_s"]), norm(wider["impulse_N_s"])};
  const auto relative = [](const double(&pair)[2]) { return pair[1] > 0 ? pair[0] / pair[1] - 1 : 0; };
  return {{"peak_force_filtered_N", peaks},
          {"impulse_N_s", impulses},
          {"peak_difference", relative(peaks)},
          {"impulse_difference", relative(impulses)}};
}

std::string sentence(const std::string& name, const Json& d, const Json& domain) {
  const double peak = d["peak_difference"], impulse = d["impulse_difference"];
  const bool within = std::abs(peak) <= domain["peak_bound"] && std::abs(impulse) <= domain["impulse_bound"];
  return fmt::format(
      "{}: against twice the domain the peak differs by {:+.2g} %, the impulse by {:+.2g} %: {} the bounds\n", name,
      100 * peak, 100 * impulse, within ? "within" : "BEYOND");
}

}  // namespace

DomainCheck::DomainCheck(const Scene& scene) : cut_(scene.whole_sheet && scene.ice.pieces.front().absorbing_rim) {
  if (!scene.whole_sheet) return;
  report_.diameter = scene.ice.pieces.front().diameter;
  report_.whole_diameter = scene.whole_sheet->diameter;
  report_.reach = passage(*scene.whole_sheet, scene.bodies, scene.run.end_time).reach;
  const double way = 0.5 * report_.diameter - rim_depth(scene.ice) - report_.reach;
  one_way_ = way / sph::ElasticConstants(sph::with_reduced_stiffness(scene.ice).material).p_wave_speed();
}

void DomainCheck::add(const Impact& impact) {
  if (!cut_) return;
  double exchanged = 0;
  for (const Body& body : impact.bodies()) exchanged -= body.account().ice_work;
  const double before = samples_.empty() ? 0 : samples_.back().exchanged;
  samples_.push_back({impact.last_step().time, impact.ice().absorbed(), std::max(exchanged, before)});
}

/// The last sample up to a time.
const DomainCheck::Sample& DomainCheck::at(double time) const {
  static constexpr Sample start{0, 0, 0};
  const auto after = std::upper_bound(samples_.begin(), samples_.end(), time,
                                      [](double t, const Sample& sample) { return t < sample.time; });
  return after == samples_.begin() ? start : *(after - 1);
}

double DomainCheck::bound(double time) const {
  const double out = at(time - one_way_).out;
  const double exchanged = at(time).exchanged;
  return out > 0 && exchanged > 0 ? std::sqrt(out / exchanged) : 0;
}

DomainReport DomainCheck::report(const std::vector<BodyRecord>& bodies, double force_window) const {
  DomainReport report = report_;
  if (samples_.empty()) return report;
  const auto touch = std::find_if(samples_.begin(), samples_.end(), [](const Sample& s) { return s.exchanged > 0; });
  const Sample& last = samples_.back();
  report.out_energy = last.out;
  report.exchanged_energy = last.exchanged;
  if (touch != samples_.end() && touch->time + 2 * one_way_ < last.time)
    report.earliest_echo = touch->time + 2 * one_way_;
  for (const BodyRecord& body : bodies)
    report.peak_bound = std::max(report.peak_bound, bound(body.peak.filtered_time() + 0.5 * force_window));
  report.impulse_bound = bound(last.time);
  return report;
}

std::string describe(const DomainReport& r) {
  if (r.whole_diameter == 0) return {};
  if (r.diameter == r.whole_diameter) return "domain: the whole sheet, nothing left out\n";
  return fmt::format(
      "domain: {:.4g} m of {:.4g} m; {:.2g} % of the energy that the bodies gave up went out through the rim; earliest "
      "echo at {:.3g} ms; bounds on what the cut changes: peak {:.2g} %, impulse {:.2g} %\n",
      r.diameter, r.whole_diameter, r.exchanged_energy > 0 ? 100 * r.out_energy / r.exchanged_energy : 0,
      r.earliest_echo * 1e3, 100 * r.peak_bound, 100 * r.impulse_bound);
}

RunOutcome run_with_domain_check(const Scene& scene, const RunOptions& options, std::ostream& log) {
  if (!scene.whole_sheet || !scene.ice.pieces.front().absorbing_rim)
    throw SceneError(
        "--check-domain: nothing is cut away; allowed: with ice.domain = \"auto\" and a sheet larger than its domain");
  const RunOutcome outcome = run(scene, options, log);
  if (outcome.end != RunEnd::finished) return outcome;
  RunOptions wider = options;
  wider.out = options.out / "domain-check";
  const RunOutcome check = run(cut(scene, 2 * scene.ice.pieces.front().diameter), wider, log);
  if (check.end != RunEnd::finished) return check;

  const Json first = read_summary(options.out), second = read_summary(wider.out);
  Json result = {{"diameter_m", {first["domain"]["diameter_m"], second["domain"]["diameter_m"]}},
                 {"peak_bound", first["domain"]["peak_bound"]},
                 {"impulse_bound", first["domain"]["impulse_bound"]}};
  for (const rigid::BodySpec& body : scene.bodies) {
    const bool single = scene.bodies.size() == 1;
    const Json& of_body = result["bodies"][body.name] =
        single ? difference(first, second) : difference(first["bodies"][body.name], second["bodies"][body.name]);
    log << sentence(body.name, of_body, result);
  }
  std::ofstream file(options.out / "domain-check.json");
  file << result.dump(2) << "\n";
  if (!file.flush()) throw IoError("cannot write " + (options.out / "domain-check.json").string());
  return outcome;
}

}  // namespace nilas::cases
