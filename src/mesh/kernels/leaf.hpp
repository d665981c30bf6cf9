// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rim.hpp"

// Where 8 triangles lie against the spheres of a query. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// What is nearer than this over the radius squared may touch the ball; the shares decide.
template <class Real>
struct Reach;
template <>
struct Reach<double> {
  static constexpr double kOut = 1 + 1e-12;
};
template <>
struct Reach<float> {
  static constexpr float kOut = 1 + 4e-6F;
};

/// As many triangles as a vector has lanes, relative to the centre.
template <class Real>
struct Placed {
  using V = Vector<Real>;
  V x[9];
  V distance_sq[3];  ///< of the corners, less `base`
  V least;           ///< lower bound over the triangle of the squared distance: that of its box
  double base;
};

/// Corners of 8 triangles, as in a leaf, where they are.
struct ChosenCorners {
  double x[9][kWidth];
};

/// Distances of the corners from the centre.
inline void place(const ChosenCorners& leaf, int at, const double* centre, Placed<double>& p) {
  const VD zero = spread(0.0);
  VD a_sq = zero, b_sq = zero, c_sq = zero, least = zero;
  p.base = 0;
  // Without inner loops: the compiler keeps all of it in registers.
  const auto add_axis = [&](int axis) {
    const VD by = spread(centre[axis]);
    const VD a = load<VD>(leaf.x[axis] + at) - by, b = load<VD>(leaf.x[3 + axis] + at) - by;
    const VD c = load<VD>(leaf.x[6 + axis] + at) - by;
    p.x[axis] = a;
    p.x[3 + axis] = b;
    p.x[6 + axis] = c;
    a_sq += a * a;
    b_sq += b * b;
    c_sq += c * c;
    const VD gap = max(max(min(a, min(b, c)), -max(a, max(b, c))), zero);
    least += gap * gap;
  };
  add_axis(0);
  add_axis(1);
  add_axis(2);
  p.distance_sq[0] = a_sq;
  p.distance_sq[1] = b_sq;
  p.distance_sq[2] = c_sq;
  p.least = least;
}

inline VF row_of(const Leaf<float>& leaf, int row) {
  return load<VF>(leaf.x[row]);
}
inline VF row_of(const Leaf<double>& leaf, int row) {
  return widened(leaf.x[row]);
}
inline double origin_from(const Leaf<float>& leaf, int axis, const double* centre) {
  return leaf.origin[axis] - centre[axis];
}
inline double origin_from(const Leaf<double>& leaf, int axis, const double* centre) {
  return (leaf.origin[axis] - centre[axis]) * leaf.steps_a_unit;
}

/// In floats the squared distance of a corner o + a, o the origin of the leaf, is taken as 2 o.a + a.a over o.o, for
/// the sake of digits: on the rim of a large ball both are small.
template <class Real>
[[gnu::always_inline]] inline void place(const Leaf<Real>& leaf, const double* centre, Placed<float>& p) {
  const VF zero = spread(0.0F);
  VF a_sq = zero, b_sq = zero, c_sq = zero, least = zero;
  p.base = 0;
  const auto add_axis = [&](int axis) {
    const double o = origin_from(leaf, axis, centre);
    p.base += o * o;
    const VF by = spread(static_cast<float>(o)), twice = by + by;
    const VF a = row_of(leaf, axis), b = row_of(leaf, 3 + axis), c = row_of(leaf, 6 + axis);
    a_sq += a * (twice + a);
    b_sq += b * (twice + b);
    c_sq += c * (twice + c);
    p.x[axis] = a + by;
    p.x[3 + axis] = b + by;
    p.x[6 + axis] = c + by;
    const VF gap = max(max(min(a, min(b, c)) + by, -(max(a, max(b, c)) + by)), zero);
    least += gap * gap;
  };
  add_axis(0);
  add_axis(1);
  add_axis(2);
  p.distance_sq[0] = a_sq;
  p.distance_sq[1] = b_sq;
  p.distance_sq[2] = c_sq;
  p.least = least;
}

inline MD may_meet(const Placed<double>& p, double radius_sq) {
  return p.least <= spread(radius_sq * Reach<double>::kOut);
}
inline MF may_meet(const Placed<float>& p, double radius_sq) {
  return p.least <= spread(static_cast<float>(radius_sq) * Reach<float>::kOut);
}

/// Names of the triangles in the lanes, the number of the first corner in them: in place of numbers of lanes.
inline VD named(VD triangles, MD second, MD third) {
  constexpr long long kTurn = 1LL << 32;
  return reinterpret_cast<VD>(reinterpret_cast<MD>(triangles) | (second & MD{kTurn, kTurn, kTurn, kTurn}) |
                              (third & MD{2 * kTurn, 2 * kTurn, 2 * kTurn, 2 * kTurn}));
}
inline VF named(VF triangles, MF, MF) {
  return triangles;
}

