#include "cases/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sph/kernel.hpp"

namespace nilas::cases {

namespace {

const sph::PieceSpec& whole(const Scene& scene) {
  return scene.whole_sheet ? *scene.whole_sheet : scene.ice.pieces.front();
}

/// When a point that starts `height` above the sheet's middle and rises at `speed` is inside the sheet, within the run.
struct Stay {
  double from, to;  // s; none if to < from
};
Stay stay(double height, double speed, double half_thickness, double end_time) {
  if (speed == 0) return std::abs(height) < half_thickness ? Stay{0, end_time} : Stay{0, -1};
  const double a = (-half_thickness - height) / speed, b = (half_thickness - height) / speed;
  return {std::max(0.0, std::min(a, b)), std::min(end_time, std::max(a, b))};
}

}  // namespace

Passage passage(const sph::PieceSpec& sheet, const std::vector<rigid::BodySpec>& bodies, double end_time) {
  Passage passage;
  for (const rigid::BodySpec& body : bodies) {
    const Vec3 velocity = body.motion == rigid::Motion::fixed ? Vec3::Zero().eval() : body.velocity;
    const Vec3 path = velocity.stableNormalized();
    double half_width = 0;
    bool enters = false;
    for (const rigid::SurfacePoint& point : rigid::surface_points(body.shape, body.boundary_spacing)) {
      const Vec3 r = body.orientation * (point.position - body.mass.centre_of_mass);
      half_width = std::max(half_width, (r - r.dot(path) * path).norm());
      const Vec3 start = body.position + r - sheet.centre;
      const Stay inside = stay(start.z(), velocity.z(), 0.5 * sheet.thickness, end_time);
      if (inside.to < inside.from) continue;
      enters = true;
      // On a straight line the distance is largest at one of its ends.
      for (const double t : {inside.from, inside.to})
        passage.reach = std::max(passage.reach, (start + t * velocity).head<2>().norm());
    }
    if (enters) passage.half_width = std::max(passage.half_width, half_width);
  }
  return passage;
}

double rim_depth(const sph::IceSpec& ice) {
  return sph::WendlandC2(ice.numerics.smoothing_ratio * ice.spacing).support_radius();
}

double domain_diameter(const Scene& scene) {
  const sph::PieceSpec& sheet = whole(scene);
  const Passage hole = passage(sheet, scene.bodies, scene.run.end_time);
  return 2 * (hole.reach + 2 * hole.half_width + sheet.thickness + rim_depth(scene.ice));
}

Scene cut(Scene scene, double diameter) {
  const sph::PieceSpec sheet = whole(scene);
  const double dx = scene.ice.spacing;
  // As many cells more or less on either side: an even number apart.
  const double all = std::round(sheet.diameter / dx), wanted = std::ceil(diameter / dx * (1 - 1e-12));
  scene.whole_sheet = sheet;
  sph::PieceSpec& part = scene.ice.pieces.front() = sheet;
  if (wanted >= all - 1) return scene;
  part.diameter = (wanted + std::fmod(all - wanted, 2)) * dx;
  part.fixed = {};
  part.absorbing_rim = true;
  return scene;
}

std::string describe_domain(const Scene& scene) {
  if (!scene.whole_sheet) return {};
  const sph::PieceSpec& part = scene.ice.pieces.front();
  if (!part.absorbing_rim) return fmt::format("auto: the whole sheet of {:.4g} m", part.diameter);
  const double reach = passage(part, scene.bodies, scene.run.end_time).reach, depth = rim_depth(scene.ice);
  return fmt::format(
      "auto: {:.4g} m of the sheet's {:.4g} m: bodies reach {:.3g} m from its middle, then {:.3g} m of ice and an "
      "absorbing rim of {:.3g} m",
      part.diameter, scene.whole_sheet->diameter, reach, 0.5 * part.diameter - depth - reach, depth);
}

}  // namespace nilas::cases
