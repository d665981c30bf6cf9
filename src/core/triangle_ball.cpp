// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/triangle_ball.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "share_by_boundary.hpp"
#include "share_by_sectors.hpp"
#include "share_of_simplex.hpp"

namespace kappa {
namespace {

/// Flatter triangles, as height over longest edge, go through the boundary form in extended precision.
constexpr double kSliver = 1e-3;
/// So do triangles of a smaller height over radius, for which doubles lose digits along the edges.
constexpr double kTiny = 3e-4;
/// The sectors' moments are of the size of radius^3 and those of a triangle height^2 x longest edge, over its area:
/// where the latter is smaller by more than this, the boundary form takes over.
constexpr double kSmall = 1e-3;

double distance_sq_to_segment(const Vec3& a, const Vec3& b) {
  const Vec3 e = b - a;
  const double length_sq = e.squaredNorm();
  const double t = length_sq > 0 ? std::clamp(-a.dot(e) / length_sq, 0.0, 1.0) : 0.0;
  return (a + t * e).squaredNorm();
}

double longest_edge_sq(const std::array<Vec3, 3>& x) {
  return std::max({(x[1] - x[0]).squaredNorm(), (x[2] - x[1]).squaredNorm(), (x[0] - x[2]).squaredNorm()});
}

/// The form that is accurate for the triangle.
TriangleShare share_by_best_form(const std::array<Vec3, 3>& x, double radius, double twice_area, double longest) {
  const double height = longest > 0 ? twice_area / longest : 0.0;
  if (height <= kDegenerateRatio * longest) return detail::share_of_simplex(x, radius);
  if (height < kSliver * longest || height < kTiny * radius) return detail::share_by_long_boundary(x, radius);
  if (height * height * longest < kSmall * radius * radius * radius) return detail::share_by_boundary(x, radius);
  return detail::share_by_sectors(x, radius);
}

}  // namespace

double distance_sq_to_triangle(const std::array<Vec3, 3>& x) {
  const double least = std::min(
      {distance_sq_to_segment(x[0], x[1]), distance_sq_to_segment(x[1], x[2]), distance_sq_to_segment(x[2], x[0])});
  std::size_t i = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if ((x[(k + 1) % 3] - x[k]).squaredNorm() > (x[(i + 1) % 3] - x[i]).squaredNorm()) i = k;
  }
  // In a frame on the longest edge: there the plane of a sliver may be uncertain, its points are not.
  const Vec3& a = x[i];
  const Vec3 edge = x[(i + 1) % 3] - a, side = x[(i + 2) % 3] - a;
  const double length = edge.norm();
  if (length == 0) return least;
  const Vec3 e = edge / length;
  const Vec3 across = side - side.dot(e) * e;
  const double height = across.norm();
  if (height <= kDegenerateRatio * length) return least;
  const Vec3 m = across / height, to_line = a - a.dot(e) * e;
  const double y = -to_line.dot(m) / height, x_foot = -a.dot(e), x_apex = side.dot(e);
  const bool above = y >= 0 && x_foot >= y * x_apex && x_foot <= length + y * (x_apex - length);
  if (!above) return least;
  const double d = to_line.dot(e.cross(m));
  return std::min(least, d * d);
}

bool triangle_meets_ball(const std::array<Vec3, 3>& x, double radius) {
  return distance_sq_to_triangle(x) <= radius * radius;
}

TriangleShare triangle_ball_share(const std::array<Vec3, 3>& x, double radius) {
  const double radius_sq = radius * radius;
  // A ball is convex: it holds the triangle if it holds the corners.
  if (x[0].squaredNorm() <= radius_sq && x[1].squaredNorm() <= radius_sq && x[2].squaredNorm() <= radius_sq)
    return {1.0, 1.0 / 3, 1.0 / 3, true};
  const double longest = std::sqrt(longest_edge_sq(x));
  const double twice_area = (x[1] - x[0]).cross(x[2] - x[0]).norm();
  TriangleShare part = share_by_best_form(x, radius, twice_area, longest);
  // Far above what rounding leaves of a missed triangle; anything less is decided by the distance.
  constexpr double kCertain = 1e-9;
  const double area = 0.5 * part.share * twice_area;
  part.met = area > kCertain * radius * std::max(radius, longest) || triangle_meets_ball(x, radius);
  return part.met ? part : TriangleShare{};
}

}  // namespace kappa
