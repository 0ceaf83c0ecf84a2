// Scenes as text for the tests of the reader.
#pragma once

#include <stdexcept>
#include <string>

namespace nilas::test {

/// A complete scene: an HCC under a small disc. The tests change single lines of it.
inline std::string oblique_scene() {
  return "title = \"a small sheet\"\n"           // line 1
         "[ice]\n"                               // line 2
         "shape = \"disc\"\n"                    // line 3
         "diameter_m = 1.2\n"                    // line 4
         "thickness_m = 0.3\n"                   // line 5
         "spacing_m = 0.05\n"                    // line 6
         "fixed = \"rim\"\n"                     // line 7
         "[ice.material]\n"                      // line 8
         "density_kg_m3 = 900\n"                 // line 9
         "poisson_ratio = 0.33\n"                // line 10
         "[[body]]\n"                            // line 11
         "shape = \"hcc\"\n"                     // line 12
         "length_m = 1.8\n"                      // line 13
         "diameter_m = 0.3\n"                    // line 14
         "nose_length_m = 0.2\n"                 // line 15
         "mass_kg = 174.1\n"                     // line 16
         "centre_of_mass_from_tip_m = 0.9333\n"  // line 17
         "inertia_kg_m2 = [21.4, 21.4, 3.9]\n"   // line 18
         "[impact]\n"                            // line 19
         "speed_m_s = 100\n"                     // line 20
         "angle_deg = 60\n"                      // line 21
         "gap_m = 0.02\n"                        // line 22
         "[run]\n"                               // line 23
         "end_time_s = 0.001\n";                 // line 24
}

/// `text` with its only occurrence of `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
    throw std::logic_error("not exactly once: " + from);
  return text.replace(at, from.size(), to);
}

}  // namespace nilas::test
