// Independent oracles for the shapes: membership by inequality, dense point sets, quadrature over slices. Nothing here
// uses rigid/shape.cpp.
#pragma once

#include <algorithm>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "rigid/shape.hpp"

namespace nilas::rigid::oracle {

struct Case {
  std::string name;
  Shape shape;
};
inline std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

/// Every convex shape of closed form, and the HCC with every proportion of nose to radius and to length.
inline std::vector<Case> cases() {
  return {{"hcc", Hcc{1.8, 0.3, 0.2}},
          {"hcc_hemispherical", Hcc{1.0, 0.3, 0.15}},
          {"hcc_blunt", Hcc{1.0, 0.3, 0.05}},
          {"hcc_short_and_blunt", Hcc{0.08, 0.3, 0.05}},
          {"hcc_needle", Hcc{1.8, 0.3, 1.5}},
          {"hcc_all_nose", Hcc{0.2, 0.3, 0.2}},
          {"hcc_all_blunt_nose", Hcc{0.05, 0.3, 0.05}},
          {"sphere", Sphere{0.061}},
          {"box", Box{{0.3, 0.5, 0.7}}},
          {"plate", Box{{2.0, 1.0, 0.02}}},
          {"cylinder", Cylinder{1.6, 0.3}},
          {"disc", Cylinder{0.05, 1.0}},
          {"capsule", Capsule{1.44, 0.3}},
          {"capsule_of_no_wall", Capsule{0.3, 0.3}},
          {"cone", Cone{0.8, 0.3}},
          {"cone_needle", Cone{1.8, 0.1}},
          {"cone_flat", Cone{0.1, 1.0}}};
}

struct MeridianPoint {
  double rho, z;
};

/// The meridian from the upper to the lower end, each smooth piece cut into n steps. Empty for a box.
inline std::vector<MeridianPoint> meridian(const Shape& shape, int n) {
  std::vector<MeridianPoint> points;
  const auto line = [&](MeridianPoint p, MeridianPoint q) {
    for (int i = 0; i <= n; ++i) {
      const double s = double(i) / n;
      points.push_back({p.rho + s * (q.rho - p.rho), p.z + s * (q.z - p.z)});
    }
  };
  const auto arc = [&](double radius, double height, double z_base, double from, double to) {
    for (int i = 0; i <= n; ++i) {
      const double t = from + (to - from) * i / n;
      points.push_back({radius * std::sin(t), z_base + height * std::cos(t)});
    }
  };
  constexpr double pi = std::numbers::pi;
  if (const auto* h = std::get_if<Hcc>(&shape)) {
    arc(h->diameter / 2, h->nose_length, -h->nose_length, 0, pi / 2);
    line({h->diameter / 2, -h->nose_length}, {h->diameter / 2, -h->length});
    line({h->diameter / 2, -h->length}, {0, -h->length});
  } else if (const auto* s = std::get_if<Sphere>(&shape)) {
    arc(s->diameter / 2, s->diameter / 2, 0, 0, pi);
  } else if (const auto* c = std::get_if<Cylinder>(&shape)) {
    line({0, c->length / 2}, {c->diameter / 2, c->length / 2});
    line({c->diameter / 2, c->length / 2}, {c->diameter / 2, -c->length / 2});
    line({c->diameter / 2, -c->length / 2}, {0, -c->length / 2});
  } else if (const auto* p = std::get_if<Capsule>(&shape)) {
    const double r = p->diameter / 2, a = p->length / 2 - r;
    arc(r, r, a, 0, pi / 2);
    line({r, a}, {r, -a});
    arc(r, r, -a, pi / 2, pi);
  } else if (const auto* k = std::get_if<Cone>(&shape)) {
    line({0, k->length / 2}, {k->diameter / 2, -k->length / 2});
    line({k->diameter / 2, -k->length / 2}, {0, -k->length / 2});
  }
  return points;
}

/// A cloud on the surface, edges included, and a bound of the distance from any surface point to the cloud.
struct Cloud {
  std::vector<Vec3> points;
  double gap = 0;  // m
};

inline Cloud box_cloud(const Vec3& size) {
  constexpr int n = 100;
  Cloud cloud;
  cloud.gap = size.norm() / (2 * n);
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        Vec3 p;
        p[(axis + 1) % 3] = size[(axis + 1) % 3] * (double(i) / n - 0.5);
        p[(axis + 2) % 3] = size[(axis + 2) % 3] * (double(j) / n - 0.5);
        p[axis] = size[axis] / 2;
        cloud.points.push_back(p);
        p[axis] = -size[axis] / 2;
        cloud.points.push_back(p);
      }
    }
  }
  return cloud;
}

inline Cloud cloud(const Shape& shape) {
  if (const auto* b = std::get_if<Box>(&shape)) return box_cloud(b->size);
  constexpr int angles = 256;
  const std::vector<MeridianPoint> profile = meridian(shape, 150);
  Cloud result;
  double longest_step = 0, radius = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const auto [rho, z] = profile[i];
    if (i > 0) longest_step = std::max(longest_step, std::hypot(rho - profile[i - 1].rho, z - profile[i - 1].z));
    radius = std::max(radius, rho);
    for (int k = 0; k < angles; ++k) {
      const double phi = 2 * std::numbers::pi * k / angles;
      result.points.emplace_back(rho * std::cos(phi), rho * std::sin(phi), z);
    }
  }
  // Half a step of the curved meridian is within 1 % of half its chord here; half an interval around, at most.
  result.gap = std::hypot(0.51 * longest_step, radius * std::numbers::pi / angles);
  return result;
}

