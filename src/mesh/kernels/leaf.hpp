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

/// 8 triangles relative to the centre.
template <class Real>
struct Placed {
  static constexpr int kParts = kWidth / Lanes<Real>::kCount;
  using V = Vector<Real>;
  Real x[9][kWidth];
  Real distance_sq[3][kWidth];  ///< of the corners, less `base`
  V least[kParts];              ///< lower bound over the triangle of the squared distance: that of its box
  double base;
};

/// Distances of the corners from the centre.
inline void place(const Leaf<double>& leaf, const double* centre, Placed<double>& p) {
  const VD zero = spread(0.0);
  p.base = 0;
  for (int part = 0; part < 2; ++part) {
    const int at = 4 * part;
    VD a_sq = zero, b_sq = zero, c_sq = zero, least = zero;
    // Without inner loops: the compiler keeps all of it in registers.
    const auto add_axis = [&](int axis) {
      const VD by = spread(centre[axis]);
      const VD a = load<VD>(leaf.x[axis] + at) - by, b = load<VD>(leaf.x[3 + axis] + at) - by;
      const VD c = load<VD>(leaf.x[6 + axis] + at) - by;
      store(p.x[axis] + at, a);
      store(p.x[3 + axis] + at, b);
      store(p.x[6 + axis] + at, c);
      a_sq += a * a;
      b_sq += b * b;
      c_sq += c * c;
      const VD gap = max(max(min(a, min(b, c)), -max(a, max(b, c))), zero);
      least += gap * gap;
    };
    add_axis(0);
    add_axis(1);
    add_axis(2);
    store(p.distance_sq[0] + at, a_sq);
    store(p.distance_sq[1] + at, b_sq);
    store(p.distance_sq[2] + at, c_sq);
    p.least[part] = least;
  }
}

/// In floats the squared distance of a corner o + a, o the origin of the leaf, is taken as 2 o.a + a.a over o.o, for
/// the sake of digits: on the rim of a large ball both are small.
inline void place(const Leaf<float>& leaf, const double* centre, Placed<float>& p) {
  const VF zero = spread(0.0F);
  VF a_sq = zero, b_sq = zero, c_sq = zero, least = zero;
  p.base = 0;
  const auto add_axis = [&](int axis) {
    const double o = leaf.origin[axis] - centre[axis];
    p.base += o * o;
    const VF by = spread(static_cast<float>(o)), twice = by + by;
    const VF a = load<VF>(leaf.x[axis]), b = load<VF>(leaf.x[3 + axis]), c = load<VF>(leaf.x[6 + axis]);
    a_sq += a * (twice + a);
    b_sq += b * (twice + b);
    c_sq += c * (twice + c);
    store(p.x[axis], a + by);
    store(p.x[3 + axis], b + by);
    store(p.x[6 + axis], c + by);
    const VF gap = max(max(min(a, min(b, c)) + by, -(max(a, max(b, c)) + by)), zero);
    least += gap * gap;
  };
  add_axis(0);
  add_axis(1);
  add_axis(2);
  store(p.distance_sq[0], a_sq);
  store(p.distance_sq[1], b_sq);
  store(p.distance_sq[2], c_sq);
  p.least[0] = least;
}

template <class Real>
inline unsigned at_most(const Real* values, Real bound) {
  using V = Vector<Real>;
  unsigned mask = 0;
  for (int at = 0; at < kWidth; at += Lanes<Real>::kCount) mask |= bits(load<V>(values + at) <= spread(bound)) << at;
  return mask;
}

inline unsigned may_meet(const Placed<double>& p, double radius_sq) {
  const VD bound = spread(radius_sq * Reach<double>::kOut);
  return bits(p.least[0] <= bound) | bits(p.least[1] <= bound) << 4;
}
inline unsigned may_meet(const Placed<float>& p, double radius_sq) {
  return bits(p.least[0] <= spread(static_cast<float>(radius_sq) * Reach<float>::kOut));
}

template <class Real>
inline void let_wait(const Placed<Real>& p, int lane, int turn, Real power, std::uint32_t triangle, Waiting<Real>& w) {
  static constexpr int kRow[3][3] = {{0, 3, 6}, {3, 6, 0}, {6, 0, 3}};
  const int place = w.count++;
  const int* const rows = kRow[turn];
  for (int corner = 0; corner < 3; ++corner) {
    for (int axis = 0; axis < 3; ++axis) w.x[3 * corner + axis][place] = p.x[rows[corner] + axis][lane];
  }
  w.power[place] = power;
  w.triangle[place] = triangle;
  w.turn[place] = static_cast<std::uint32_t>(turn);
}

/// Adds the 8 triangles, of which the mask `present` counts, to one ball. `sums`: of all of them, or null.
template <class Real, class Number>
inline void add_placed(const Rim<Real>& rim, const Placed<Real>& p, unsigned present, const double* sums,
                       const Number& number) {
  const double radius_sq = rim.query.radii_sq[rim.radius];
  const Real bound = static_cast<Real>(radius_sq - p.base);
  const unsigned in0 = at_most(p.distance_sq[0], bound), in1 = at_most(p.distance_sq[1], bound);
  const unsigned in2 = at_most(p.distance_sq[2], bound);
  const unsigned all = in0 & in1 & in2 & present, any = (in0 | in1 | in2) & present;
  if (sums && all == present) {
    add_whole(rim.ball, sums, static_cast<unsigned>(__builtin_popcount(present)));
    return;
  }
  for (unsigned rest = all; rest != 0; rest &= rest - 1)
    add_whole(rim.ball, rim.triangles.measures + kSums * std::size_t{number(__builtin_ctz(rest))}, 1);
  const unsigned odd1 = (in0 ^ in1) & ~(in0 ^ in2), odd2 = (in0 ^ in2) & ~(in0 ^ in1);
  if (rim.ball.corners.count > kRim - kWidth) make_corners_wait(rim);
  for (unsigned rest = any & ~all; rest != 0; rest &= rest - 1) {
    const int lane = __builtin_ctz(rest), turn = static_cast<int>((odd1 >> lane & 1) | (odd2 >> lane & 1) << 1);
    const std::uint32_t triangle = number(lane);
    prefetch(rim.triangles.measures + kSums * std::size_t{triangle});
    let_wait(p, lane, turn, p.distance_sq[turn][lane] - bound, triangle, rim.ball.corners);
  }
  const unsigned outside = may_meet(p, radius_sq) & ~any & present;
  if (!outside) return;
  if (rim.ball.outside.count > kRim - kWidth) make_outside_wait(rim);
  for (unsigned rest = outside; rest != 0; rest &= rest - 1) {
    const int lane = __builtin_ctz(rest);
    let_wait(p, lane, 0, Real(0), number(lane), rim.ball.outside);
  }
}

}  // namespace
}  // namespace kappa::kernels
