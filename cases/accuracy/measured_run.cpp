#include "cases/accuracy/measured_run.hpp"

#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cases/run.hpp"
#include "sph/lattice.hpp"

namespace nilas::cases {

namespace {

using Json = nlohmann::ordered_json;  // the first body is the scene's first

Vec3 vector_of(const Json& json) { return Vec3(json[0].get<double>(), json[1].get<double>(), json[2].get<double>()); }

/// Of the first body that the scene has; a scene without a body has nothing to report.
const Json& body_of(const Json& summary) { return summary.contains("bodies") ? *summary["bodies"].begin() : summary; }

MeasuredRun summary_of(const std::filesystem::path& directory) {
  std::ifstream file(directory / "summary.json");
  const Json j = Json::parse(file);
  const Json& body = body_of(j);
  MeasuredRun run;
  run.particles = j["particles"];
  run.steps = j["steps"];
  run.spacing = j["spacing_m"];
  run.force_window = j["force_window_s"];
  run.energy_residual = j["energy_residual"];
  run.end_time = j["end_time_s"];
  run.domain_peak_bound = j["domain"].value("peak_bound", 0.0);
  run.domain_impulse_bound = j["domain"].value("impulse_bound", 0.0);
  run.ice = j["ice"];
  run.stopped_by = j["stopped_by"];
  run.peak_force = body["peak_force_filtered_N"];
  run.raw_peak_force = body["peak_force_N"];
  run.impulse = vector_of(body["impulse_N_s"]).norm();
  run.final_velocity = vector_of(body["final_velocity_m_s"]);
  run.velocity_loss = vector_of(body["initial_velocity_m_s"]).norm() - run.final_velocity.norm();
  run.attitude_change = body["attitude_change_deg"];
  return run;
}

double momentum_of_ice(const Scene& scene) {
  const sph::Particles particles = sph::lattice(scene.ice);
  Vec3 momentum = Vec3::Zero();
  for (const sph::Motion& m : particles.motion) momentum += particles.mass * m.velocity;
  return momentum.norm();
}

}  // namespace

MeasuredRun measure_run(const Scene& scene, const std::string& name, const std::filesystem::path& directory,
                        int threads, const std::function<bool()>& interrupted) {
  if (scene.bodies.empty())
    throw SceneError(name + ": no body: there is no force to compare; allowed: a scene with a body");
  RunOptions options;
  options.scene_name = name;
  options.out = directory;
  options.overwrite = true;
  options.threads = threads;
  options.interrupted = interrupted;
  std::ostringstream log;
  const std::clock_t start = std::clock();
  const RunOutcome outcome = run(scene, options, log);
  MeasuredRun result = summary_of(directory);
  result.cpu_time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  result.finished = outcome.end == RunEnd::finished;
  result.momentum_of_ice = momentum_of_ice(scene);
  return result;
}

}  // namespace nilas::cases
