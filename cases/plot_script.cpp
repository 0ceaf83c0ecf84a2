#include "cases/plot_script.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "cases/data_files.hpp"
#include "cases/run.hpp"

namespace nilas::cases {

namespace {

/// The system's, whatever python3 stands first on PATH: h5py and matplotlib come with its packages.
constexpr const char* python = "/usr/bin/python3";

constexpr const char* find_modules =
    "import sys, importlib.util as u; sys.exit(not all(map(u.find_spec, ('numpy', 'matplotlib', 'h5py'))))";

int run_python(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), python);
  std::vector<char*> words;
  for (auto& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawn(&child, python, nullptr, nullptr, words.data(), environ);
  if (error != 0) throw IoError(std::string(python) + ": " + std::strerror(error));
  int status = 0;
  while (waitpid(child, &status, 0) == -1)
    if (errno != EINTR) throw IoError(std::string(python) + ": " + std::strerror(errno));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

int run_plot_script(const std::string& script, const std::vector<std::string>& arguments) {
  const auto path = plot_directory() / script;
  if (!std::filesystem::is_regular_file(path)) throw IoError(path.string() + ": no such script");
  if (!std::filesystem::exists(python) || run_python({"-c", find_modules}) != 0)
    throw IoError(
        "plots need " + std::string(python) +
        " with numpy, matplotlib and h5py: apt install python3 python3-numpy python3-matplotlib python3-h5py");
  std::vector<std::string> words{path.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_python(words);
}

}  // namespace nilas::cases
