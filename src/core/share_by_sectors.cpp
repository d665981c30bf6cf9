// SPDX-License-Identifier: BSD-3-Clause
#include "share_by_sectors.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace kappa::detail {
namespace {

constexpr double kTiniest = 1e-300;

/// Area and first moment of a part of the disc, relative to the disc's centre.
struct DiscPart {
  double area = 0;
  Vec3 moment = Vec3::Zero();
};

/// Adds the area and the moment of (disc centre, edge) n disc for the edge from `a` in direction `e`: a chord part,
/// and sectors beyond it on either side. Signed, so that the three edges of a triangle add up to it.
void add_edge(const Vec3& a, const Vec3& e, double length, const Vec3& n, double r_sq, double r, DiscPart& part) {
  // In the frame (e, m = n x e) around the disc's centre the edge is at (ta ... tb, -h), its part in the disc at
  // (sa ... sb, -h).
  const double h = n.dot(a.cross(e)), h_sq = h * h;
  const double ta = a.dot(e), tb = ta + length;
  const double w = std::sqrt(std::max(0.0, r_sq - h_sq));
  const double sa = std::clamp(ta, -w, w), sb = std::clamp(tb, -w, w);

  // Product of the two complex numbers whose arguments are the angles of the sectors: one atan2 an edge.
  const double re_a = ta * sa + h_sq, im_a = h * (sa - ta);
  const double re_b = sb * tb + h_sq, im_b = h * (tb - sb);
  const double theta = std::atan2(re_a * im_b + im_a * re_b, re_a * re_b - im_a * im_b);
  const double chord = h * (sb - sa);
  part.area += 0.5 * (chord + r_sq * theta);

  // A sector's moment is r^3/3 times the difference of the directions of its sides, turned by a right angle. For an
  // end inside the disc both directions are the same number and cancel exactly.
  const auto over_norm = [h_sq](double t) { return 1 / std::sqrt(std::max(t * t + h_sq, kTiniest)); };
  const double pa = over_norm(ta), qa = over_norm(sa), qb = over_norm(sb), pb = over_norm(tb);
  const double turn_e = (sa * qa - ta * pa) + (tb * pb - sb * qb), turn_m = -h * ((qa - pa) + (pb - qb));
  const double sector = r * r_sq / 3;
  const double moment_e = chord / 6 * (sa + sb) + sector * turn_m;
  const double moment_m = chord / 6 * (-2 * h) - sector * turn_e;
  part.moment += moment_e * e + moment_m * n.cross(e);
}

}  // namespace

TriangleShare share_by_sectors(const std::array<Vec3, 3>& x, double radius) {
  const Vec3 e1 = x[1] - x[0], e2 = x[2] - x[0];
  const Vec3 normal = e1.cross(e2);
  const double twice_area = normal.norm();
  const Vec3 n = normal / twice_area;
  const double d = n.dot(x[0]);
  const double r_sq = radius * radius - d * d;
  if (r_sq <= 0) return {};
  const double r = std::sqrt(r_sq);
  DiscPart part;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 edge = x[(i + 1) % 3] - x[i];
    const double length = edge.norm();
    add_edge(x[i], edge / length, length, n, r_sq, r, part);
  }
  if (part.area <= 0) return {};
  const Vec3 centroid = part.moment / part.area + d * n - x[0];
  const double b1 = std::clamp(n.dot(centroid.cross(e2)) / twice_area, 0.0, 1.0);
  const double b2 = std::clamp(n.dot(e1.cross(centroid)) / twice_area, 0.0, 1.0 - b1);
  return {std::min(1.0, 2 * part.area / twice_area), b1, b2, true};
}

}  // namespace kappa::detail
