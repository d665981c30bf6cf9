// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disc_share.hpp"
#include "tree_view.hpp"

// What a ball gets from triangles on its rim and from sums that are waiting. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Adds the sums that wait, in their order, in registers.
inline void add_waiting(BallAccumulator& ball) {
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

inline void add_whole(BallAccumulator& ball, const double* sums, std::uint64_t faces) {
  prefetch(sums);
  ball.whole[ball.whole_count++] = sums;
  ball.faces += faces;
  if (ball.whole_count == kBuffer) add_waiting(ball);
}

inline void add_scaled(BallAccumulator& ball, const double* sums, double factor) {
  const VD f = spread(factor);
  store(ball.sum, load<VD>(ball.sum) + f * load<VD>(sums));
  store(ball.sum + 4, load<VD>(ball.sum + 4) + f * load<VD>(sums + 4));
  ball.sum[8] += factor * sums[8];
}

inline void add_lanes(double* to, VD lanes) {
  store(to, load<VD>(to) + lanes);
}
inline void add_lanes(double* to, VF lanes) {
  for (int i = 0; i < 8; ++i) to[i] += static_cast<double>(lanes[i]);
}

/// Normals of the corners of the triangles in the lanes: 9 rows.
template <class Real, class V>
inline void gather_normals(const TreeView<Real>& tree, const std::uint32_t* triangles, V (&rows)[9]) {
  Real u[9][Lanes<Real>::kCount];
  for (int lane = 0; lane < Lanes<Real>::kCount; ++lane) {
    const std::uint32_t* const corners = tree.corners + 3 * std::size_t{triangles[lane]};
    for (int corner = 0; corner < 3; ++corner) {
      const double* const from = tree.normals + 3 * std::size_t{corners[corner]};
      for (int axis = 0; axis < 3; ++axis) u[3 * corner + axis][lane] = static_cast<Real>(from[axis]);
    }
  }
  for (int i = 0; i < 9; ++i) rows[i] = load<V>(u[i]);
}

/// What a triangle on the rim will be measured with is on its way while others are found.
template <class Real>
inline void prefetch_triangle(const TreeView<Real>& tree, std::uint32_t triangle) {
  prefetch(tree.measures + kSums * std::size_t{triangle});
  __builtin_prefetch(tree.corners + 3 * std::size_t{triangle});
}

template <class Real>
inline void prefetch_normals(const TreeView<Real>& tree, const BallAccumulator& ball) {
  for (int i = 0; i < ball.rim_count; ++i) {
    const std::uint32_t* const corners = tree.corners + 3 * std::size_t{ball.rim_triangle[i]};
    for (int corner = 0; corner < 3; ++corner) __builtin_prefetch(tree.normals + 3 * std::size_t{corners[corner]});
  }
}

/// Adds what the parts have over their share of the whole triangles: the density is linear, so it is that of the
/// normal's difference between the centroids of part and triangle, times `factor`.
template <class Real, class V, class M>
inline void add_excess(const TreeView<Real>& tree, const Corners<V>& t, const Shares<V, M>& part, V factor,
                       const std::uint32_t* triangles, BallAccumulator& ball) {
  V u[9];
  gather_normals(tree, triangles, u);
  const Vector3<V> u0 = {u[0], u[1], u[2]};
  const Vector3<V> d1 = Vector3<V>{u[3], u[4], u[5]} - u0, d2 = Vector3<V>{u[6], u[7], u[8]} - u0;
  const V third = spread(Real(1.0 / 3)), half = spread(Real(0.5));
  const Vector3<V> excess = (factor * (part.b1 - third)) * d1 + (factor * (part.b2 - third)) * d2;
  const Vector3<V> e1 = t.x1 - t.x0, e2 = t.x2 - t.x0;
  const Vector3<V> p = half * cross(e1, excess), q = half * cross(e2, excess);
  add_lanes(ball.excess[0], half * dot(excess, cross(e1, e2)));
  add_lanes(ball.excess[1], half * dot(excess, cross(d1, d2)));
  add_lanes(ball.excess[2], p.x * d2.x - q.x * d1.x);
  add_lanes(ball.excess[3], p.y * d2.y - q.y * d1.y);
  add_lanes(ball.excess[4], p.z * d2.z - q.z * d1.z);
  add_lanes(ball.excess[5], half * ((p.x * d2.y - q.x * d1.y) + (p.y * d2.x - q.y * d1.x)));
  add_lanes(ball.excess[6], half * ((p.x * d2.z - q.x * d1.z) + (p.z * d2.x - q.z * d1.x)));
  add_lanes(ball.excess[7], half * ((p.y * d2.z - q.y * d1.z) + (p.z * d2.y - q.z * d1.y)));
}

template <class Real>
inline Corners<typename Lanes<Real>::V> rim_corners(const BallAccumulator& ball, int first) {
  using V = typename Lanes<Real>::V;
  V x[9];
  for (int i = 0; i < 9; ++i) {
    Real row[Lanes<Real>::kCount];
    for (int lane = 0; lane < Lanes<Real>::kCount; ++lane) row[lane] = static_cast<Real>(ball.rim[i][first + lane]);
    x[i] = load<V>(row);
  }
  return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}};
}

