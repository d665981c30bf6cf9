// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "density.hpp"
#include "disc_share.hpp"

// The cheap form of triangle n ball, for balls of a few edges and more: a triangle with one corner on the other side of
// the sphere than its other two.
//
// All is computed from the squared lengths of the edges and the powers of the corners, |corner|^2 - radius^2, which do
// not ask for a frame: where the sphere crosses two edges, the triangle that is cut off, and the circular segment over
// the chord between the crossings. With c the length of the chord, r the radius of the disc and
// s = c^2 / 4 r^2 = sin^2(half the arc), the segment has the area c^3 / 12 r F(s), and the first moment about the chord
// c^5 / 240 r^2 G(s), with
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
  V even = splat<V>(c[N - 2]), odd = splat<V>(c[N - 1]);
  for (std::size_t i = N - 2; i >= 2; i -= 2) {
    even = even * sq + splat<V>(c[i - 2]);
    odd = odd * sq + splat<V>(c[i - 1]);
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

/// The disc that the ball cuts from the plane of a triangle with normal n, whose length is twice its area.
template <class V>
struct Disc {
  V normal_sq;     ///< |n|^2
  V disc_sq;       ///< (radius of the disc)^2 |n|^2
  V over_disc_sq;  ///< its inverse
};

/// Whether the forms keep their digits for triangles in the plane of the disc. Floats never get triangles that are too
/// large for the ball.
template <class Real, class V>
inline auto well_shaped(const Disc<V>& d, V longest_sq, V radius_sq) {
  constexpr Real kSliver = Limits<Real>::kSliver, kTiny = CornerLimits<Real>::kTiny;
  const V least_height_sq = max(splat<V>(kSliver * kSliver) * longest_sq, splat<V>(kTiny * kTiny) * radius_sq);
  const auto shaped =
      (d.normal_sq >= least_height_sq * longest_sq) & (d.disc_sq >= splat<V>(kFlattest) * radius_sq * d.normal_sq);
  if constexpr (std::is_same_v<Real, double>) {
    constexpr double kLargest = Limits<double>::kLargest;
    return shaped & (longest_sq <= splat<V>(kLargest * kLargest) * radius_sq);
  } else {
    return shaped;
  }
}

/// What there is of a triangle at its corners and edges, edge i from corner i to the next one.
template <class V>
struct Around {
  V power[3];    ///< of the corners
  V rise[3];     ///< of the power along the edges: it has more digits than the difference of powers
  V edge_sq[3];  ///< squared lengths of the edges
};

/// Which corner is alone on its side of the sphere, if it is not the first.
template <class M>
struct Turn {
  M second, third;
  Turn() = default;
  Turn(M in0, M in1, M in2) : second((in0 ^ in1) & ~(in0 ^ in2)), third((in0 ^ in2) & ~(in0 ^ in1)) {}
};

/// Triangles from their lonely corners on.
template <class V, class M>
[[gnu::always_inline]] inline Around<V> turned(const Around<V>& a, const Turn<M>& turn) {
  const auto from = [&](const V& first, const V& second, const V& third) {
    return select(turn.second, second, select(turn.third, third, first));
  };
  const auto all_from = [&](const V(&of)[3], V(&to)[3]) {
    for (int i = 0; i < 3; ++i) to[i] = from(of[i], of[(i + 1) % 3], of[(i + 2) % 3]);
  };
  Around<V> t;
  all_from(a.power, t.power);
  all_from(a.rise, t.rise);
  all_from(a.edge_sq, t.edge_sq);
  return t;
}

/// Pieces of turned triangles, as seen from their first corners.
template <class V, class M>
[[gnu::always_inline]] inline Piece<V> turned_back(const Piece<V>& p, const Turn<M>& turn) {
  const V m0 = -(p.m1 + p.m2);
  return {p.share, select(turn.second, m0, select(turn.third, p.m2, p.m1)),
          select(turn.second, p.m1, select(turn.third, m0, p.m2))};
}

/// The circular segment over a chord, as a share of the triangle.
template <class V>
struct Segment {
  V share;
  V outward;  ///< moment about the chord over the length of (chord x normal)
};

template <class Real, bool kMoments, class V>
inline Segment<V> segment_over(V chord_sq, const Disc<V>& d, V s) {
  const V slope_sq = chord_sq * d.over_disc_sq;
  return {splat<V>(1.0 / 6) * chord_sq * polynomial(Arc<Real>::kArea, s) * sqrt(slope_sq),
          kMoments ? splat<V>(1.0 / 120) * chord_sq * slope_sq * polynomial(Arc<Real>::kMoment, s) : splat<V>(0)};
}

/// Where the edge with product `along` = <corner, edge> and squared length `length_sq` crosses the sphere, as a
/// fraction of it; the corner inside and the other end outside, or the other way round.
template <class Real, class V, class M>
inline V crossing(V along, V length_sq, V power, M inside) {
  const V zero = splat<V>(0);
  const V root = sqrt(max(along * along - length_sq * power, zero));
  const auto straight = inside & (along <= zero);
  const V q = root + absolute(along), away = absolute(power);
  const V t = select(straight, q, away) / max(select(straight, length_sq, q), splat<V>(Limits<Real>::kTiniest));
  return min(t, splat<V>(1));
}

/// Triangles from a corner on that is alone on its side of the sphere, and what is found there step by step.
template <class V>
struct Corner {
  using M = decltype(V{} < V{});
  M inside;         ///< the ball
  V x1, x2;         ///< products of the corner with the edges e1, e2 from it
  V e11, e12, e22;  ///< products of the edges
  V f1, f2;         ///< where the sphere crosses them, as fractions of them
  V k1, k2;         ///< products of the chord f2 e2 - f1 e1 with them
  V chord_sq, s;    ///< squared length of the chord, and as above
  M good;           ///< the forms are right
};

/// `t`: from their lonely corners on.
template <class Real, class V>
[[gnu::always_inline]] inline void cross_edges(const Around<V>& t, Corner<V>& c) {
  const V zero = splat<V>(0), half = splat<V>(0.5);
  const V power = t.power[0], e11 = t.edge_sq[0], e33 = t.edge_sq[1], e22 = t.edge_sq[2];
  // Products of the corners with the edges: |x + e|^2 = |x|^2 + 2 <x, e> + |e|^2.
  const V x1 = half * (t.rise[0] - e11), x2 = -half * (t.rise[2] + e22), x3 = half * (t.rise[1] - e33);
  const auto inside = power <= zero;
  // For corners inside, the sphere may cross the opposite edge twice.
  c.good = ~(inside & (x3 < zero) & (x3 + e33 > zero) & (x3 * x3 > e33 * t.power[1]));
  c.inside = inside;
  c.x1 = x1, c.x2 = x2;
  c.e11 = e11, c.e12 = half * (e11 + e22 - e33), c.e22 = e22;
  c.f1 = crossing<Real>(x1, e11, power, inside), c.f2 = crossing<Real>(x2, e22, power, inside);
}

template <class Real, class V>
[[gnu::always_inline]] inline void find_chord(const Disc<V>& d, V longest_sq, V radius_sq, Corner<V>& c) {
  const V zero = splat<V>(0);
  const V f1 = c.f1, f2 = c.f2, k1 = f2 * c.e12 - f1 * c.e11, k2 = f2 * c.e22 - f1 * c.e12;
  const V chord_sq = max(f2 * k2 - f1 * k1, zero);
  const V s = splat<V>(0.25) * chord_sq * d.normal_sq * d.over_disc_sq;
  // The arc is less than half of the circle if the centre is behind the chord.
  const V before = k2 * (c.x1 + f1 * c.e11) - k1 * (c.x2 + f1 * c.e12);
  const auto narrow = (s <= splat<V>(kWidestArc)) & (select(c.inside, before, -before) >= zero);
  c.good = c.good & narrow & well_shaped<Real>(d, longest_sq, radius_sq);
  c.k1 = k1, c.k2 = k2;
  c.chord_sq = chord_sq, c.s = s;
}

/// What the ball has of triangles on the side of their lonely corners, or on the other.
template <class Real, bool kMoments, class V>
[[gnu::always_inline]] inline Piece<V> corner_piece(const Corner<V>& c, const Disc<V>& d) {
  const V zero = splat<V>(0), one = splat<V>(1), third = splat<V>(1.0 / 3), half = splat<V>(0.5);
  const V f1 = c.f1, f2 = c.f2;
  const Segment<V> segment = segment_over<Real, kMoments>(c.chord_sq, d, c.s);
  const V cut_off = select(c.inside, f1 * f2, -f1 * f2);
  Piece<V> piece = {select(c.inside, zero, one) + cut_off + segment.share, zero, zero};
  if (!kMoments) return piece;
  const V outward = select(c.inside, segment.outward, -segment.outward), of_cut_off = third * cut_off;
  piece.m1 = of_cut_off * (f1 - one) + segment.share * (half * f1 - third) + outward * c.k2;
  piece.m2 = of_cut_off * (f2 - one) + segment.share * (half * f2 - third) - outward * c.k1;
  return piece;
}

/// Which of triangles with all corners outside the ball may reach into it: one of their edges does, or the disc lies
/// within them. `margin`: in squared distances, for what is not to be missed by rounding.
template <class Real, class M, class V>
[[gnu::always_inline]] inline M may_reach(const Around<V>& t, const Disc<V>& d, V margin) {
  const V zero = splat<V>(0), quarter = splat<V>(0.25), half = splat<V>(0.5);
  M crossed = zero > zero;
  for (int i = 0; i < 3; ++i) {
    const V length_sq = t.edge_sq[i], twice = t.rise[i] - length_sq;
    const M between = (absolute(t.rise[i]) < length_sq);
    crossed = crossed | (between & (quarter * twice * twice >= length_sq * (t.power[i] - margin)));
  }
  // The foot of the centre, in barycentric coordinates times |n|^2.
  const V e11 = t.edge_sq[0], e33 = t.edge_sq[1], e22 = t.edge_sq[2], e12 = half * (e11 + e22 - e33);
  const V x1 = half * (t.rise[0] - e11), x2 = -half * (t.rise[2] + e22);
  const V b1 = x2 * e12 - x1 * e22, b2 = x1 * e12 - x2 * e11;
  const M above = (b1 >= zero) & (b2 >= zero) & (b1 + b2 <= d.normal_sq);
  return crossed | (above & (d.disc_sq >= -margin * d.normal_sq));
}

}  // namespace
}  // namespace kappa::kernels
