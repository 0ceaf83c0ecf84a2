#include "cases/run.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "cases/domain.hpp"
#include "cases/domain_check.hpp"
#include "cases/material_presets.hpp"
#include "cases/progress.hpp"
#include "cases/recorder.hpp"
#include "cases/results.hpp"
#include "cases/summary.hpp"
#include "coupling/simulation.hpp"
#include "sph/terms.hpp"

namespace nilas::cases {

namespace {

namespace fs = std::filesystem;

/// Leaves the time loop from inside a Bullet step.
struct Stop {
  RunEnd end;
  std::string message;
};

/// Writes every line to the caller's stream and to log.txt.
class Log {
 public:
  Log(std::ostream& out, const fs::path& file) : out_(out), file_(file) {
    if (!file_) throw IoError("cannot write " + file.string());
  }
  void operator()(const std::string& text) {
    out_ << text << (text.ends_with('\n') ? "" : "\n") << std::flush;
    file_ << text << (text.ends_with('\n') ? "" : "\n") << std::flush;
  }

 private:
  std::ostream& out_;
  std::ofstream file_;
};

void prepare_directory(const RunOptions& options) {
  std::error_code error;
  if (fs::exists(options.out) && !fs::is_directory(options.out))
    throw IoError(options.out.string() + " exists and is not a directory");
  if (fs::exists(options.out) && !fs::is_empty(options.out, error) && !options.overwrite)
    throw SceneError(options.out.string() +
                     " is not empty; allowed: a new directory, or --force to write over its run");
  fs::create_directories(options.out, error);
  if (error) throw IoError("cannot create " + options.out.string() + ": " + error.message());
  for (const char* name : {"summary.json", "history.csv", "result.h5", "result.xmf", "scene.toml", "log.txt",
                           "dump.txt", "domain-check.json"})
    fs::remove(options.out / name, error);
  for (const auto& entry : fs::directory_iterator(options.out))
    if (const std::string name = entry.path().filename(); name == "loads.csv" || name.starts_with("loads-"))
      fs::remove(entry.path(), error);
  // Pictures and check of the run that is written over.
  for (const char* name : {"plots", "domain-check"}) fs::remove_all(options.out / name, error);
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  if (!out.flush()) throw IoError("cannot write " + file.string());
}

/// As the scene states, else 2.5 spacings over the largest speed between a body and the ice.
double force_window(const Scene& scene) {
  if (scene.output.force_window > 0) return scene.output.force_window;
  double speed = 0;
  for (const rigid::BodySpec& body : scene.bodies)
    for (const sph::PieceSpec& piece : scene.ice.pieces)
      speed = std::max(
          speed, ((body.motion == rigid::Motion::fixed ? Vec3::Zero().eval() : body.velocity) - piece.velocity).norm());
  return speed > 0 ? 2.5 * scene.ice.spacing / speed : 0;
}

std::string describe_scene(const Scene& scene, const Impact& impact, const RunFacts& facts) {
  std::ostringstream text;
  text << "scene: " << scene.title << "\nice: " << ice_name(scene.ice) << ", " << impact.ice().particles().size()
       << " particles at " << scene.ice.spacing << " m\n";
  if (const std::string domain = describe_domain(scene); !domain.empty()) text << "domain: " << domain << "\n";
  if (sph::has_quiet_ice(scene.ice))
    text << "quiet ice: sleeps until something faster than " << scene.ice.numerics.quiet_speed << " m/s reaches it; "
         << 100 * impact.ice().asleep_fraction() << " % of it sleep at the start\n";
  for (const std::string& c : scene.calibrated) text << "calibrated: " << c << "\n";
  for (const std::string& w : facts.warnings) text << "warning: " << w << "\n";
  for (const std::string& t : impact.ice().terms_left_out()) text << "left out: " << t << "\n";
  text << "coupling-stability number: " << facts.coupling_stability_number
       << "\npair loops: " << sph::pair_pass_instruction_set() << ", " << facts.threads << " threads\n";
  return text.str();
}

/// No particle centre gets behind a surface while contact holds; one that is a spacing deep will not be pushed out.
std::string describe_leak(const Scene& scene, const Impact& impact, double depth) {
  std::ostringstream text;
  const StepRecord& step = impact.last_step();
  text << "ice is " << depth << " m inside a body, more than a spacing (" << scene.ice.spacing
       << " m): contact has not held it out; in step " << step.number << " at t = " << step.time << " s, dt " << step.dt
       << " s limited by " << sph::name(step.limiter) << "; the body may be too fast for ice to be pushed aside (c_p "
       << impact.ice().elastic_constants().p_wave_speed() << " m/s) or its contact too soft (contact.stiffness "
       << scene.ice.contact.stiffness << ")";
  return text.str();
}

}  // namespace

RunOutcome run(const Scene& scene, const RunOptions& options, std::ostream& out) {
  const Preview cost = preview(scene);  // refuses a scene that does not fit before anything is written
  prepare_directory(options);
  if (options.threads > 0) omp_set_num_threads(options.threads);
  write_text(options.out / "scene.toml", write_scene(scene));
  Log log(out, options.out / "log.txt");

  RunFacts facts;
  facts.scene_name = options.scene_name;
  facts.threads = omp_get_max_threads();
  facts.force_window = force_window(scene);
  facts.coupling_stability_number = cost.coupling_stability_number;
  facts.warnings = cost.warnings;
  Recorder recorder(scene, options.out, facts.force_window);
  DomainCheck domain(scene);
  Progress progress(out, options.terminal, scene.run.end_time);

  // One observer serves both hosts: it is called after every ice sub-step, inside Bullet's step or not.
  Simulation simulation(scene.ice, scene.bodies, scene.run.bullet_step, [&](Impact& impact) {
    recorder.accumulate(impact);
    domain.add(impact);
    if (recorder.largest_penetration() > scene.ice.spacing)
      throw Stop{RunEnd::numerical_failure, describe_leak(scene, impact, recorder.largest_penetration())};
    if (recorder.row_due(impact)) {
      const std::string open = recorder.observe(impact, impact.ledger());
      if (!open.empty()) throw Stop{RunEnd::ledger_open, open};
    }
    progress.update(impact);
    if (options.interrupted && options.interrupted()) throw Stop{RunEnd::interrupted, "interrupted"};
  });
  Impact& impact = simulation.impact();
  log(describe_scene(scene, impact, facts) +
      (simulation.has_bullet_world() ? "" : "left out: Bullet world (no body moves freely)\n"));

  ResultWriter results(options.out, describe(impact.bodies()));
  const auto write_frame = [&] { results.append(recorder.ice_frame(impact), recorder.body_frames(impact)); };
  RunOutcome outcome{RunEnd::finished, "end time reached"};
  double last_good = 0;
  try {
    write_frame();
    const double frames = std::ceil(scene.run.end_time / scene.output.interval * (1 - 1e-12));
    for (int frame = 1; frame <= frames; ++frame) {
      const double time = frame < frames ? frame * scene.output.interval : scene.run.end_time;
      simulation.advance_to(time);
      write_frame();
      last_good = time;
    }
    const std::string open = recorder.finish(impact, impact.ledger());
    if (!open.empty()) outcome = {RunEnd::ledger_open, open};
  } catch (const Stop& stop) {  // thrown between two sub-steps: the state is whole
    outcome = {stop.end, stop.message};
    recorder.finish(impact, impact.ledger());
  } catch (const sph::NumericalFailure& failure) {
    std::ostringstream text;
    const StepRecord& step = impact.last_step();
    text << failure.what() << "; in step " << step.number + 1 << " after t = " << step.time << " s, last dt " << step.dt
         << " s limited by " << sph::name(step.limiter) << "; last good frame in result.h5 at t = " << last_good
         << " s; lower numerics.cfl (" << scene.ice.numerics.cfl << ") or raise numerics.viscosity_alpha ("
         << scene.ice.numerics.viscosity_alpha << ")";
    outcome = {RunEnd::numerical_failure, text.str()};
  }
  if (outcome.end == RunEnd::numerical_failure || outcome.end == RunEnd::ledger_open)
    write_text(options.out / "dump.txt", outcome.message + "\n");
  recorder.write_loads(options.out, impact.bodies());
  progress.finish();
  facts.wall_time = progress.seconds();
  facts.stopped_by = outcome.message;
  facts.domain = domain.report(recorder.bodies(), facts.force_window);
  write_summary(options.out / "summary.json", scene, impact, recorder, facts);
  log("stopped by: " + outcome.message + "\n" + summary_text(scene, impact, recorder, facts) +
      "results: " + options.out.string());
  return outcome;
}

}  // namespace nilas::cases