/// Lanes that hold nothing get the last triangle once more; what they yield is not used.
inline void fill_lanes(BallAccumulator& ball, int lanes) {
  const int last = ball.rim_count - 1;
  for (int place = ball.rim_count; place % lanes != 0; ++place) {
    for (int i = 0; i < 9; ++i) ball.rim[i][place] = ball.rim[i][last];
    ball.rim_triangle[place] = ball.rim_triangle[last];
  }
}

/// Measures the `count` triangles from place `first` on of those that wait on the rim of ball number `radius`.
template <class Real>
inline void add_rim_part(const TreeView<Real>& tree, const BallQuery& query, int radius, int first, int count) {
  using V = typename Lanes<Real>::V;
  using M = typename Lanes<Real>::M;
  BallAccumulator& ball = query.balls[radius];
  const std::uint32_t* const triangles = ball.rim_triangle + first;
  const Corners<V> corners = rim_corners<Real>(ball, first);
  const Shares<V, M> part = disc_shares<Real, V, M>(corners, static_cast<Real>(query.radii[radius]));
  const unsigned certain = bits(part.certain), missed = bits(part.missed);
  Real share[Lanes<Real>::kCount], factor[Lanes<Real>::kCount] = {};
  store(share, part.share);
  for (int lane = 0; lane < count; ++lane) {
    if (certain >> lane & 1) {
      add_scaled(ball, tree.measures + kSums * std::size_t{triangles[lane]}, static_cast<double>(share[lane]));
      factor[lane] = share[lane] * static_cast<Real>(tree.weights[triangles[lane]]);
      ++ball.faces;
    } else if (!(missed >> lane & 1)) {
      query.careful(query.context, triangles[lane], radius);
    }
  }
  if (!query.exact_density || !certain) return;
  // A lane that is not certain may hold NaN, which 0 does not cancel.
  const V zero = spread(Real(0));
  const Shares<V, M> safe = {part.share, select(part.certain, part.b1, zero), select(part.certain, part.b2, zero),
                             part.certain, part.missed};
  add_excess(tree, corners, safe, load<V>(factor), triangles, ball);
}

/// Measures the triangles that wait on the rim of ball number `radius`.
template <class Real>
void add_rim(const TreeView<Real>& tree, const BallQuery& query, int radius) {
  constexpr int kLanes = Lanes<Real>::kCount;
  BallAccumulator& ball = query.balls[radius];
  if (query.exact_density) prefetch_normals(tree, ball);
  fill_lanes(ball, kLanes);
  for (int first = 0; first < ball.rim_count; first += kLanes) {
    const int left = ball.rim_count - first;
    add_rim_part(tree, query, radius, first, left < kLanes ? left : kLanes);
  }
  ball.rim_count = 0;
}

}  // namespace
}  // namespace kappa::kernels
