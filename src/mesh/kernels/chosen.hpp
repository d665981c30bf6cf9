// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "faces.hpp"
#include "rim.hpp"

// Triangles that a search has chosen, without a tree. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Four triangles relative to the centre.
struct Chosen {
  VD x[9];
  VD distance_sq[3];  ///< of the corners
  VD least;           ///< lower bound over the triangle of the squared distance: that of its box
  VD triangles;
};

/// Distances of the corners from the centre. Lanes that hold nothing are infinitely far.
inline void place(const TriangleView& t, const std::uint32_t* chosen, std::size_t count, const double* centre,
                  Chosen& to) {
  std::uint64_t ids[4];
  for (std::size_t lane = 0; lane < 4; ++lane) ids[lane] = chosen[lane < count ? lane : 0];
  const auto corners = [&](std::size_t lane) { return t.corners + 3 * ids[lane]; };
  const Corners<VD> x = gathered(t.positions, {corners(0), corners(1), corners(2), corners(3)});
  const VD zero = spread(0.0), absent = select(first_lanes(static_cast<double>(count)), zero, spread(__builtin_inf()));
  VD a_sq = absent, b_sq = absent, c_sq = absent, least = absent;
  const auto add_axis = [&](int axis, VD a, VD b, VD c) {
    to.x[axis] = a;
    to.x[3 + axis] = b;
    to.x[6 + axis] = c;
    a_sq += a * a;
    b_sq += b * b;
    c_sq += c * c;
    const VD gap = max(max(min(a, min(b, c)), -max(a, max(b, c))), zero);
    least += gap * gap;
  };
  const VD by[3] = {spread(centre[0]), spread(centre[1]), spread(centre[2])};
  add_axis(0, x.x0.x - by[0], x.x1.x - by[0], x.x2.x - by[0]);
  add_axis(1, x.x0.y - by[1], x.x1.y - by[1], x.x2.y - by[1]);
  add_axis(2, x.x0.z - by[2], x.x1.z - by[2], x.x2.z - by[2]);
  to.distance_sq[0] = a_sq;
  to.distance_sq[1] = b_sq;
  to.distance_sq[2] = c_sq;
  to.least = least;
  to.triangles = load<VD>(ids);
}

inline void let_all_wait(const Rim<double>& rim, VD triangles, unsigned mask) {
  std::uint64_t ids[4];
  store(ids, triangles);
  for (; mask != 0; mask &= mask - 1)
    add_whole(rim.ball, rim.triangles.measures, static_cast<std::uint32_t>(ids[__builtin_ctz(mask)]), 1);
}

/// Adds the triangles placed to one ball. What is nearer than kOut over the radius squared may touch it; the shares
/// decide.
inline void add_placed(const Rim<double>& rim, const Chosen& p) {
  constexpr double kOut = 1 + 1e-12;
  constexpr int kLanes = Lanes<double>::kCount;
  const double radius_sq = rim.query.radii_sq[rim.radius];
  const VD bound = spread(radius_sq);
  const MD in0 = p.distance_sq[0] <= bound, in1 = p.distance_sq[1] <= bound, in2 = p.distance_sq[2] <= bound;
  const MD all = in0 & in1 & in2, any = in0 | in1 | in2;
  let_all_wait(rim, p.triangles, bits(all));
  const auto corner = [&](int row) { return p.x[row]; };
  if (const unsigned cut = bits(any & ~all)) {
    if (rim.ball.corners.count > kRim - kLanes) make_corners_wait(rim);
    const Turn<MD> turn(in0, in1, in2);
    const VD first = select(turn.second, p.distance_sq[1], select(turn.third, p.distance_sq[2], p.distance_sq[0]));
    let_wait(rim.ball.corners, corner, p.triangles, cut, turn, first - bound);
  }
  const MD outside = (p.least <= spread(radius_sq * kOut)) & ~any;
  if (!bits(outside)) return;
  if (rim.ball.outside.count > kRim - kLanes) make_outside_wait(rim);
  let_wait(rim.ball.outside, corner, p.triangles, bits(outside), Turn<MD>(any, any, any), p.least);
}

inline void add_chosen(const TriangleView& triangles, const BallQuery<double>& query, int radius,
                       const std::uint32_t* chosen, std::size_t count) {
  const Rim<double> rim = {triangles, query, radius, query.balls[radius]};
  for (std::size_t begin = 0; begin < count; begin += 4) {
    Chosen c;
    place(triangles, chosen + begin, count - begin, query.centre, c);
    add_placed(rim, c);
  }
}

inline void finish_chosen(const TriangleView& triangles, const BallQuery<double>& query, int radius) {
  finish_rim(Rim<double>{triangles, query, radius, query.balls[radius]});
}

}  // namespace
}  // namespace kappa::kernels