/// Negative inside, zero on the surface, positive outside (not a distance).
inline double level(const Shape& shape, const Vec3& p) {
  const double rho = std::hypot(p.x(), p.y());
  if (const auto* h = std::get_if<Hcc>(&shape)) {
    const double above = std::max(0.0, p.z() + h->nose_length) / h->nose_length;
    return std::max(std::hypot(2 * rho / h->diameter, above) - 1, -1 - p.z() / h->length);
  }
  if (const auto* s = std::get_if<Sphere>(&shape)) return 2 * p.norm() / s->diameter - 1;
  if (const auto* b = std::get_if<Box>(&shape)) return (2 * p.cwiseAbs().cwiseQuotient(b->size)).maxCoeff() - 1;
  if (const auto* c = std::get_if<Capsule>(&shape)) {
    const double beyond = std::max(0.0, std::abs(p.z()) - (c->length - c->diameter) / 2);
    return 2 * std::hypot(rho, beyond) / c->diameter - 1;
  }
  if (const auto* k = std::get_if<Cone>(&shape)) {
    return std::max(2 * rho / k->diameter + p.z() / k->length - 0.5, -0.5 - p.z() / k->length);
  }
  const auto& c = std::get<Cylinder>(shape);
  return std::max(2 * rho / c.diameter, 2 * std::abs(p.z()) / c.length) - 1;
}

/// Axis-aligned bounds.
struct Bounds {
  Vec3 low, high;
};
inline Bounds bounds(const Shape& shape) {
  if (const auto* b = std::get_if<Box>(&shape)) return {-0.5 * b->size, 0.5 * b->size};
  double radius = 0, low = INFINITY, high = -INFINITY;
  for (const auto& [rho, z] : meridian(shape, 2)) {
    radius = std::max(radius, rho);
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return {{-radius, -radius, low}, {radius, radius, high}};
}

struct Integrals {
  double volume = 0;
  Vec3 centroid = Vec3::Zero();
  Vec3 inertia_per_mass = Vec3::Zero();  // about the centroid
};

/// A slice of the body normal to z: its area and its second moments int x^2 dA, int y^2 dA.
struct Slice {
  double area, xx, yy;
};
inline Slice slice(const Shape& shape, double z) {
  if (const auto* b = std::get_if<Box>(&shape)) {
    const double x = b->size.x(), y = b->size.y();
    return {x * y, y * x * x * x / 12, x * y * y * y / 12};
  }
  double r = 0;
  if (const auto* h = std::get_if<Hcc>(&shape)) {
    const double u = std::max(0.0, z + h->nose_length) / h->nose_length;
    r = h->diameter / 2 * std::sqrt(std::max(0.0, 1 - u * u));
  } else if (const auto* s = std::get_if<Sphere>(&shape)) {
    r = std::sqrt(std::max(0.0, s->diameter * s->diameter / 4 - z * z));
  } else if (const auto* c = std::get_if<Capsule>(&shape)) {
    const double u = std::max(0.0, std::abs(z) - (c->length - c->diameter) / 2);
    r = std::sqrt(std::max(0.0, c->diameter * c->diameter / 4 - u * u));
  } else if (const auto* k = std::get_if<Cone>(&shape)) {
    r = k->diameter * (0.25 - 0.5 * z / k->length);
  } else {
    r = std::get<Cylinder>(shape).diameter / 2;
  }
  const double area = std::numbers::pi * r * r;
  return {area, area * r * r / 4, area * r * r / 4};
}

/// Midpoint rule over slices; its error is below 1e-9 of the result.
inline Integrals integrate(const Shape& shape) {
  constexpr int n = 200000;
  const Bounds b = bounds(shape);
  const double dz = (b.high.z() - b.low.z()) / n;
  double volume = 0, z1 = 0, z2 = 0, xx = 0, yy = 0;
  for (int i = 0; i < n; ++i) {
    const double z = b.low.z() + (i + 0.5) * dz;
    const Slice s = slice(shape, z);
    volume += s.area * dz;
    z1 += s.area * z * dz;
    z2 += s.area * z * z * dz;
    xx += s.xx * dz;
    yy += s.yy * dz;
  }
  const double zc = z1 / volume;
  const double zz = z2 / volume - zc * zc;
  return {volume, {0, 0, zc}, {yy / volume + zz, xx / volume + zz, (xx + yy) / volume}};
}

/// Surface area from the frustums of a fine polygon (not for a box).
inline double revolved_area(const Shape& shape) {
  const std::vector<MeridianPoint> p = meridian(shape, 100000);
  double area = 0;
  for (std::size_t i = 1; i < p.size(); ++i) {
    area += std::numbers::pi * (p[i].rho + p[i - 1].rho) * std::hypot(p[i].rho - p[i - 1].rho, p[i].z - p[i - 1].z);
  }
  return area;
}

}  // namespace nilas::rigid::oracle