/// Rows of the differences of the normals, in floats.
inline void let_normals_wait(const ChosenCorners&, const Compression<VD>&, MD, MD, int, Waiting<double>&) {}
inline void let_normals_wait(const Leaf<float>& leaf, const Compression<VF>& packed, MF second, MF third, int at,
                             Waiting<float>& w) {
  for (int axis = 0; axis < 3; ++axis) {
    const VF d1 = load<VF>(leaf.x[9 + axis]), d2 = load<VF>(leaf.x[12 + axis]);
    store(w.x[9 + axis] + at, packed(select(second, d2 - d1, select(third, -d2, d1))));
    store(w.x[12 + axis] + at, packed(select(second, -d1, select(third, d1 - d2, d2))));
  }
}

/// Lets the triangles in the lanes of `mask` wait, turned so that their second or third corner comes first.
template <class Real, class Source, class M>
inline void let_wait(const Source& leaf, const Placed<Real>& p, Vector<Real> triangles, M mask, M second, M third,
                     Vector<Real> power, Waiting<Real>& w) {
  using V = Vector<Real>;
  const unsigned chosen = bits(mask);
  const int at = w.count;
  const Compression<V> packed(chosen);
  const auto let_row_wait = [&](int row, V values) { store(w.x[row] + at, packed(values)); };
  for (int axis = 0; axis < 3; ++axis) {
    const V a = p.x[axis], b = p.x[3 + axis], c = p.x[6 + axis];
    let_row_wait(axis, select(second, b, select(third, c, a)));
    let_row_wait(3 + axis, select(second, c, select(third, a, b)));
    let_row_wait(6 + axis, select(second, a, select(third, b, c)));
  }
  store(w.power + at, packed(power));
  store(w.id + at, packed(named(triangles, second, third)));
  let_normals_wait(leaf, packed, second, third, at, w);
  w.count = at + __builtin_popcount(chosen);
}

template <class Real>
inline void let_all_wait(const Rim<Real>& rim, VF triangles, unsigned mask) {
  rim.ball.faces += let_whole_wait(rim.ball, rim.triangles.measures, triangles, mask);
}
inline void let_all_wait(const Rim<double>& rim, VD triangles, unsigned mask) {
  std::uint64_t ids[4];
  store(ids, triangles);
  for (; mask != 0; mask &= mask - 1)
    add_whole(rim.ball, rim.triangles.measures, static_cast<std::uint32_t>(ids[__builtin_ctz(mask)]), 1);
}

/// Which corner is alone on its side of the sphere.
template <class M>
struct Turn {
  M second, third;
  Turn(M in0, M in1, M in2) : second((in0 ^ in1) & ~(in0 ^ in2)), third((in0 ^ in2) & ~(in0 ^ in1)) {}
};

/// Adds the triangles placed, named in the lanes of `triangles` as WaitingId says, to one ball.
template <class Real, class Source>
inline void add_placed(const Rim<Real>& rim, const Source& leaf, const Placed<Real>& p, Vector<Real> triangles) {
  using V = Vector<Real>;
  using M = Mask<Real>;
  constexpr int kLanes = Lanes<Real>::kCount;
  const double radius_sq = rim.query.radii_sq[rim.radius];
  const V bound = spread(static_cast<Real>(radius_sq - p.base));
  const M in0 = p.distance_sq[0] <= bound, in1 = p.distance_sq[1] <= bound, in2 = p.distance_sq[2] <= bound;
  const M all = in0 & in1 & in2, any = in0 | in1 | in2, cut = any & ~all;
  let_all_wait(rim, triangles, bits(all));
  if (bits(cut)) {
    if (rim.ball.corners.count > kRim - kLanes) make_corners_wait(rim);
    const Turn<M> turn(in0, in1, in2);
    const V first = select(turn.second, p.distance_sq[1], select(turn.third, p.distance_sq[2], p.distance_sq[0]));
    let_wait(leaf, p, triangles, cut, turn.second, turn.third, first - bound, rim.ball.corners);
  }
  const M outside = may_meet(p, radius_sq) & ~any;
  if (!bits(outside)) return;
  if (rim.ball.outside.count > kRim - kLanes) make_outside_wait(rim);
  const M none = outside & ~outside;
  let_wait(leaf, p, triangles, outside, none, none, p.least, rim.ball.outside);
}

}  // namespace
}  // namespace kappa::kernels
