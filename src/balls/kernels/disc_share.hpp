// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lanes.hpp"

// Area and centroid of triangle n disc for as many triangles as a vector has lanes.
//
// The boundary of the intersection is walked as the chords that the edges cut and the arcs between them. An edge that
// cuts nothing is stood for by one point on the circle, that under the point of the edge nearest to the centre: the
// arc around a corner, from the edge before it to the edge after it, then turns by less than a half circle whatever
// the case, so that no case need be told. All points are taken relative to a corner of the triangle (to the centre if
// the disc is the smaller), so that nothing larger than the triangle or the disc is summed.
//
// Error of the area in doubles: a few 1e-16 radius * longest edge. Included by kernel files alone.

namespace kappa::kernels {
namespace {

template <class Real>
struct Limits;

template <>
struct Limits<double> {
  static constexpr double kSliver = 1e-2;    ///< height over longest edge; flatter ones are left to the careful forms
  static constexpr double kTiny = 3e-4;      ///< height over radius, likewise
  static constexpr double kCertain = 1e-12;  ///< area over radius * longest edge above which it is no rounding error
  static constexpr double kClear = 1e-10;    ///< gap in squared distance over radius^2 that is no rounding error
  static constexpr double kLargest = 64;  ///< longest edge over radius above which the careful forms keep more digits
  static constexpr double kTiniest = 1e-290;
};

template <>
struct Limits<float> {
  static constexpr float kSliver = 3e-2F;
  static constexpr float kTiniest = 1e-35F;
};

/// (z - atan z) / z^3 as a polynomial in s = z^2 for |z| <= tan(pi / 8), error below 4e-17.
inline VD arctangent_rest(VD s) {
  constexpr double c[] = {0.33333333333333330156,   -0.19999999999995516545,  0.14285714284665680761,
                          -0.11111111015187018721,  0.090909045753064890845,  -0.076921831253768920895,
                          0.066645105255089365988,  -0.058581409048663282818, 0.050854078345894842573,
                          -0.039230447784793095235, 0.019175404711104933678};
  // Even and odd terms apart: half the latency, which is what four triangles wait for.
  const VD sq = s * s;
  VD even = spread(c[10]), odd = spread(c[9]);
  for (int i = 8; i >= 2; i -= 2) {
    even = even * sq + spread(c[i]);
    odd = odd * sq + spread(c[i - 1]);
  }
  return (even * sq + spread(c[0])) + odd * s;
}

struct Sum {
  VD twice_area;
  Vector2<VD> moment;
};

/// A part of the boundary along one edge, relative to the disc's centre.
struct Chord {
  Vector2<VD> from, to;
  VD distance_sq;  ///< from the centre to the edge
  VD inside;       ///< signed distance from the edge's line, positive on the triangle's side
};

/// The part of the edge from `a` in direction `e` in the disc, or the point on the circle that stands for the edge.
inline Chord cut_edge(const Vector2<VD>& a, const Vector2<VD>& e, VD length, VD r) {
  const VD zero = spread(0.0), tiniest = spread(Limits<double>::kTiniest);
  const VD h = cross(a, e), ta = dot(a, e), tb = ta + length;
  const VD w = sqrt(max((r - h) * (r + h), zero));
  const VD sa = min(max(ta, -w), w), sb = min(max(tb, -w), w);
  const VD nearest = min(max(zero, ta), tb);
  const VD distance_sq = nearest * nearest + h * h;
  const VD to_circle = r / sqrt(max(distance_sq, tiniest));
  const auto cut = sa < sb;
  const VD from = select(cut, sa, nearest * to_circle), to = select(cut, sb, nearest * to_circle);
  const VD across = select(cut, h, h * to_circle);
  const Vector2<VD> foot = {across * e.y, -across * e.x};
  return {from * e + foot, to * e + foot, distance_sq, h};
}

inline void add_side(const Vector2<VD>& a, const Vector2<VD>& b, Sum& sum) {
  const VD c = cross(a, b);
  sum.twice_area += c;
  sum.moment = sum.moment + (c * spread(1.0 / 6)) * (a + b);
}

/// Adds what lies between the side from `a` to `b` and the circle, points relative to the disc's centre; moment about
/// `origin`.
inline void add_segment(const Vector2<VD>& a, const Vector2<VD>& b, const Vector2<VD>& origin, VD r, Sum& sum) {
  const VD half = spread(0.5), zero = spread(0.0), tiniest = spread(Limits<double>::kTiniest);
  const Vector2<VD> k = b - a, mid = half * (a + b);
  const VD length = sqrt(dot(k, k)), q = half * length, apothem = sqrt(dot(mid, mid));
  // tan of a quarter of the arc is q / (r + apothem).
  const VD rm = r + apothem;
  const auto narrow = q <= rm * spread(0.41421356237309503);
  const VD z = select(narrow, q, q - rm) / select(narrow, rm, q + rm);
  const VD z_sq = z * z, rest = arctangent_rest(z_sq), r_sq = r * r;
  const VD cubic = z * z_sq;
  // r^2 (alpha - sin alpha cos alpha) for the half arc alpha; for narrow ones without the difference.
  const VD of_narrow = spread(2.0) * cubic * ((spread(3.0) + z_sq) * (half * rm) * (half * rm) - r_sq * rest);
  const VD of_wide = r_sq * spread(2.0) * (spread(0.78539816339744830962) + (z - cubic * rest)) - q * apothem;
  const VD segment = select(narrow, of_narrow, of_wide);
  const VD area = select(cross(mid, k) >= zero, segment, -segment);
  sum.twice_area += area + area;
  const VD outward = (spread(2.0 / 3) * q * q * q - segment * apothem) * (spread(1.0) / max(length, tiniest));
  const Vector2<VD> along = {k.y, -k.x};
  sum.moment = sum.moment + area * (mid - origin) + outward * along;
}

struct Shares {
  VD share, b1, b2;  ///< as in TriangleShare
  VD longest;        ///< edge
  MD certain;        ///< lanes whose share is right, and not 0
  MD missed;         ///< lanes that certainly do not meet the ball
};

inline Shares disc_shares(const Corners<VD>& t, double radius) {
  const VD zero = spread(0.0), one = spread(1.0), ball = spread(radius);
  const Vector3<VD> e1 = t.x1 - t.x0, e2 = t.x2 - t.x0, e3 = t.x2 - t.x1;
  const VD l1 = sqrt(dot(e1, e1)), l2 = sqrt(dot(e2, e2)), l3 = sqrt(dot(e3, e3));
  const VD longest = max(l1, max(l2, l3));

  // Frame on the first edge; turned straight twice, so that it is orthogonal for flat triangles too.
  const VD over_l1 = one / l1;
  const Vector3<VD> ex = over_l1 * e1;
  const VD side = dot(e2, ex);
  const Vector3<VD> across = e2 - side * ex;
  const VD height = sqrt(dot(across, across));
  const VD over_height = one / height;
  const Vector3<VD> up = over_height * across;
  const Vector3<VD> ey = up - dot(up, ex) * ex;
  const VD d = dot(cross(ex, ey), t.x0);
  const VD r_sq = (ball - d) * (ball + d), r = sqrt(max(r_sq, zero));
  const Vector2<VD> q0 = {dot(t.x0, ex), dot(t.x0, ey)};
  const Vector2<VD> q1 = {q0.x + l1, q0.y}, q2 = {q0.x + side, q0.y + height};

  const VD i3 = one / l3, i2 = one / l2;
  const Chord c1 = cut_edge(q0, {one, zero}, l1, r);
  const Chord c2 = cut_edge(q1, {(side - l1) * i3, height * i3}, l3, r);
  const Chord c3 = cut_edge(q2, {-side * i2, -height * i2}, l2, r);

  const auto small_disc = r < longest;
  const Vector2<VD> origin = {select(small_disc, zero, q0.x), select(small_disc, zero, q0.y)};
  Sum sum = {zero, {zero, zero}};
  const auto walk = [&](const Chord& c, const Chord& next) {
    add_side(c.from - origin, c.to - origin, sum);
    add_side(c.to - origin, next.from - origin, sum);
    add_segment(c.to, next.from, origin, r, sum);
  };
  walk(c1, c2);
  walk(c2, c3);
  walk(c3, c1);

  const VD twice_whole = l1 * height, least_height = twice_whole / longest;
  const VD scale = spread(2.0) / sum.twice_area;
  const VD y = (sum.moment.y * scale + (origin.y - q0.y)) * over_height;
  const VD b2 = min(max(y, zero), one);
  const VD x = (sum.moment.x * scale + (origin.x - q0.x) - b2 * side) * over_l1;
  Shares s;
  s.b1 = min(max(x, zero), one - b2);
  s.b2 = b2;
  s.share = min(sum.twice_area * (over_l1 * over_height), one);
  s.longest = longest;
  const auto regular = (least_height >= spread(Limits<double>::kSliver) * longest) &
                       (least_height >= spread(Limits<double>::kTiny) * ball);
  const auto large = longest > spread(Limits<double>::kLargest) * ball;
  s.certain = ~large & (sum.twice_area > spread(Limits<double>::kCertain) * ball * longest) & (r_sq > zero) & regular;
  const VD edges_sq = min(c1.distance_sq, min(c2.distance_sq, c3.distance_sq));
  const VD distance_sq = select(min(c1.inside, min(c2.inside, c3.inside)) < zero, edges_sq, zero);
  s.missed = (distance_sq - r_sq > spread(Limits<double>::kClear) * ball * max(ball, longest)) & regular;
  return s;
}

}  // namespace
}  // namespace kappa::kernels
