// Scattered debris: particles whose volume has grown far beyond what ice can expand by. It says how far the fragments
// around have scattered, not how dense they are, and must not be mixed into the density of sound ice.
#pragma once

namespace nilas::sph {

inline bool is_scattered(double volume, double solid_volume) { return volume > 1.5 * solid_volume; }

}  // namespace nilas::sph
