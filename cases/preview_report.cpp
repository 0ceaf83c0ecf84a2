#include "cases/preview_report.hpp"

#include <fmt/format.h>

#include "cases/domain.hpp"
#include "cases/material_presets.hpp"
#include "sph/terms.hpp"

namespace nilas::cases {

namespace {

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.3g} min", seconds / 60);
  return fmt::format("{:.3g} h", seconds / 3600);
}

void print_list(std::string_view heading, const std::vector<std::string>& items, std::ostream& out) {
  for (const auto& item : items) out << fmt::format("{:<22}{}\n", heading, item);
}

}  // namespace

void print_preview(const Scene& scene, const Preview& preview, std::ostream& out) {
  const auto line = [&](std::string_view what, const std::string& value) {
    out << fmt::format("{:<22}{}\n", what, value);
  };
  line("scene", scene.title);
  line("ice", ice_name(scene.ice));
  line("particles", fmt::format("{}", preview.particles));
  if (scene.whole_sheet) line("domain", describe_domain(scene));
  if (sph::has_quiet_ice(scene.ice))
    line("quiet ice",
         fmt::format("sleeps until something faster than {:.3g} m/s reaches it", scene.ice.numerics.quiet_speed));
  line("boundary particles", fmt::format("{}", preview.boundary_particles));
  line("step", fmt::format("{:.4g} s, limited by {}", preview.step, preview.limiter));
  line("steps", fmt::format("{:.4g} to {:.4g} s", preview.steps, scene.run.end_time));
  line("memory", fmt::format("{:.3g} GB of {:.3g} GB", preview.memory_bytes / 1e9, preview.machine_memory_bytes / 1e9));
  line("run time", "about " + duration(preview.seconds));
  line("coupling stability", fmt::format("{:.3g}", preview.coupling_stability_number));
  print_list("left out", preview.terms_left_out, out);
  print_list("calibrated", scene.calibrated, out);
  print_list("warning", preview.warnings, out);
}

}  // namespace nilas::cases
