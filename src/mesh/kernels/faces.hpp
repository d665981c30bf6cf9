// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sums.hpp"

// Measures of whole triangles, four at a time. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Measures in lanes, in the order of a MeasureSum.
struct MeasureLanes {
  VD row[kSums];
};

/// The form of triangle_density_sum() with the mean normal.
inline MeasureLanes measures_of(const Corners<VD>& x, const Corners<VD>& u) {
  const VD half = spread(0.5), third = spread(3.0);
  const Vector3<VD> e1 = x.x1 - x.x0, e2 = x.x2 - x.x0, d1 = u.x1 - u.x0, d2 = u.x2 - u.x0;
  const Vector3<VD> sum = u.x0 + u.x1 + u.x2, mean = {sum.x / third, sum.y / third, sum.z / third};
  const Vector3<VD> normal = cross(e1, e2), p = half * cross(e1, mean), q = half * cross(e2, mean);
  return {{half * sqrt(dot(normal, normal)), half * dot(mean, normal), half * dot(mean, cross(d1, d2)),
           p.x * d2.x - q.x * d1.x, p.y * d2.y - q.y * d1.y, p.z * d2.z - q.z * d1.z,
           half * ((p.x * d2.y - q.x * d1.y) + (p.y * d2.x - q.y * d1.x)),
           half * ((p.x * d2.z - q.x * d1.z) + (p.z * d2.x - q.z * d1.x)),
           half * ((p.y * d2.z - q.y * d1.z) + (p.z * d2.y - q.z * d1.y))}};
}

inline Corners<VD> gathered(const double* vectors, const std::uint32_t* const (&corners)[4]) {
  const auto at = [&](int corner) {
    const double* const from[4] = {
        vectors + 3 * std::size_t{corners[0][corner]}, vectors + 3 * std::size_t{corners[1][corner]},
        vectors + 3 * std::size_t{corners[2][corner]}, vectors + 3 * std::size_t{corners[3][corner]}};
    return gathered_vectors(from);
  };
  return {at(0), at(1), at(2)};
}

/// Measures of the triangles [begin, end), times their weights, to `out`, kSums each.
inline void measure(const TriangleView& t, std::size_t begin, std::size_t end, double* out) {
  for (std::size_t i = begin; i < end; i += 4) {
    const std::size_t lanes = end - i < 4 ? end - i : 4;
    const std::uint32_t* corners[4];
    for (std::size_t lane = 0; lane < 4; ++lane) corners[lane] = t.corners + 3 * (i + (lane < lanes ? lane : 0));
    MeasureLanes m = measures_of(gathered(t.positions, corners), gathered(t.normals, corners));
    if (t.weights) {
      VD weight = spread(1.0);
      for (std::size_t lane = 0; lane < lanes; ++lane) weight[lane] = t.weights[i + lane];
      for (VD& row : m.row) row *= weight;
    }
    VD first[4], second[4];
    transpose({m.row[0], m.row[1], m.row[2], m.row[3]}, first);
    transpose({m.row[4], m.row[5], m.row[6], m.row[7]}, second);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      double* const to = out + kSums * (i + lane);
      store(to, first[lane]);
      store(to + 4, second[lane]);
      to[8] = m.row[8][lane];
    }
  }
}

}  // namespace
}  // namespace kappa::kernels
