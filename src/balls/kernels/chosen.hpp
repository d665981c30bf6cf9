// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rim.hpp"

// Triangles that a search has chosen, without a tree. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Lower bounds over four triangles of the squared distance from the centre: those of their boxes.
inline VD least_distances(const Vector3<VD>& a, const Vector3<VD>& b, const Vector3<VD>& c) {
  const auto gap_sq = [](VD p, VD q, VD r) {
    const VD gap = max(max(min(p, min(q, r)), -max(p, max(q, r))), spread(0.0));
    return gap * gap;
  };
  return gap_sq(a.x, b.x, c.x) + gap_sq(a.y, b.y, c.y) + gap_sq(a.z, b.z, c.z);
}

/// Adds four triangles. What is nearer than kOut over the radius squared may touch the ball; the shares decide.
template <bool kMoments>
inline void add_four(const Rim<double>& rim, const std::uint32_t* names, unsigned valid) {
  constexpr double kOut = 1 + 1e-12;
  const Corners<VD> x = OfMesh<VD>(rim.triangles, names).corners(rim.query.centre);
  const VD farthest = max(dot(x.x0, x.x0), max(dot(x.x1, x.x1), dot(x.x2, x.x2)));
  const unsigned inside = bits(farthest <= spread(rim.ball.radius_sq)) & valid;
  for (unsigned rest = inside; rest != 0; rest &= rest - 1)
    add_whole(rim.ball, rim.triangles.measures, names[__builtin_ctz(rest)], 1);
  const VD least = least_distances(x.x0, x.x1, x.x2);
  Waiting<double>& w = rim.ball.waiting;
  for (unsigned rest = bits(least <= spread(rim.ball.radius_sq * kOut)) & valid & ~inside; rest != 0; rest &= rest - 1)
    w.triangle[w.count++] = names[__builtin_ctz(rest)];
  make_room<kMoments>(rim);
}

template <bool kMoments>
void add_chosen(const Rim<double>& rim, const std::uint32_t* chosen, std::size_t count) {
  std::size_t at = 0;
  for (; at + 4 <= count; at += 4) add_four<kMoments>(rim, chosen + at, 15);
  if (at == count) return;
  std::uint32_t last[4];
  for (std::size_t lane = 0; lane < 4; ++lane) last[lane] = chosen[at + lane < count ? at + lane : at];
  add_four<kMoments>(rim, last, (1U << (count - at)) - 1);
}

inline void add_chosen(const TriangleView& triangles, const BallQuery<double>& query, int radius,
                       const std::uint32_t* chosen, std::size_t count) {
  const Rim<double> rim = {triangles, query, radius, query.balls[radius]};
  if (query.exact_density) {
    add_chosen<true>(rim, chosen, count);
  } else {
    add_chosen<false>(rim, chosen, count);
  }
}

inline void finish_chosen(const TriangleView& triangles, const BallQuery<double>& query, int radius) {
  const Rim<double> rim = {triangles, query, radius, query.balls[radius]};
  if (query.exact_density) {
    add_all_waiting<true>(rim);
  } else {
    add_all_waiting<false>(rim);
  }
  add_waiting(rim.ball, triangles.measures);
}

}  // namespace
}  // namespace kappa::kernels
