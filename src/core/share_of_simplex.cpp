// SPDX-License-Identifier: BSD-3-Clause
#include "share_of_simplex.hpp"

#include <algorithm>
#include <cmath>

namespace kappa::detail {
namespace {

/// Part of the parameter simplex, whose corners are numbered by increasing position on the line: its share and
/// the integrals of the barycentric coordinates over it (each 1/3 for the whole).
struct Part {
  double share = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
};

/// The corner `k` of the simplex cut off at the fractions f_i, f_j of its two edges.
Part corner_part(int k, int i, int j, double f_i, double f_j) {
  Part p;
  p.share = f_i * f_j;
  p.moment[i] = p.share * f_i / 3;
  p.moment[j] = p.share * f_j / 3;
  p.moment[k] = p.share - p.moment[i] - p.moment[j];
  return p;
}

/// The part whose position on the line is at most `to`, for corners at t[0] <= t[1] <= t[2].
Part part_below(const std::array<double, 3>& t, double to) {
  Part whole;
  whole.share = 1;
  whole.moment.setConstant(1.0 / 3);
  if (to < t[0]) return {};
  if (to >= t[2]) return whole;
  if (to < t[1]) return corner_part(0, 1, 2, (to - t[0]) / (t[1] - t[0]), (to - t[0]) / (t[2] - t[0]));
  const double f0 = (t[2] - to) / (t[2] - t[0]);
  const double f1 = t[2] > t[1] ? (t[2] - to) / (t[2] - t[1]) : 1.0;
  const Part rest = corner_part(2, 0, 1, f0, f1);
  whole.share -= rest.share;
  whole.moment -= rest.moment;
  return whole;
}

}  // namespace

TriangleShare share_of_simplex(const std::array<Vec3, 3>& x, double radius) {
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    const auto length_sq = [&](std::size_t k) { return (x[(k + 1) % 3] - x[k]).squaredNorm(); };
    if (length_sq(i) > length_sq(longest)) longest = i;
  }
  const Vec3 edge = x[(longest + 1) % 3] - x[longest];
  const double length = edge.norm();
  if (length == 0) return x[0].norm() <= radius ? TriangleShare{1.0, 1.0 / 3, 1.0 / 3, true} : TriangleShare{};
  const Vec3 e = edge / length;
  const Vec3 to_line = x[longest] - x[longest].dot(e) * e;
  const double w_sq = radius * radius - to_line.squaredNorm();
  if (w_sq < 0) return {};
  const double w = std::sqrt(w_sq);

  std::array<std::size_t, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a].dot(e) < x[b].dot(e); });
  const std::array<double, 3> t = {x[order[0]].dot(e), x[order[1]].dot(e), x[order[2]].dot(e)};
  const Part below = part_below(t, w), above = part_below(t, -w);
  const double share = std::clamp(below.share - above.share, 0.0, 1.0);
  if (share == 0) return {};
  std::array<double, 3> b;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    b[order[i]] = std::clamp((below.moment[row] - above.moment[row]) / share, 0.0, 1.0);
  }
  return {share, b[1], std::min(b[2], 1.0 - b[1]), true};
}

}  // namespace kappa::detail
