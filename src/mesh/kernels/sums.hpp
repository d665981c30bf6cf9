// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lanes.hpp"
#include "views.hpp"

// Adding whole measures and parts of them to what a ball has got. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Adds the sums that wait, in their order, in registers.
template <class Real>
inline void add_waiting(Gathering<Real>& ball, const double* sums) {
  VD a = load<VD>(ball.sum), b = load<VD>(ball.sum + 4);
  double c = ball.sum[8];
  for (int i = 0; i < ball.whole_count; ++i) {
    const double* const s = sums + std::size_t{kSums} * ball.whole[i];
    a += load<VD>(s);
    b += load<VD>(s + 4);
    c += s[8];
  }
  store(ball.sum, a);
  store(ball.sum + 4, b);
  ball.sum[8] = c;
  ball.whole_count = 0;
}

/// Lets one wait whose sum is in `sums`, as those of all that wait are.
template <class Real>
inline void add_whole(Gathering<Real>& ball, const double* sums, std::uint32_t which, std::uint64_t faces) {
  ball.whole[ball.whole_count++] = which;
  ball.faces += faces;
  if (ball.whole_count >= kWaiting) add_waiting(ball, sums);
}

/// Names in the lanes of a vector.
inline VF numbers_from(std::uint32_t first) {
  const auto i = static_cast<int>(first);
  return reinterpret_cast<VF>(MF{0, 1, 2, 3, 4, 5, 6, 7} + MF{i, i, i, i, i, i, i, i});
}

/// Lets those in the lanes of `mask` wait, as add_whole() does.
template <class Real>
inline unsigned let_whole_wait(Gathering<Real>& ball, const double* sums, VF which, unsigned mask) {
  store(ball.whole + ball.whole_count, Compression<VF>(mask)(which));
  const auto count = static_cast<unsigned>(__builtin_popcount(mask));
  ball.whole_count += static_cast<int>(count);
  if (ball.whole_count >= kWaiting) add_waiting(ball, sums);
  return count;
}

inline std::size_t triangle_of(std::uint64_t id) {
  return static_cast<std::uint32_t>(id);
}

/// Adds the measures of the triangles in all lanes, times their shares.
template <class Real, class Id>
inline void add_shares(const TriangleView& triangles, const Id* ids, const Real* share, Gathering<Real>& ball) {
  VD a = load<VD>(ball.sum), b = load<VD>(ball.sum + 4);
  double c = ball.sum[8];
  for (int lane = 0; lane < Lanes<Real>::kCount; ++lane) {
    const double* const s = triangles.measures + kSums * triangle_of(ids[lane]);
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

/// The normals of the second and third corner less that of the first.
template <class V>
struct NormalDifferences {
  Vector3<V> d1, d2;
};

inline NormalDifferences<VD> normal_differences(const TriangleView& triangles, const Waiting<double>& w, int first) {
  const double* at[3][4];
  for (int lane = 0; lane < 4; ++lane) {
    const std::uint64_t id = w.id[first + lane];
    const std::uint32_t* const corners = triangles.corners + 3 * triangle_of(id);
    const std::uint32_t turn = static_cast<std::uint32_t>(id >> 32), second = turn == 2 ? 0 : turn + 1;
    at[0][lane] = triangles.normals + 3 * std::size_t{corners[turn]};
    at[1][lane] = triangles.normals + 3 * std::size_t{corners[second]};
    at[2][lane] = triangles.normals + 3 * std::size_t{corners[3 - turn - second]};
  }
  const Vector3<VD> u0 = gathered_vectors(at[0]);
  return {gathered_vectors(at[1]) - u0, gathered_vectors(at[2]) - u0};
}

inline NormalDifferences<VF> normal_differences(const TriangleView&, const Waiting<float>& w, int first) {
  const auto row = [&](int i) { return load<VF>(w.x[i] + first); };
  return {{row(9), row(10), row(11)}, {row(12), row(13), row(14)}};
}

/// Adds what parts have over their share of the whole triangles. The density is linear: it is that of the difference
/// of the normal m1 d1 + m2 d2, times the share, from the mean normal. That of mu2 is constant.
template <class Real, class V>
inline void add_excess(const NormalDifferences<V>& d, const Vector3<V>& e1, const Vector3<V>& e2, V m1, V m2,
                       Gathering<Real>& ball) {
  const Vector3<V>&d1 = d.d1, &d2 = d.d2;
  const V half = spread(Real(0.5));
  const Vector3<V> excess = half * (m1 * d1 + m2 * d2);
  const Vector3<V> p = cross(e1, excess), q = cross(e2, excess);
  add_lanes(ball.excess[0], dot(excess, cross(e1, e2)));
  add_lanes(ball.excess[1], p.x * d2.x - q.x * d1.x);
  add_lanes(ball.excess[2], p.y * d2.y - q.y * d1.y);
  add_lanes(ball.excess[3], p.z * d2.z - q.z * d1.z);
  add_lanes(ball.excess[4], half * ((p.x * d2.y - q.x * d1.y) + (p.y * d2.x - q.y * d1.x)));
  add_lanes(ball.excess[5], half * ((p.x * d2.z - q.x * d1.z) + (p.z * d2.x - q.z * d1.x)));
  add_lanes(ball.excess[6], half * ((p.y * d2.z - q.y * d1.z) + (p.z * d2.y - q.z * d1.y)));
}

}  // namespace
}  // namespace kappa::kernels
