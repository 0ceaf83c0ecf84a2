// The command line:
//
//   nilas run SCENE [--set key=value]... [--out DIR] [--threads N] [--force] [--check-domain]
//   nilas check SCENE [--set key=value]...
//   nilas list
//   nilas compare DIR... [--out DIR]
//   nilas plot DIR
//   nilas accuracy [CASE...] [--quick] [--option NAME]... [--jobs N] [--out DIR] [--list]
//   nilas accuracy --scene SCENE --spacing A,B,C [--set key=value]... [--out DIR]
//   nilas accuracy --ices [--quick] [--out DIR]
//   nilas accuracy --economies [--scene SCENE] [--set key=value]... [--out DIR]
//   nilas stability [ROW...] [--quick] [--out DIR] [--jobs N]
//
// Exit codes: 0 done; 2 bad input or usage; 3 numerical failure; 4 a file cannot be read or written; 130 interrupted.
// NILAS_VERSION is defined by the build.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <iostream>
#include <memory>
#include <new>
#include <stdexcept>

#include "cases/accuracy/accuracy_command.hpp"
#include "cases/domain_check.hpp"
#include "cases/plot_script.hpp"
#include "cases/preview_report.hpp"
#include "cases/run.hpp"
#include "cases/scene.hpp"
#include "cases/stability/stability.hpp"

