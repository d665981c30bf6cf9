// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "check.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/implicit.hpp"
#include "kappa/shapes/random.hpp"
#include "patches.hpp"

namespace kappa {
namespace {

/// A cloud of `sampling.points` draws.
template <class Draw>
Scan draw_cloud(const SampleOptions& sampling, const Draw& draw) {
  detail::require_between("points", static_cast<double>(sampling.points), 1, detail::kMaxPoints);
  Random random(sampling.seed);
  std::vector<SurfacePoint> points;
  points.reserve(sampling.points);
  for (std::size_t i = 0; i < sampling.points; ++i) points.push_back(draw(random));
  return scan_of(points);
}

/// Sums of the areas of the triangles up to each.
std::vector<double> cumulated_areas(const Scan& mesh) {
  std::vector<double> sums;
  sums.reserve(mesh.faces.size());
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    const Vec3 e1 = mesh.points[face[1]] - mesh.points[face[0]], e2 = mesh.points[face[2]] - mesh.points[face[0]];
    sum += 0.5 * e1.cross(e2).norm();
    sums.push_back(sum);
  }
  return sums;
}

Vec3 draw_in_triangle(Random& random, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double s = std::sqrt(random.uniform()), t = random.uniform();
  return (1 - s) * a + s * ((1 - t) * b + t * c);
}

}  // namespace

Scan sample_sphere(double radius, const SampleOptions& sampling) {
  detail::require_positive("radius", radius);
  return draw_cloud(sampling, [&](Random& random) { return detail::sphere_point(radius, random.direction()); });
}

Scan sample_torus(double major_radius, double minor_radius, const SampleOptions& sampling) {
  detail::require_positive("minor_radius", minor_radius);
  detail::require_positive("major_radius", major_radius);
  if (!(major_radius > minor_radius)) {
    detail::refuse("major_radius", major_radius, "above minor_radius, which is " + detail::number_text(minor_radius));
  }
  return draw_cloud(sampling, [&](Random& random) {
    const double a = random.uniform(0, 2 * kPi);
    // Area is proportional to the distance from the axis.
    double b;
    do {
      b = random.uniform(0, 2 * kPi);
    } while (random.uniform() * (major_radius + minor_radius) > major_radius + minor_radius * std::cos(b));
    return detail::torus_point(major_radius, minor_radius, a, b);
  });
}

Scan sample_cylinder(double radius, double height, const SampleOptions& sampling) {
  detail::require_positive("radius", radius);
  detail::require_positive("height", height);
  return draw_cloud(sampling, [&](Random& random) {
    const double angle = random.uniform(0, 2 * kPi);
    return detail::cylinder_point(radius, angle, random.uniform(0, height));
  });
}

Scan sample_quadric(double a, double b, double size, const SampleOptions& sampling) {
  detail::require_finite("a", a);
  detail::require_finite("b", b);
  detail::require_positive("size", size);
  const auto area_ratio = [&](double x, double y) { return std::sqrt(1 + a * a * x * x + b * b * y * y); };
  const double largest = area_ratio(0.5 * size, 0.5 * size);
  return draw_cloud(sampling, [&](Random& random) {
    double x, y;
    do {
      x = random.uniform(-0.5 * size, 0.5 * size);
      y = random.uniform(-0.5 * size, 0.5 * size);
    } while (random.uniform() * largest > area_ratio(x, y));
    return detail::quadric_point(a, b, x, y);
  });
}

Scan sample_goursat(const SampleOptions& sampling) {
  constexpr double kStep = 0.25;
  const Scan mesh = goursat({kStep, Extraction::SurfaceNets});
  const std::vector<double> sums = cumulated_areas(mesh);
  return draw_cloud(sampling, [&](Random& random) {
    const auto entry = std::upper_bound(sums.begin(), sums.end() - 1, random.uniform(0, sums.back()));
    const auto face = mesh.faces[static_cast<std::size_t>(entry - sums.begin())];
    const Vec3 flat = draw_in_triangle(random, mesh.points[face[0]], mesh.points[face[1]], mesh.points[face[2]]);
    const Vec3 x = project_to_surface(goursat_function, flat, 1e-13);
    return surface_point(x, goursat_function(x));
  });
}

}  // namespace kappa
