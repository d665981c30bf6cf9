// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "leaf.hpp"

// Leaves of a tree in doubles: whole steps tell which triangles the sphere cuts, and by how far they may err; the
// corners of those triangles come from the mesh. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Takes the corners of four triangles from the mesh.
inline void take_four(const Rim<double>& rim, const Named& named, int first, Waiting<double>& w) {
  for (int i = first; i < first + 4; ++i) w.id[i] = named.triangle[i] | std::uint64_t{named.turn[i]} << 32;
  const FourCorners corners(rim.triangles, w.id + first);
  const double* const c = rim.query.centre;
  const Vector3<VD> centre = {spread(c[0]), spread(c[1]), spread(c[2])};
  for (int corner = 0; corner < 3; ++corner) {
    const Vector3<VD> x = corners.of(rim.triangles.positions, corner) - centre;
    store(w.x[3 * corner] + first, x.x);
    store(w.x[3 * corner + 1] + first, x.y);
    store(w.x[3 * corner + 2] + first, x.z);
    if (corner == 0) store(w.power + first, dot(x, x) - spread(rim.query.radii_sq[rim.radius]));
  }
}

inline void take(const Rim<double>& rim, Named& named, Waiting<double>& w) {
  for (int first = 0; first < named.count; first += 4) take_four(rim, named, first, w);
  w.count = named.count;
  named.count = 0;
}

inline void take_corners(const Rim<double>& rim) {
  take(rim, rim.ball.named.corners, rim.ball.corners);
  make_corners_wait(rim);
}
inline void take_outside(const Rim<double>& rim) {
  take(rim, rim.ball.named.outside, rim.ball.outside);
  make_outside_wait(rim);
}

inline void finish_named(const Rim<double>& rim) {
  take_corners(rim);
  take_outside(rim);
}
inline void finish_named(const Rim<float>&) {}

inline void name(Named& named, VF triangles, MF turns, unsigned mask) {
  const Compression<VF> packed(mask);
  store(named.triangle + named.count, packed(triangles));
  store(named.turn + named.count, packed(reinterpret_cast<VF>(turns)));
  named.count += __builtin_popcount(mask);
}

/// Hands triangles on, of which the steps leave open what the sphere does to them.
inline void add_unclear(const Rim<double>& rim, VF triangles, unsigned mask) {
  std::uint32_t ids[kWidth];
  store(ids, triangles);
  Waiting<double>& w = rim.ball.irregular;
  for (; mask != 0; mask &= mask - 1) {
    const std::uint32_t triangle = ids[__builtin_ctz(mask)];
    if (rim.query.all_careful) {
      rim.query.careful(rim.query.context, triangle, rim.radius);
      continue;
    }
    if (w.count == kRim) make_irregular_wait(rim);
    const std::uint32_t* const corners = rim.triangles.corners + 3 * std::size_t{triangle};
    for (int row = 0; row < 9; ++row) {
      const double* const x = rim.triangles.positions + 3 * std::size_t{corners[row / 3]};
      w.x[row][w.count] = x[row % 3] - rim.query.centre[row % 3];
    }
    w.id[w.count++] = triangle;
  }
}

/// What the squared distance of a corner may be off by where it is about that of the radius, in steps: a corner is off
/// by half a step along each axis, and floats by 4e-7 |a| (2 |o| + |a|) with |a| below 57,000.
inline double doubt(double radius) {
  return 2.2 * radius + 1.2e4;
}

/// Adds the triangles of a leaf, in the lanes of `present`, to one ball.
inline void add_to_ball(const Rim<double>& rim, const Leaf<double>& leaf, const Placed& p, VF triangles, MF present) {
  constexpr double kOut = 1 + 4e-6;  // for the roundings of floats
  const double radius = rim.ball.reach * unit_of(leaf), radius_sq = radius * radius, off = doubt(radius);
  const double bound = radius_sq - p.base;
  const VF low = spread(static_cast<float>(bound - off)), high = spread(static_cast<float>(bound + off));
  const auto &d0 = p.distance_sq[0], &d1 = p.distance_sq[1], &d2 = p.distance_sq[2];
  const MF in0 = d0 <= low, in1 = d1 <= low, in2 = d2 <= low, some = (d0 <= high) | (d1 <= high) | (d2 <= high);
  const MF unclear = (in0 ^ (d0 <= high)) | (in1 ^ (d1 <= high)) | (in2 ^ (d2 <= high));
  const MF all = in0 & in1 & in2, cut = some & ~all & ~unclear & present;
  let_triangles_wait(rim, triangles, bits(all & present));
  if (const unsigned open = bits(unclear & present)) add_unclear(rim, triangles, open);
  const MF one = MF{1, 1, 1, 1, 1, 1, 1, 1};
  const Turn<MF> turn(in0, in1, in2);
  Named &corners = rim.ball.named.corners, &outside = rim.ball.named.outside;
  name(corners, triangles, (turn.second & one) | (turn.third & (one + one)), bits(cut));
  if (corners.count > kRim) take_corners(rim);
  const unsigned reaching = may_reach(leaf, p, (radius_sq + off) * kOut, ~some & present);
  if (!reaching) return;
  name(outside, triangles, one ^ one, reaching);
  if (outside.count > kRim) take_outside(rim);
}

}  // namespace
}  // namespace kappa::kernels
