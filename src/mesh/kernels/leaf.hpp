// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rim.hpp"

// Leaves of a tree against a ball. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Corners of 8 triangles against the centre, in the unit of the leaf.
struct Placed {
  VF origin[3];       ///< of the leaf, from the centre
  VF distance_sq[3];  ///< of the corners, less `base`
  double base;
};

inline VF row_of(const Leaf<float>& leaf, int row) {
  return load<VF>(leaf.x[row]);
}
inline VF row_of(const Leaf<double>& leaf, int row) {
  return widened(leaf.x[row]);
}
/// In the unit of the tree.
inline double unit_of(const Leaf<float>&) {
  return 1;
}
inline double unit_of(const Leaf<double>& leaf) {
  return static_cast<double>(leaf.steps_a_unit);
}

/// The squared distance of a corner o + a, o the origin of the leaf, is taken as 2 o.a + a.a over o.o, for the sake of
/// digits: on the rim of a large ball both are small.
template <class Real>
[[gnu::always_inline]] inline void place(const Leaf<Real>& leaf, const double* centre, Placed& p) {
  VF a_sq = spread(0.0F), b_sq = a_sq, c_sq = a_sq;
  p.base = 0;
  // Without inner loops: the compiler keeps all of it in registers.
  const auto add_axis = [&](int axis) __attribute__((always_inline)) {
    const double o = (leaf.origin[axis] - centre[axis]) * unit_of(leaf);
    p.base += o * o;
    p.origin[axis] = spread(static_cast<float>(o));
    const VF a = row_of(leaf, axis), b = row_of(leaf, 3 + axis), c = row_of(leaf, 6 + axis);
    const VF twice = p.origin[axis] + p.origin[axis];
    a_sq += a * (twice + a);
    b_sq += b * (twice + b);
    c_sq += c * (twice + c);
  };
  add_axis(0);
  add_axis(1);
  add_axis(2);
  p.distance_sq[0] = a_sq;
  p.distance_sq[1] = b_sq;
  p.distance_sq[2] = c_sq;
}

/// Triangles that lie beyond a plane which the ball does not reach, that square to the way to their centroid.
template <class Real>
inline MF beyond_plane(const Leaf<Real>& leaf, const Placed& p, VF reach_sq) {
  VF a_along = spread(0.0F), b_along = a_along, c_along = a_along, way_sq = a_along;
  for (int axis = 0; axis < 3; ++axis) {
    const VF by = p.origin[axis];
    const VF a = row_of(leaf, axis) + by, b = row_of(leaf, 3 + axis) + by, c = row_of(leaf, 6 + axis) + by;
    const VF way = a + b + c;
    a_along += a * way;
    b_along += b * way;
    c_along += c * way;
    way_sq += way * way;
  }
  const VF least = min(a_along, min(b_along, c_along));
  return (least > spread(0.0F)) & (least * least > reach_sq * way_sq);
}

/// Triangles of the lanes `outside`, which have no corner in the ball, that may reach into it. A point with barycentric
/// coordinates b_i is at |x|^2 = sum b_i |x_i|^2 - sum b_i b_j |x_i - x_j|^2: nearer than the nearest corner by at most
/// a third of the longest edge squared. `reach_sq`: squared radius with what the distances may be off by.
template <class Real>
[[gnu::always_inline]] inline unsigned may_reach(const Leaf<Real>& leaf, const Placed& p, double reach_sq, MF outside) {
  const auto bound = static_cast<float>(reach_sq - p.base + static_cast<double>(leaf.third_of_longest_sq));
  const MF near = (min(p.distance_sq[0], min(p.distance_sq[1], p.distance_sq[2])) <= spread(bound)) & outside;
  if (!bits(near)) return 0;
  return bits(near & ~beyond_plane(leaf, p, spread(static_cast<float>(reach_sq))));
}

/// Adds the triangles of a leaf of floats to one ball; places without a triangle are infinitely far.
inline void add_to_ball(const Rim<float>& rim, const Leaf<float>& leaf, const Placed& p, VF triangles, MF) {
  constexpr double kOut = 1 + 4e-6;  // for the roundings of floats
  const double radius_sq = rim.ball.reach * rim.ball.reach;
  const VF bound = spread(static_cast<float>(radius_sq - p.base));
  const MF in0 = p.distance_sq[0] <= bound, in1 = p.distance_sq[1] <= bound, in2 = p.distance_sq[2] <= bound;
  const MF all = in0 & in1 & in2, any = in0 | in1 | in2;
  let_triangles_wait(rim, triangles, bits(all));
  const auto corner = [&](int row) { return row_of(leaf, row) + p.origin[row % 3]; };
  if (const unsigned cut = bits(any & ~all)) {
    if (rim.ball.corners.count > kRim - kWidth) make_corners_wait(rim);
    const Turn<MF> turn(in0, in1, in2);
    const VF first = select(turn.second, p.distance_sq[1], select(turn.third, p.distance_sq[2], p.distance_sq[0]));
    let_wait(rim.ball.corners, corner, triangles, cut, turn, first - bound);
  }
  const unsigned outside = may_reach(leaf, p, radius_sq * kOut, ~any);
  if (!outside) return;
  if (rim.ball.outside.count > kRim - kWidth) make_outside_wait(rim);
  let_wait(rim.ball.outside, corner, triangles, outside, Turn<MF>(any, any, any), bound);
}

}  // namespace
}  // namespace kappa::kernels
