// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lanes.hpp"
#include "views.hpp"

// Adding whole measures and parts of them to what a ball has got. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Adds the sums that wait, in their order, in registers.
template <class Real>
inline void add_waiting(Gathering<Real>& ball) {
  VD a = load<VD>(ball.sum), b = load<VD>(ball.sum + 4);
  double c = ball.sum[8];
  for (int i = 0; i < ball.whole_count; ++i) {
    const double* const s = ball.whole[i];
    a += load<VD>(s);
    b += load<VD>(s + 4);
    c += s[8];
  }
  store(ball.sum, a);
  store(ball.sum + 4, b);
  ball.sum[8] = c;
  ball.whole_count = 0;
}

inline void prefetch(const double* sums) {
  __builtin_prefetch(sums);
  __builtin_prefetch(sums + kSums - 1);
}

template <class Real>
inline void add_whole(Gathering<Real>& ball, const double* sums, std::uint64_t faces) {
  prefetch(sums);
  ball.whole[ball.whole_count++] = sums;
  ball.faces += faces;
  if (ball.whole_count == kWaiting) add_waiting(ball);
}

/// Adds the measures of the triangles in the lanes of `mask`, times their shares.
template <class Real>
inline void add_shares(const TriangleView& triangles, const std::uint32_t* chosen, const Real* share, unsigned mask,
                       Gathering<Real>& ball) {
  VD a = load<VD>(ball.sum), b = load<VD>(ball.sum + 4);
  double c = ball.sum[8];
  for (; mask != 0; mask &= mask - 1) {
    const int lane = __builtin_ctz(mask);
    const double* const s = triangles.measures + kSums * std::size_t{chosen[lane]};
    const auto factor = static_cast<double>(share[lane]);
    a += spread(factor) * load<VD>(s);
    b += spread(factor) * load<VD>(s + 4);
    c += factor * s[8];
  }
  store(ball.sum, a);
  store(ball.sum + 4, b);
  ball.sum[8] = c;
}

inline void add_lanes(double* to, VD lanes) {
  store(to, load<VD>(to) + lanes);
}
inline void add_lanes(double* to, VF lanes) {
  store(to, load<VD>(to) + low_half(lanes));
  store(to + 4, load<VD>(to + 4) + high_half(lanes));
}

/// Coordinate `axis` of the normals at corner `corner` (0, 1, 2 from the first on) of the triangles in the lanes.
struct NormalRows {
  const double* at[3][8];  ///< corner, lane
};

template <class V>
inline Vector3<V> normals_at(const NormalRows& rows, int corner);
template <>
inline Vector3<VD> normals_at<VD>(const NormalRows& rows, int corner) {
  const double* const* const p = rows.at[corner];
  return {VD{p[0][0], p[1][0], p[2][0], p[3][0]}, VD{p[0][1], p[1][1], p[2][1], p[3][1]},
          VD{p[0][2], p[1][2], p[2][2], p[3][2]}};
}
template <>
inline Vector3<VF> normals_at<VF>(const NormalRows& rows, int corner) {
  const double* const* const p = rows.at[corner];
  const auto row = [p](int axis) {
    return narrowed(VD{p[0][axis], p[1][axis], p[2][axis], p[3][axis]},
                    VD{p[4][axis], p[5][axis], p[6][axis], p[7][axis]});
  };
  return {row(0), row(1), row(2)};
}

/// Where the normals of the triangles are, corners in the order in which they wait.
template <class Real>
inline NormalRows normal_rows(const TriangleView& triangles, const std::uint32_t* chosen, const std::uint32_t* turn) {
  NormalRows rows;
  for (int lane = 0; lane < Lanes<Real>::kCount; ++lane) {
    const std::uint32_t* const corners = triangles.corners + 3 * std::size_t{chosen[lane]};
    const std::uint32_t first = turn[lane], second = first == 2 ? 0 : first + 1, third = 3 - first - second;
    rows.at[0][lane] = triangles.normals + 3 * std::size_t{corners[first]};
    rows.at[1][lane] = triangles.normals + 3 * std::size_t{corners[second]};
    rows.at[2][lane] = triangles.normals + 3 * std::size_t{corners[third]};
  }
  return rows;
}

/// Adds what parts have over their share of the whole triangles. The density is linear: it is that of the difference
/// of the normal m1 d1 + m2 d2, times the share, from the mean normal.
template <class Real, class V>
inline void add_excess(const NormalRows& rows, const Vector3<V>& e1, const Vector3<V>& e2, V m1, V m2,
                       Gathering<Real>& ball) {
  const Vector3<V> u0 = normals_at<V>(rows, 0);
  const Vector3<V> d1 = normals_at<V>(rows, 1) - u0, d2 = normals_at<V>(rows, 2) - u0;
  const V half = spread(Real(0.5));
  const Vector3<V> excess = half * (m1 * d1 + m2 * d2);
  const Vector3<V> p = cross(e1, excess), q = cross(e2, excess);
  add_lanes(ball.excess[0], dot(excess, cross(e1, e2)));
  add_lanes(ball.excess[1], dot(excess, cross(d1, d2)));
  add_lanes(ball.excess[2], p.x * d2.x - q.x * d1.x);
  add_lanes(ball.excess[3], p.y * d2.y - q.y * d1.y);
  add_lanes(ball.excess[4], p.z * d2.z - q.z * d1.z);
  add_lanes(ball.excess[5], half * ((p.x * d2.y - q.x * d1.y) + (p.y * d2.x - q.y * d1.x)));
  add_lanes(ball.excess[6], half * ((p.x * d2.z - q.x * d1.z) + (p.z * d2.x - q.z * d1.x)));
  add_lanes(ball.excess[7], half * ((p.y * d2.z - q.y * d1.z) + (p.z * d2.y - q.z * d1.y)));
}

}  // namespace
}  // namespace kappa::kernels
