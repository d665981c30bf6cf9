// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "density.hpp"
#include "disc_share.hpp"

// The cheap forms of triangle n ball, for balls of a few edges and more: a triangle with one corner on the other side
// of the sphere than its other two, and the cap that an edge cuts off from the disc in the triangle's plane.
//
// All is computed in barycentric coordinates, from the products of two edges and a corner: the points where the sphere
// crosses edges, the triangle that they cut off, and the circular segment over the chord between them. With c the
// length of the chord, r the radius of the disc and s = c^2 / 4 r^2 = sin^2(half the arc), the segment has the area
// c^3 / 12 r F(s), and the first moment about the chord c^5 / 240 r^2 G(s), with
//   F = 3/2 (a - sin a cos a) / sin^3 a = 2F1(1/2, 3/2; 5/2; s),   G = 5 (1 - cos a F) / s.
// Included by kernel files alone.

namespace kappa::kernels {
namespace {

constexpr double kWidestArc = 0.25;  ///< s up to which F and G are fitted
constexpr double kFlattest = 1e-3;   ///< (radius of the disc over that of the ball)^2 below which digits are lost

/// Even and odd terms apart: half the latency.
template <class Real, class V, std::size_t N>
inline V polynomial(const Real (&c)[N], V s) {
  const V sq = s * s;
  V even = spread(c[N - 2]), odd = spread(c[N - 1]);
  for (std::size_t i = N - 2; i >= 2; i -= 2) {
    even = even * sq + spread(c[i - 2]);
    odd = odd * sq + spread(c[i - 1]);
  }
  return even + odd * s;
}

// Chebyshev interpolation on [0, 1/4]: relative errors 7e-16 and 2e-15 (doubles), 1e-8 and 4e-8 (floats).
template <class Real>
struct Arc;
template <>
struct Arc<double> {
  static constexpr double kArea[] = {0.99999999999999944,  0.30000000000064514,   0.16071428559176415,
                                     0.10416667574763477,  0.074573517312810825,  0.056798619743247382,
                                     0.04500783340212066,  0.037971700079914433,  0.024919937596970691,
                                     0.050260757136862691, -0.033176509632189682, 0.087758982231379512};
  static constexpr double kMoment[] = {0.999999999999998,   0.57142857143082726,  0.38095238052398372,
                                       0.27705630880618959, 0.21311900236559134,  0.17052327667947886,
                                       0.14002641517399872, 0.12175380518960736,  0.080083293451123819,
                                       0.1711007895297198,  -0.11835914580233713, 0.3042809988937224};
};
template <>
struct Arc<float> {
  static constexpr float kArea[] = {0.99999998943169799F, 0.30000303487152646F,  0.16057477450201443F,
                                    0.10647466398081019F, 0.057793283033541094F, 0.1093405855576384F};
  static constexpr float kMoment[] = {0.99999996648567524F, 0.57143819497524451F, 0.3805101543893627F,
                                      0.28436666593618193F, 0.16004641476877846F, 0.33617199392187502F};
};

/// The plane of a triangle and the disc in it.
template <class V>
struct Plane {
  Vector3<V> e1, e2;
  V e11, e22, e12;
  V normal_sq;     ///< (twice the area)^2
  V disc_sq;       ///< (radius of the disc)^2 normal_sq
  V over_disc_sq;  ///< its inverse
};

template <class Real, class V>
[[gnu::always_inline]] inline Plane<V> plane_of(const Corners<V>& t, V radius_sq) {
  Plane<V> p;
  p.e1 = t.x1 - t.x0;
  p.e2 = t.x2 - t.x0;
  p.e11 = dot(p.e1, p.e1);
  p.e22 = dot(p.e2, p.e2);
  p.e12 = dot(p.e1, p.e2);
  const Vector3<V> normal = cross(p.e1, p.e2);
  p.normal_sq = dot(normal, normal);
  const V d = dot(normal, t.x0);
  p.disc_sq = radius_sq * p.normal_sq - d * d;
  p.over_disc_sq = spread(Real(1)) / p.disc_sq;
  return p;
}

template <class Real>
struct CornerLimits;
template <>
struct CornerLimits<double> {
  static constexpr double kTiny = 2e-5;  ///< height over radius
};
template <>
struct CornerLimits<float> {
  static constexpr float kTiny = 1e-4F;
};

/// Whether the forms keep their digits for triangles of that plane.
template <class Real, class V>
inline auto well_shaped(const Plane<V>& p, V longest_sq, V radius_sq) {
  constexpr Real kSliver = Limits<Real>::kSliver, kTiny = CornerLimits<Real>::kTiny;
  constexpr Real kLargest = Limits<Real>::kLargest;
  return (p.normal_sq >= spread(kSliver * kSliver) * longest_sq * longest_sq) &
         (p.normal_sq >= spread(kTiny * kTiny) * radius_sq * longest_sq) &
         (p.disc_sq >= spread(Real(kFlattest)) * radius_sq * p.normal_sq) &
         (longest_sq <= spread(kLargest * kLargest) * radius_sq);
}

/// The circular segment over a chord, as a share of the triangle.
template <class V>
struct Segment {
  V share;
  V outward;  ///< moment about the chord over the length of (chord x normal)
};

template <class Real, class V>
inline Segment<V> segment_over(V chord_sq, const Plane<V>& p, V s) {
  const V slope_sq = chord_sq * p.over_disc_sq;
  return {spread(Real(1.0 / 6)) * chord_sq * polynomial(Arc<Real>::kArea, s) * sqrt(slope_sq),
          spread(Real(1.0 / 120)) * chord_sq * slope_sq * polynomial(Arc<Real>::kMoment, s)};
}

/// Where the edge with product `along` = <corner, edge> and squared length `length_sq` crosses the sphere, as a
/// fraction of it; the corner inside and the other end outside, or the other way round.
template <class Real, class V, class M>
inline V crossing(V along, V length_sq, V power, M inside) {
  const V zero = spread(Real(0));
  const V root = sqrt(max(along * along - length_sq * power, zero));
  const auto straight = inside & (along <= zero);
  const V q = root + max(along, -along), away = max(power, -power);
  const V t = select(straight, q, away) / max(select(straight, length_sq, q), spread(Limits<Real>::kTiniest));
  return min(t, spread(Real(1)));
}

template <class V, class M>
struct CornerPiece {
  Piece<V> piece;
  V longest_sq;
  M good;
  M opposite_cut;  ///< the cap beyond the edge opposite to the first corner is to be taken away
};

/// The part of triangles whose first corner, of `power` = |x0|^2 - radius^2, is on the other side of the sphere.
template <class Real, bool kMoments, class V, class M>
inline CornerPiece<V, M> corner_piece(const Corners<V>& t, V power, V radius_sq) {
  const V zero = spread(Real(0)), one = spread(Real(1)), third = spread(Real(1.0 / 3)), half = spread(Real(0.5));
  const Plane<V> p = plane_of<Real>(t, radius_sq);
  const V x1 = dot(t.x0, p.e1), x2 = dot(t.x0, p.e2);
  const M inside = power <= zero;
  const V f1 = crossing<Real>(x1, p.e11, power, inside), f2 = crossing<Real>(x2, p.e22, power, inside);
  const Vector3<V> chord = f2 * p.e2 - f1 * p.e1;
  const V chord_sq = dot(chord, chord), k1 = dot(chord, p.e1), k2 = dot(chord, p.e2);
  const V s = spread(Real(0.25)) * chord_sq * p.normal_sq * p.over_disc_sq;
  // The arc is less than half of the circle if the centre is behind the chord.
  const V before = k2 * (x1 + f1 * p.e11) - k1 * (x2 + f1 * p.e12);

  // The opposite edge, for corners inside.
  const V e33 = p.e11 + p.e22 - (p.e12 + p.e12), x3 = (x2 - x1) + (p.e12 - p.e11);
  const V discriminant = x3 * x3 - e33 * (power + (x1 + x1) + p.e11);
  CornerPiece<V, M> c;
  c.opposite_cut = inside & (x3 < zero) & (x3 + e33 > zero) & (discriminant > zero);
  const V widest = spread(Real(kWidestArc));
  const M narrow = (s <= widest) & (select(inside, before, -before) >= zero);
  const M wide_cap = c.opposite_cut & (discriminant * p.normal_sq > widest * e33 * p.disc_sq);
  c.longest_sq = max(p.e11, max(p.e22, e33));
  c.good = well_shaped<Real>(p, c.longest_sq, radius_sq) & narrow & ~wide_cap;

  const Segment<V> segment = segment_over<Real>(chord_sq, p, s);
  const V cut_off = select(inside, f1 * f2, -f1 * f2);
  c.piece.share = select(inside, zero, one) + cut_off + segment.share;
  if (!kMoments) return c;
  const V outward = select(inside, segment.outward, -segment.outward), of_cut_off = third * cut_off;
  c.piece.m1 = of_cut_off * (f1 - one) + segment.share * (half * f1 - third) + outward * k2;
  c.piece.m2 = of_cut_off * (f2 - one) + segment.share * (half * f2 - third) - outward * k1;
  return c;
}

/// The cap of the disc that the first edge, both of its ends outside, cuts off: on the triangle's side and to be added
/// (`sign` 1), or beyond and to be taken away (-1). Less than half of the disc.
template <class Real, class V>
inline Piece<V> cap_piece(const Corners<V>& t, V sign, V radius_sq) {
  const V zero = spread(Real(0)), third = spread(Real(1.0 / 3));
  const Plane<V> p = plane_of<Real>(t, radius_sq);
  const V x1 = dot(t.x0, p.e1), over_e11 = spread(Real(1)) / p.e11;
  const V discriminant = max(x1 * x1 - p.e11 * (dot(t.x0, t.x0) - radius_sq), zero);
  const V half_chord_sq = discriminant * over_e11;
  const V s = half_chord_sq * p.normal_sq * p.over_disc_sq;
  const V chord_sq = spread(Real(4)) * half_chord_sq;
  const Segment<V> segment = segment_over<Real>(chord_sq, p, s);
  const V share = sign * segment.share, inward = segment.outward * sqrt(chord_sq * over_e11);
  return {share, share * (-x1 * over_e11 - third) - inward * p.e12, inward * p.e11 - share * third};
}

/// How the sphere meets triangles with all corners outside.
template <class V, class M>
struct OutsideCase {
  V longest_sq;
  M missed;    ///< certainly
  M simple;    ///< certainly met, and the sum of the caps of the edges cut
  M cut[3];    ///< by edge
  M added[3];  ///< the cap of the edge is on the triangle's side
};

template <class Real, class V, class M>
inline OutsideCase<V, M> outside_case(const Corners<V>& t, V radius, V radius_sq) {
  const V zero = spread(Real(0));
  const Plane<V> p = plane_of<Real>(t, radius_sq);
  const Vector3<V> normal = cross(p.e1, p.e2), e3 = t.x2 - t.x1;
  const V e33 = dot(e3, e3);
  OutsideCase<V, M> c;
  c.longest_sq = max(p.e11, max(p.e22, e33));
  const V margin = spread(Limits<Real>::kClear) * radius * max(radius, sqrt(c.longest_sq));
  M narrow, unclear, any;
  M once = zero > zero, twice = once;
  unclear = any = once;
  narrow = ~once;
  const auto add_edge = [&](int i, const Vector3<V>& from, const Vector3<V>& to, const Vector3<V>& e, V length_sq) {
    const V along = dot(from, e);
    const V discriminant = along * along - length_sq * (dot(from, from) - radius_sq);
    const M between = (along < zero) & (along + length_sq > zero);
    c.cut[i] = between & (discriminant > zero);
    c.added[i] = c.cut[i] & (dot(normal, cross(from, to)) < zero);
    unclear = unclear | (between & (max(discriminant, -discriminant) <= margin * length_sq));
    narrow = narrow & ~(c.cut[i] & (discriminant * p.normal_sq > spread(Real(kWidestArc)) * length_sq * p.disc_sq));
    any = any | c.cut[i];
    twice = twice | (once & c.added[i]);
    once = once | c.added[i];
  };
  add_edge(0, t.x0, t.x1, p.e1, p.e11);
  add_edge(1, t.x1, t.x2, e3, e33);
  add_edge(2, t.x2, t.x0, -spread(Real(1)) * p.e2, p.e22);
  const M above = (dot(normal, cross(t.x0, t.x1)) >= zero) & (dot(normal, cross(t.x1, t.x2)) >= zero) &
                  (dot(normal, cross(t.x2, t.x0)) >= zero);
  const M far = p.disc_sq < -margin * p.normal_sq;
  constexpr Real kSliver = Limits<Real>::kSliver, kTiny = Limits<Real>::kTiny;
  const M regular = (p.normal_sq >= spread(kSliver * kSliver) * c.longest_sq * c.longest_sq) &
                    (p.normal_sq >= spread(kTiny * kTiny) * radius_sq * c.longest_sq);
  c.missed = regular & ~any & ~unclear & (~above | far);
  c.simple = well_shaped<Real>(p, c.longest_sq, radius_sq) & once & ~twice & ~unclear & narrow;
  return c;
}

}  // namespace
}  // namespace kappa::kernels
