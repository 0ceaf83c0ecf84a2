#include "coupling/debug_drawing.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "rigid/bullet_body.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

using rigid::to_bullet;

namespace {

/// Spreads numbers in sequence evenly over all of 32 bits (multiples of the golden section): those below a threshold
/// are an even share of the lattice, where every n-th could be a single row of it.
std::uint32_t spread(std::uint32_t number) { return number * 2654435769u; }

void draw_cross(btIDebugDraw& drawer, const Vec3& centre, double half, const btVector3& colour) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 arm = half * Vec3::Unit(axis);
    drawer.drawLine(to_bullet(Vec3(centre - arm)), to_bullet(Vec3(centre + arm)), colour);
  }
}

void draw_ice(const sph::Ice& ice, btIDebugDraw& drawer, const DebugDrawing& style) {
  const sph::Particles& p = ice.particles();
  const double share = std::min(1.0, static_cast<double>(style.most_crosses) / static_cast<double>(p.size()));
  const double highest = share * std::numeric_limits<std::uint32_t>::max();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (spread(p.id[i]) > highest) continue;
    const sph::Condition condition = p.condition(i);
    const btVector3& colour = condition == sph::Condition::failed    ? style.failed
                              : condition == sph::Condition::yielded ? style.yielded
                                                                     : style.intact;
    draw_cross(drawer, p.motion[i].position, 0.5 * style.cross_size * ice.spacing(), colour);
  }
}

void draw_tractions(const sph::Surface& surface, double spacing, btIDebugDraw& drawer, const DebugDrawing& style) {
  for (const sph::BoundaryParticle& b : surface.particles) {
    const double traction = b.force.norm() / b.area;
    if (traction == 0) continue;
    const double length = spacing * std::min(style.traction_length * traction, style.longest_traction);
    drawer.drawLine(to_bullet(Vec3(b.position - length * b.force.normalized())), to_bullet(b.position), style.traction);
  }
}

}  // namespace

void debug_draw(const Impact& impact, btIDebugDraw& drawer, const DebugDrawing& style) {
  draw_ice(impact.ice(), drawer, style);
  for (const sph::Surface& surface : impact.surfaces()) draw_tractions(surface, impact.ice().spacing(), drawer, style);
}

}  // namespace NILAS_BULLET
}  // namespace nilas
