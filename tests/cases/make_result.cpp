// make_result DIR: writes three frames of the known result into DIR, for readers in other languages.
#include <filesystem>

#include "tests/cases/known_result.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::filesystem::create_directories(argv[1]);
  nilas::cases::ResultWriter writer(argv[1], {nilas::test::known_body()});
  for (int frame = 0; frame < 3; ++frame) {
    writer.append(nilas::test::known_ice(frame), {nilas::test::known_body_frame(frame)});
  }
}
