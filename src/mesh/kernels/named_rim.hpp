// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "leaf.hpp"

// Leaves of a tree in doubles: whole steps tell which triangles the sphere cuts, and by how far they may err; the
// corners of those triangles come from the mesh. Included by kernel files alone.

namespace kappa::kernels {
namespace {

constexpr int kNext[3] = {1, 2, 0};

/// Corners of a triangle relative to the centre, by their place in the mesh, the one called `turn` first.
struct MeshCorners {
  const double* at[3];
  MeshCorners(const TriangleView& t, std::uint32_t triangle, std::uint32_t turn) {
    const std::uint32_t* const corners = t.corners + 3 * std::size_t{triangle};
    const int second = kNext[turn];
    at[0] = t.positions + 3 * std::size_t{corners[turn]};
    at[1] = t.positions + 3 * std::size_t{corners[second]};
    at[2] = t.positions + 3 * std::size_t{corners[kNext[second]]};
  }
};

/// Takes the corners of four triangles from the mesh.
inline void take_four(const Rim<double>& rim, const Named& named, int first, Waiting<double>& w) {
  const double* at[3][4];
  for (int lane = 0; lane < 4; ++lane) {
    const std::uint32_t triangle = named.triangle[first + lane], turn = named.turn[first + lane];
    const MeshCorners corners(rim.triangles, triangle, turn);
    for (int corner = 0; corner < 3; ++corner) at[corner][lane] = corners.at[corner];
    w.id[first + lane] = triangle | std::uint64_t{turn} << 32;
  }
  const double* const c = rim.query.centre;
  const Vector3<VD> centre = {spread(c[0]), spread(c[1]), spread(c[2])};
  for (int corner = 0; corner < 3; ++corner) {
    const Vector3<VD> x = gathered_vectors(at[corner]) - centre;
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
    const MeshCorners corners(rim.triangles, triangle, 0);
    for (int row = 0; row < 9; ++row) w.x[row][w.count] = corners.at[row / 3][row % 3] - rim.query.centre[row % 3];
    w.id[w.count++] = triangle;
  }
}

/// What the squared distance of a corner may be off by where it is about that of the radius, in steps: a corner is off
/// by half a step along each axis, and floats by 4e-7 |a| (2 |o| + |a|) with |a| below 57,000.
inline double doubt(double radius) {
  return 2.2 * radius + 1.2e4;
}

/// Adds the triangles of a leaf, in the lanes of `present`, to one ball.
inline void add_to_ball(const Rim<double>& rim, const Leaf<double>& leaf, const Placed<float>& p, VF triangles,
                        MF present) {
  const double radius = rim.ball.reach * leaf.steps_a_unit, radius_sq = radius * radius, off = doubt(radius);
  const double bound = radius_sq - p.base;
  const VF low = spread(static_cast<float>(bound - off)), high = spread(static_cast<float>(bound + off));
  const auto &d0 = p.distance_sq[0], &d1 = p.distance_sq[1], &d2 = p.distance_sq[2];
  const MF in0 = d0 <= low, in1 = d1 <= low, in2 = d2 <= low, some = (d0 <= high) | (d1 <= high) | (d2 <= high);
  const MF unclear = (in0 ^ (d0 <= high)) | (in1 ^ (d1 <= high)) | (in2 ^ (d2 <= high));
  const MF all = in0 & in1 & in2, cut = some & ~all & ~unclear & present;
  let_all_wait(rim, triangles, bits(all & present));
  if (const unsigned open = bits(unclear & present)) add_unclear(rim, triangles, open);
  const MF one = MF{1, 1, 1, 1, 1, 1, 1, 1};
  const Turn<MF> turn(in0, in1, in2);
  Named &corners = rim.ball.named.corners, &outside = rim.ball.named.outside;
  name(corners, triangles, (turn.second & one) | (turn.third & (one + one)), bits(cut));
  if (corners.count > kRim) take_corners(rim);
  const VF near = spread(static_cast<float>((radius_sq + off) * static_cast<double>(Reach<float>::kOut)));
  name(outside, triangles, one ^ one, bits((p.least <= near) & ~some & present));
  if (outside.count > kRim) take_outside(rim);
}

inline void add_to_ball(const Rim<float>& rim, const Leaf<float>& leaf, const Placed<float>& p, VF triangles, MF) {
  add_placed(rim, leaf, p, triangles);
}

}  // namespace
}  // namespace kappa::kernels
