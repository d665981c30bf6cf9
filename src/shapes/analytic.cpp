// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/analytic.hpp"

#include "check.hpp"
#include "grid.hpp"
#include "kappa/scan/scan.hpp"
#include "patches.hpp"

namespace kappa {
namespace {

using detail::require_between;
using detail::require_positive;

/// Checks the two counts of a grid and that it is not too large.
void require_grid(const char* name_u, int u, int least_u, const char* name_v, int v, int least_v) {
  require_between(name_u, u, least_u, detail::kMaxPoints);
  require_between(name_v, v, least_v, detail::kMaxPoints);
  const double points = (u + 1.0) * (v + 1.0);
  if (points > detail::kMaxPoints) detail::refuse("number of vertices", points, "at most 1e8");
}

double turn(int part, int parts) {
  return 2 * kPi * part / parts;
}

/// Fan of triangles between vertex `apex` and a closed row of `count` vertices; `sense` is 1 if the row
/// runs counter-clockwise seen from outside, -1 if clockwise.
void add_fan(Faces& faces, Index apex, Index first, Index count, int sense) {
  for (Index i = 0; i < count; ++i) {
    const Index here = first + i, next = first + (i + 1) % count;
    if (sense > 0) {
      faces.add(apex, here, next);
    } else {
      faces.add(apex, next, here);
    }
  }
}

/// Disc at height `z` that faces along the axis in the sense `sense`.
void add_cap(std::vector<SurfacePoint>& points, Faces& faces, const CylinderOptions& options, double z, int sense) {
  const auto apex = static_cast<Index>(points.size());
  const auto flat_point = [&](const Vec3& x) {
    SurfacePoint point;
    point.x = x;
    point.normal = sense * Vec3::UnitZ();
    point.curvature.mean = point.curvature.gaussian = point.curvature.k_min = point.curvature.k_max = 0;
    points.push_back(point);
  };
  flat_point(z * Vec3::UnitZ());
  for (int i = 0; i < options.slices; ++i) {
    flat_point(detail::cylinder_point(options.radius, turn(i, options.slices), z).x);
  }
  add_fan(faces, apex, apex + 1, static_cast<Index>(options.slices), sense);
}

}  // namespace

Scan sphere(const SphereOptions& options) {
  require_positive("radius", options.radius);
  require_grid("slices", options.slices, 3, "rings", options.rings, 2);
  std::vector<SurfacePoint> points;
  for (int j = 1; j < options.rings; ++j) {
    const double latitude = kPi * j / options.rings - 0.5 * kPi;
    for (int i = 0; i < options.slices; ++i) {
      const double longitude = turn(i, options.slices);
      const Vec3 direction(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                           std::sin(latitude));
      points.push_back(detail::sphere_point(options.radius, direction));
    }
  }
  const auto slices = static_cast<Index>(options.slices), bands = static_cast<Index>(options.rings - 1);
  const auto south = static_cast<Index>(points.size()), north = south + 1;
  points.push_back(detail::sphere_point(options.radius, -Vec3::UnitZ()));
  points.push_back(detail::sphere_point(options.radius, Vec3::UnitZ()));
  Scan scan = scan_of(points);
  add_fan(scan.faces, south, 0, slices, -1);
  detail::add_grid_faces(scan.faces, {slices, bands, true, false, 0}, options.faces);
  add_fan(scan.faces, north, (bands - 1) * slices, slices, 1);
  return scan;
}

Scan torus(const TorusOptions& options) {
  require_positive("minor_radius", options.minor_radius);
  require_positive("major_radius", options.major_radius);
  if (!(options.major_radius > options.minor_radius)) {
    detail::refuse("major_radius", options.major_radius,
                   "above minor_radius, which is " + detail::number_text(options.minor_radius));
  }
  require_grid("slices", options.slices, 3, "sides", options.sides, 3);
  require_between("twist", options.twist, -100, 100);
  std::vector<SurfacePoint> points;
  for (int j = 0; j < options.sides; ++j) {
    for (int i = 0; i < options.slices; ++i) {
      const double a = turn(i, options.slices);
      const double b = turn(j, options.sides) + options.twist * a;
      points.push_back(detail::torus_point(options.major_radius, options.minor_radius, a, b));
    }
  }
  Scan scan = scan_of(points);
  const auto slices = static_cast<Index>(options.slices), sides = static_cast<Index>(options.sides);
  detail::add_grid_faces(scan.faces, {slices, sides, true, true, 0}, options.faces);
  return scan;
}

Scan cylinder(const CylinderOptions& options) {
  require_positive("radius", options.radius);
  require_positive("height", options.height);
  require_grid("slices", options.slices, 3, "rings", options.rings, 1);
  std::vector<SurfacePoint> points;
  for (int j = 0; j <= options.rings; ++j) {
    for (int i = 0; i < options.slices; ++i) {
      const double z = options.height * j / options.rings;
      points.push_back(detail::cylinder_point(options.radius, turn(i, options.slices), z));
    }
  }
  Faces faces;
  const auto slices = static_cast<Index>(options.slices), rows = static_cast<Index>(options.rings + 1);
  detail::add_grid_faces(faces, {slices, rows, true, false, 0}, options.faces);
  if (options.caps == CylinderCaps::Flat) {
    add_cap(points, faces, options, 0, -1);
    add_cap(points, faces, options, options.height, 1);
  }
  Scan scan = scan_of(points);
  scan.faces = std::move(faces);
  return scan;
}

Scan quadric(const QuadricOptions& options) {
  detail::require_finite("a", options.a);
  detail::require_finite("b", options.b);
  require_positive("size", options.size);
  require_grid("cells", options.cells, 1, "cells", options.cells, 1);
  std::vector<SurfacePoint> points;
  const auto coordinate = [&](int i) { return options.size * (static_cast<double>(i) / options.cells - 0.5); };
  for (int j = 0; j <= options.cells; ++j) {
    for (int i = 0; i <= options.cells; ++i) {
      points.push_back(detail::quadric_point(options.a, options.b, coordinate(i), coordinate(j)));
    }
  }
  Scan scan = scan_of(points);
  const auto side = static_cast<Index>(options.cells + 1);
  detail::add_grid_faces(scan.faces, {side, side, false, false, 0}, options.faces);
  return scan;
}

Scan saddle(const SaddleOptions& options) {
  require_positive("a", options.a);
  return quadric({1 / options.a, -1 / options.a, options.size, options.cells, options.faces});
}

Scan plane(const PlaneOptions& options) {
  return quadric({0, 0, options.size, options.cells, options.faces});
}

Scan lantern(const LanternOptions& options) {
  require_positive("radius", options.radius);
  require_positive("height", options.height);
  require_grid("slices", options.slices, 3, "rings", options.rings, 1);
  std::vector<SurfacePoint> points;
  for (int j = 0; j <= options.rings; ++j) {
    for (int i = 0; i < options.slices; ++i) {
      const double angle = turn(2 * i + j % 2, 2 * options.slices);
      points.push_back(detail::cylinder_point(options.radius, angle, options.height * j / options.rings));
    }
  }
  Scan scan = scan_of(points);
  const auto slices = static_cast<Index>(options.slices);
  for (Index j = 0; j < static_cast<Index>(options.rings); ++j) {
    // Of an odd ring, corner i lies between corners i and i + 1 of the even rings.
    const Index low = j * slices, high = low + slices, shift = j % 2;
    for (Index i = 0; i < slices; ++i) {
      const Index next = (i + 1) % slices;
      scan.faces.add(low + i, low + next, high + (shift == 1 ? next : i));
      scan.faces.add(high + i, low + (shift == 1 ? i : next), high + next);
    }
  }
  return scan;
}

const std::vector<std::string>& shape_names() {
  static const std::vector<std::string> names = {"sphere", "icosphere", "torus",   "cylinder", "quadric", "saddle",
                                                 "plane",  "goursat",   "lantern", "airborne", "waves"};
  return names;
}

}  // namespace kappa
