// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/ball_sum.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "kappa/core/error.hpp"
#include "kappa/core/triangle_ball.hpp"
#include "parallel_bounds.hpp"

namespace kappa {
namespace {

/// What the part of triangle `t` with this share and centroid has over its share of the whole: the density is
/// linear, so it is that of the normal's difference from the mean normal.
MeasureSum density_excess(const MeasuredTriangles& triangles, std::size_t t, const TriangleShare& part) {
  const auto& c = triangles.corners[t];
  const Vec3 &x0 = triangles.x[c[0]], &u0 = triangles.u[c[0]];
  const Vec3 d1 = triangles.u[c[1]] - u0, d2 = triangles.u[c[2]] - u0;
  const Vec3 difference = (part.b1 - 1.0 / 3) * d1 + (part.b2 - 1.0 / 3) * d2;
  MeasureSum m = triangle_density_sum(triangles.x[c[1]] - x0, triangles.x[c[2]] - x0, d1, d2, difference);
  m.area = 0;
  m *= triangles.weight(t);
  return m;
}

/// Spreads the low 21 bits of v to every third bit.
std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffff;
  v = (v | v << 16) & 0x1f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  return (v | v << 2) & 0x1249249249249249;
}

std::uint64_t morton_code(const Vec3& p, const Bounds& b, double extent) {
  constexpr double kCells = 2097151;  // 2^21 - 1
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = (p[axis] - b.min[axis]) / extent * kCells;
    code |= spread_bits(static_cast<std::uint64_t>(cell)) << axis;
  }
  return code;
}

struct Keyed {
  std::uint64_t key;
  Index index;
};

/// Sorts by key and leaves the order of equal keys: digit by digit, the last first, but for digits that are the same in
/// all keys.
void sort_by_key(std::vector<Keyed>& keyed) {
  constexpr int kBits = 11, kPasses = 6;  // of 64 bits
  constexpr std::size_t kDigits = std::size_t{1} << kBits;
  const auto less = [](const Keyed& a, const Keyed& b) { return a.key < b.key; };
  if (std::is_sorted(keyed.begin(), keyed.end(), less)) return;
  if (keyed.size() < kDigits) {
    std::stable_sort(keyed.begin(), keyed.end(), less);
    return;
  }
  const auto digit = [](const Keyed& entry, int pass) { return entry.key >> kBits * pass & (kDigits - 1); };
  std::vector<std::array<Index, kDigits>> places(kPasses);  // of each digit, how many there are; then where they start
  for (const Keyed& entry : keyed) {
    for (int pass = 0; pass < kPasses; ++pass) ++places[static_cast<std::size_t>(pass)][digit(entry, pass)];
  }
  std::vector<Keyed> sorted(keyed.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    auto& first = places[static_cast<std::size_t>(pass)];
    if (first[digit(keyed[0], pass)] == keyed.size()) continue;
    Index before = 0;
    for (Index& place : first) before += std::exchange(place, before);
    for (const Keyed& entry : keyed) sorted[first[digit(entry, pass)]++] = entry;
    keyed.swap(sorted);
  }
}

}  // namespace

MeasureSum measures_of(const MeasuredTriangles& triangles, std::size_t t) {
  if (!triangles.measures.empty()) return triangles.measures[t];
  const auto& c = triangles.corners[t];
  const Vec3 &x0 = triangles.x[c[0]], &u0 = triangles.u[c[0]], &u1 = triangles.u[c[1]], &u2 = triangles.u[c[2]];
  MeasureSum m =
      triangle_density_sum(triangles.x[c[1]] - x0, triangles.x[c[2]] - x0, u1 - u0, u2 - u0, (u0 + u1 + u2) / 3.0);
  m *= triangles.weight(t);
  if (!triangles.beside.empty()) m += triangles.beside[t];
  return m;
}

std::vector<Index> parts_of_faces(const MeasuredTriangles& triangles) {
  const auto last = std::max_element(triangles.faces.begin(), triangles.faces.end());
  std::vector<Index> parts(last == triangles.faces.end() ? 0 : *last + std::size_t{1});
  for (const Index face : triangles.faces) ++parts[face];
  return parts;
}

bool add_triangle_in_ball(const MeasuredTriangles& triangles, std::size_t t, const Vec3& centre, double radius,
                          BallDefinition ball, BallMeasures& to) {
  const auto& c = triangles.corners[t];
  const std::array<Vec3, 3> x = {triangles.x[c[0]] - centre, triangles.x[c[1]] - centre, triangles.x[c[2]] - centre};
  const TriangleShare part = triangle_ball_share(x, radius);
  if (!part.met) return false;
  ++to.face_count;
  MeasureSum m = measures_of(triangles, t);
  if (ball == BallDefinition::ExactDensity && part.share > 0 && part.share < 1) m += density_excess(triangles, t, part);
  m *= part.share;
  to.sum += m;
  return true;
}

void BallSum::sum(const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
                  const Execution& run, const Sink& sink) const {
  for (const double radius : radii) {
    if (!(radius > 0 && std::isfinite(radius)))
      throw Error(ErrorCode::InvalidArgument,
                  "radius = " + std::to_string(radius) + ": a ball needs a positive, finite radius");
  }
  do_sum(centres, radii, ball, run, sink);
}

void BruteForceBallSum::do_sum(const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
                               const Execution& run, const Sink& sink) const {
  parallel_for(centres.size(), 16, run, [&](std::size_t begin, std::size_t end, int) {
    std::vector<BallMeasures> sums;
    for (std::size_t q = begin; q < end; ++q) {
      sums.assign(radii.size(), {});
      for (std::size_t r = 0; r < radii.size() && is_finite(centres[q]); ++r) {
        for (std::size_t t = 0; t < triangles_.size(); ++t)
          add_triangle_in_ball(triangles_, t, centres[q], radii[r], ball, sums[r]);
      }
      sink(q, sums.data());
    }
  });
}

std::vector<Index> spatial_order(const std::vector<Vec3>& points, const Execution& run) {
  constexpr std::size_t kBlock = 16384;
  const Bounds b = parallel_bounds(points.size(), run, [&](std::size_t i, Bounds& part) {
    if (!is_finite(points[i])) return;
    part.min = part.min.cwiseMin(points[i]);
    part.max = part.max.cwiseMax(points[i]);
  });
  const double extent = std::max((b.max - b.min).maxCoeff(), std::numeric_limits<double>::min());
  std::vector<Keyed> keyed(points.size());
  parallel_for(points.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const bool finite = is_finite(points[i]);
      keyed[i] = {finite ? morton_code(points[i], b, extent) : ~std::uint64_t{0}, static_cast<Index>(i)};
    }
  });
  sort_by_key(keyed);
  std::vector<Index> order(points.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(), [](const Keyed& entry) { return entry.index; });
  return order;
}

}  // namespace kappa
