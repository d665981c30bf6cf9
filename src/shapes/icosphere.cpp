// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include <Eigen/Geometry>

#include "check.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/shapes/analytic.hpp"
#include "patches.hpp"

namespace kappa {
namespace {

using Triangle = std::array<Index, 3>;

/// Splits triangles of the unit sphere in four.
class Subdivision {
 public:
  explicit Subdivision(std::vector<Vec3>& points) : points_(points) {}

  std::vector<Triangle> split(const std::vector<Triangle>& triangles) {
    middles_.clear();
    std::vector<Triangle> result;
    result.reserve(4 * triangles.size());
    for (const auto& [a, b, c] : triangles) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      result.insert(result.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return result;
  }

 private:
  Index middle(Index a, Index b) {
    const std::uint64_t edge = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [entry, is_new] = middles_.try_emplace(edge, static_cast<Index>(points_.size()));
    if (is_new) points_.push_back((points_[a] + points_[b]).normalized());
    return entry->second;
  }

  std::vector<Vec3>& points_;
  std::unordered_map<std::uint64_t, Index> middles_;
};

/// Even permutations of (0, +-1, +-golden ratio).
std::vector<Vec3> icosahedron_points() {
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vec3> points;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double one : {1.0, -1.0}) {
      for (const double other : {golden, -golden}) {
        Vec3 point;
        point[axis] = 0;
        point[(axis + 1) % 3] = one;
        point[(axis + 2) % 3] = other;
        points.push_back(point.normalized());
      }
    }
  }
  return points;
}

/// The 20 triples of neighbours, turning counter-clockwise seen from outside.
std::vector<Triangle> icosahedron_faces(const std::vector<Vec3>& points) {
  const auto joined = [&](Index a, Index b) { return points[a].dot(points[b]) > 0.4; };
  std::vector<Triangle> faces;
  for (Index a = 0; a < 12; ++a) {
    for (Index b = a + 1; b < 12; ++b) {
      for (Index c = b + 1; c < 12; ++c) {
        if (!joined(a, b) || !joined(b, c) || !joined(c, a)) continue;
        const bool outward = points[a].dot(points[b].cross(points[c])) > 0;
        faces.push_back(outward ? Triangle{a, b, c} : Triangle{a, c, b});
      }
    }
  }
  return faces;
}

}  // namespace

Scan icosphere(const IcosphereOptions& options) {
  detail::require_positive("radius", options.radius);
  detail::require_between("subdivisions", options.subdivisions, 0, 11);
  std::vector<Vec3> directions = icosahedron_points();
  std::vector<Triangle> triangles = icosahedron_faces(directions);
  Subdivision subdivision(directions);
  for (int pass = 0; pass < options.subdivisions; ++pass) triangles = subdivision.split(triangles);

  std::vector<SurfacePoint> points;
  points.reserve(directions.size());
  for (const auto& direction : directions) points.push_back(detail::sphere_point(options.radius, direction));
  Scan scan = scan_of(points);
  scan.faces.reserve(triangles.size(), 3 * triangles.size());
  for (const auto& [a, b, c] : triangles) scan.faces.add(a, b, c);
  return scan;
}

}  // namespace kappa