namespace {

using namespace nilas::cases;

volatile std::sig_atomic_t interrupt_requested = 0;  // set by the signal handler, the only way to hear of Ctrl-C

constexpr int done = 0, bad_input = 2, numerical_failure = 3, io_failure = 4, interrupted = 130;

int complain(std::string message, int exit_code) {
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  std::cerr << "nilas: " << message << std::endl;
  return exit_code;
}

struct Arguments {
  std::string scene;
  std::vector<std::string> overrides;
  std::string out;
  int threads = 0;
  bool force = false;
  bool check_domain = false;
  std::vector<std::string> directories;
  AccuracyOptions accuracy;
  bool list = false;
};

bool is_interrupted() { return interrupt_requested != 0; }

/// Lets a run end in order on Ctrl-C.
void listen_for_interrupts() {
  std::signal(SIGINT, [](int) { interrupt_requested = 1; });
  std::signal(SIGTERM, [](int) { interrupt_requested = 1; });
}

int run_command(const Arguments& arguments) {
  const auto file = find_scene(arguments.scene);
  const Scene scene = read_scene(file, arguments.overrides);
  RunOptions options;
  options.scene_name = file.stem().string();
  listen_for_interrupts();
  options.interrupted = is_interrupted;
  options.out = arguments.out.empty() ? "runs" / file.stem() : std::filesystem::path(arguments.out);
  options.overwrite = arguments.force;
  options.threads = arguments.threads;
  options.terminal = isatty(STDOUT_FILENO) == 1;
  const RunOutcome outcome =
      arguments.check_domain ? run_with_domain_check(scene, options, std::cout) : run(scene, options, std::cout);
  std::cout.flush();
  switch (outcome.end) {
    case RunEnd::finished:
      return done;
    case RunEnd::interrupted:
      return complain(outcome.message, interrupted);
    case RunEnd::numerical_failure:
    case RunEnd::ledger_open:
      break;
  }
  return complain(outcome.message, numerical_failure);
}

int check_command(const Arguments& arguments) {
  const Scene scene = read_scene(find_scene(arguments.scene), arguments.overrides);
  print_preview(scene, preview(scene), std::cout);
  return done;
}

int list_command() {
  const auto scenes = shipped_scenes();
  std::size_t width = 0;
  for (const auto& scene : scenes) width = std::max(width, scene.name.size());
  for (const auto& scene : scenes)
    std::cout << scene.name << std::string(width + 2 - scene.name.size(), ' ') << scene.title << "\n";
  return done;
}

int compare_command(const Arguments& arguments) {
  auto words = arguments.directories;
  if (!arguments.out.empty()) words.insert(words.end(), {"--out", arguments.out});
  return run_plot_script("compare.py", words);
}

int accuracy_command(const Arguments& arguments) {
  if (arguments.list) {
    list_accuracy_cases(std::cout);
    return done;
  }
  AccuracyOptions options = arguments.accuracy;
  options.overrides = arguments.overrides;
  if (!arguments.out.empty()) options.out = arguments.out;
  const bool scenes = !options.scene.empty() || options.ices || options.economies;
  if (scenes) {  // runs of scenes end in order; verification cases are just cut off
    listen_for_interrupts();
    options.interrupted = is_interrupted;
  }
  const bool held = run_accuracy(options, std::cout);
  if (is_interrupted()) return complain("interrupted", interrupted);
  if (!held && scenes) return complain("a run stopped: the report says where", numerical_failure);
  if (!held) std::cerr << "nilas: some tolerances were missed: the table says which" << std::endl;
  return done;
}

void add_scene_arguments(CLI::App& command, Arguments& arguments) {
  command.add_option("SCENE", arguments.scene, "a scene file, or the name of a shipped scene")->required();
  command.add_option("--set", arguments.overrides, "overrides one key of the scene: dotted.key=value, repeatable")
      ->allow_extra_args(false);
}

void add_stability_command(CLI::App& app, int& exit_code) {
  struct Words {
    std::vector<std::string> rows;
    std::string out = "stability";
    bool quick = false;
    int jobs = 2;
  };
  const auto words = std::make_shared<Words>();
  auto* command = app.add_subcommand("stability", "runs stiff and extreme scenes: which hold, are refused, or stop");
  command->add_option("ROW", words->rows, "rows or cases by name (default: all)");
  command->add_flag("--quick", words->quick, "leave out the long rows");
  command->add_option("--out", words->out, "where table, picture and run directories go (default: stability)");
  command->add_option("--jobs", words->jobs, "rows at a time (default: 2)")->check(CLI::Range(1, 256));
  command->callback([words, &exit_code] {
    const auto rows = chosen_rows(words->rows, words->quick);
    const StabilityOptions options{words->out, std::filesystem::read_symlink("/proc/self/exe"), words->jobs};
    exit_code = run_stability(rows, options, std::cout) == 0 ? done : numerical_failure;
  });
}

/// Defines the commands; the one chosen stores its exit code.
void define_commands(CLI::App& app, Arguments& arguments, int& exit_code) {
  app.set_version_flag("--version", std::string("nilas ") + NILAS_VERSION);
  app.require_subcommand(1);

  auto* run = app.add_subcommand("run", "runs a scene and writes its run directory");
  add_scene_arguments(*run, arguments);
  run->add_option("--out", arguments.out, "run directory (default: runs/<name of the scene>)");
  run->add_option("--threads", arguments.threads, "threads (default: all cores)")->check(CLI::Range(1, 4096));
  run->add_flag("--force", arguments.force, "write into a run directory that is not empty");
  run->add_flag("--check-domain", arguments.check_domain,
                "with ice.domain = \"auto\": once more with twice the domain, and how much that changes");
  run->callback([&] { exit_code = run_command(arguments); });

  auto* check = app.add_subcommand("check", "reads a scene and tells its size, step, memory and time without running");
  add_scene_arguments(*check, arguments);
  check->callback([&] { exit_code = check_command(arguments); });

  auto* list = app.add_subcommand("list", "lists the shipped scenes");
  list->callback([&] { exit_code = list_command(); });

  auto* accuracy = app.add_subcommand("accuracy", "measures error against run time");
  AccuracyOptions& options = arguments.accuracy;
  accuracy->add_option("CASE", options.cases, "verification cases (default: all)");
  accuracy->add_flag("--list", arguments.list, "lists cases and options and runs nothing");
  accuracy->add_flag("--quick", options.quick, "coarser resolutions only");
  accuracy
      ->add_option("--option", options.schemes, "numerics to compare, the first one judges; repeatable (default: all)")
      ->allow_extra_args(false);
  accuracy->add_option("--jobs", options.jobs, "runs at a time, one thread each")->check(CLI::Range(1, 4096));
  accuracy->add_option("--scene", options.scene, "instead: a scene without an exact answer, over --spacing");
  accuracy->add_option("--spacing", options.spacings, "spacings [m], separated by commas")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  accuracy->add_option("--set", arguments.overrides, "overrides one key of the scene")->allow_extra_args(false);
  accuracy->add_flag("--ices", options.ices, "instead: ice ball and HCC with the shipped ices, over the spacing");
  accuracy->add_flag("--economies", options.economies,
                     "instead: what cheaper ways to run a scene cost in force and motion");
  accuracy->add_option("--out", arguments.out, "where the results go (default: accuracy)");
  accuracy->callback([&] { exit_code = accuracy_command(arguments); });

  auto* compare = app.add_subcommand("compare", "plots runs against each other");
  compare->add_option("DIR", arguments.directories, "run directories")->required();
  compare->add_option("--out", arguments.out, "where the plots go");
  compare->callback([&] { exit_code = compare_command(arguments); });

  auto* plot = app.add_subcommand("plot", "plots a run");
  plot->add_option("DIR", arguments.directories, "run directory")->required()->expected(1);
  plot->callback([&] { exit_code = run_plot_script("plot.py", arguments.directories); });

  add_stability_command(app, exit_code);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("nilas: ice broken by rigid bodies");
  Arguments arguments;
  int exit_code = done;
  define_commands(app, arguments, exit_code);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return complain(std::string(error.what()) + "; see nilas --help", bad_input);
  } catch (const SceneError& error) {
    return complain(error.what(), bad_input);
  } catch (const std::invalid_argument& error) {  // pieces of ice that overlap, ...
    return complain(error.what(), bad_input);
  } catch (const std::bad_alloc&) {
    return complain("not enough memory", bad_input);
  } catch (const std::exception& error) {
    return complain(error.what(), io_failure);
  }
}
