#include "tests/benchmarks/struck_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nilas::benchmarks {

Impact struck(const sph::IceSpec& ice, rigid::BodySpec body, double depth) {
  body.position += depth * body.velocity.normalized();
  const auto outside = [&](const Vec3& x) {
    const Vec3 own = body.orientation.conjugate() * (x - body.position) + body.mass.centre_of_mass;
    return rigid::closest_point(body.shape, own).distance > 0.5 * ice.spacing;
  };
  return Impact(ice, {Body(body)}, {}, {.velocity = {}, .keep = outside, .displacement = {}});
}

void step(Impact& impact) { impact.advance(impact.stable_step().dt); }

double disc_diameter(double particles, double thickness, double spacing) {
  const double layers = std::round(thickness / spacing);
  const double across = std::sqrt(4 * particles / (std::numbers::pi * layers));  // spacings
  return 2 * spacing * std::round(across / 2);
}

double pairs_per_particle(double diameter, double thickness, double spacing, double reach) {
  const int across = static_cast<int>(std::round(diameter / spacing));
  const int layers = static_cast<int>(std::round(thickness / spacing));
  const int range = static_cast<int>(reach / spacing);
  const double radius2 = 0.25 * across * across;  // in spacings, as all below
  const auto inside = [&](int i, int j) {
    const double x = i + 0.5 - 0.5 * across, y = j + 0.5 - 0.5 * across;
    return x * x + y * y <= radius2;
  };
  double columns = 0, pairs = 0;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j) {
      if (!inside(i, j)) continue;
      ++columns;
      for (int a = -range; a <= range; ++a)
        for (int b = -range; b <= range; ++b) {
          const double above2 = reach * reach / (spacing * spacing) - a * a - b * b;
          if (above2 < 0 || !inside(i + a, j + b)) continue;
          for (int c = -range; c <= range; ++c)
            if (c * c <= above2 && (a || b || c)) pairs += std::max(0, layers - std::abs(c));
        }
    }
  return pairs / (columns * layers);
}

}  // namespace nilas::benchmarks
