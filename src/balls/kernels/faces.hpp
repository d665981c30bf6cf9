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

/// The form of triangle_density_sum() with the mean normal, halved once for all.
inline MeasureLanes measures_of(const Corners<VD>& x, const Corners<VD>& u) {
  const VD half = spread(0.5), sixth = spread(1.0 / 6.0);
  const Vector3<VD> e1 = x.x1 - x.x0, e2 = x.x2 - x.x0, d1 = u.x1 - u.x0, d2 = u.x2 - u.x0;
  const Vector3<VD> mean = sixth * (u.x0 + u.x1 + u.x2);
  const Vector3<VD> normal = cross(e1, e2), p = cross(e1, mean), q = cross(e2, mean);
  return {{half * sqrt(dot(normal, normal)), dot(mean, normal), dot(mean, cross(d1, d2)), p.x * d2.x - q.x * d1.x,
           p.y * d2.y - q.y * d1.y, p.z * d2.z - q.z * d1.z,
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

/// Measures of four triangles, times their weights if there are any.
inline MeasureLanes measures_of(const TriangleView& t, const std::uint32_t* const (&corners)[4],
                                const double* weights) {
  MeasureLanes m = measures_of(gathered(t.positions, corners), gathered(t.normals, corners));
  if (weights) {
    const VD weight = load<VD>(weights);
    for (VD& row : m.row) row *= weight;
  }
  return m;
}

/// Writes the measures of four triangles, kSums each.
inline void put(const MeasureLanes& m, double* out) {
  VD first[4], second[4];
  transpose({m.row[0], m.row[1], m.row[2], m.row[3]}, first);
  transpose({m.row[4], m.row[5], m.row[6], m.row[7]}, second);
  // Not a loop: where the compiler leaves it one, the lanes go through memory, and it takes a quarter longer.
  const auto put_lane = [&](int lane, double last) {
    double* const to = out + kSums * lane;
    store(to, first[lane]);
    store(to + 4, second[lane]);
    to[8] = last;
  };
  put_lane(0, m.row[8][0]);
  put_lane(1, m.row[8][1]);
  put_lane(2, m.row[8][2]);
  put_lane(3, m.row[8][3]);
}

/// The same of the one to three triangles from `begin` on.
inline void measure_last(const TriangleView& t, std::size_t begin, std::size_t count, double* out) {
  const std::uint32_t* corners[4];
  double weights[4] = {}, sums[4 * kSums];
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const std::size_t i = begin + (lane < count ? lane : 0);
    corners[lane] = t.corners + 3 * i;
    if (t.weights) weights[lane] = t.weights[i];
  }
  put(measures_of(t, corners, t.weights ? weights : nullptr), sums);
  __builtin_memcpy(out, sums, count * kSums * sizeof(double));
}

/// Measures of the triangles [begin, end), times their weights, to `out`, kSums each.
inline void measure(const TriangleView& t, std::size_t begin, std::size_t end, double* out) {
  std::size_t i = begin;
  for (; end - i >= 4; i += 4) {
    const std::uint32_t* const c = t.corners + 3 * i;
    put(measures_of(t, {c, c + 3, c + 6, c + 9}, t.weights ? t.weights + i : nullptr), out + kSums * i);
  }
  if (i < end) measure_last(t, i, end - i, out + kSums * i);
}

}  // namespace
}  // namespace kappa::kernels
