// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "corner_share.hpp"
#include "sums.hpp"
#include "waiting.hpp"

// What a ball gets from triangles near its sphere: they wait until there are enough for several vectors, and are
// measured together, step by step. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Pieces times the weights of their triangles.
template <class V>
[[gnu::always_inline]] inline void weigh(const double* weights, const std::uint32_t* triangles, Piece<V>& piece) {
  RealOf<V> found[kLanes<V>];
  for (int lane = 0; lane < kLanes<V>; ++lane) found[lane] = static_cast<RealOf<V>>(weights[triangles[lane]]);
  const V by = load<V>(found);
  piece.share = by * piece.share;
  piece.m1 = by * piece.m1;
  piece.m2 = by * piece.m2;
}

/// Adds what triangles have beside their densities, times their shares.
template <class Real, class V>
[[gnu::noinline]] void add_beside(const double* beside, const std::uint32_t* triangles, V share,
                                  Gathering<Real>& ball) {
  RealOf<V> shares[kLanes<V>];
  store(shares, share);
  for (int lane = 0; lane < kLanes<V>; ++lane) {
    const double* const s = beside + std::size_t{kSums} * triangles[lane];
    for (int i = 0; i < kSums; ++i) ball.sum[i] += static_cast<double>(shares[lane]) * s[i];
  }
}

/// Counts triangles that were measured together, and, in doubles, what the error of their sum depends on.
template <class Real, class V, class M>
inline void count_measured(Gathering<Real>& ball, V longest_sq, M of) {
  const auto count = static_cast<unsigned>(__builtin_popcount(bits(of)));
  ball.faces += count;
  if constexpr (std::is_same_v<RealOf<V>, double>) {
    ball.measured += count;
    add_lanes(ball.longest_sq, select(of, longest_sq, splat<V>(0)));
  }
}

/// Adds what takes the general form, which is right for every case but slivers and contact.
template <bool kMoments, class Real>
[[gnu::noinline]] void add_irregular(const Rim<Real>& rim) {
  const int count = rim.ball.irregular.count;
  const VD third = spread(1.0 / 3), zero = spread(0.0);
  for (int first = 0; first < count; first += 4) {
    const std::uint32_t* const names = rim.ball.irregular.triangle + first;
    const auto four = four_irregular(rim, first);
    const auto part = disc_shares(four.corners(), rim.ball.radius);
    const MD valid = first_lanes(zero, count - first), certain = part.certain & valid;
    for (unsigned rest = bits(valid & ~certain & ~part.missed); rest != 0; rest &= rest - 1)
      rim.query.careful(rim.query.context, names[__builtin_ctz(rest)], rim.number);
    if (!bits(certain)) continue;
    count_measured(rim.ball, part.longest * part.longest, certain);
    // A lane that does not count may hold NaN, which 0 does not cancel.
    const auto counted = [&](VD of) { return select(certain, of, zero); };
    Piece<VD> piece = {counted(part.share), kMoments ? counted(part.share * (part.b1 - third)) : zero,
                       kMoments ? counted(part.share * (part.b2 - third)) : zero};
    if (rim.triangles.beside) add_beside(rim.triangles.beside, names, piece.share, rim.ball);
    if (rim.triangles.weights) weigh(rim.triangles.weights, names, piece);
    const Placed<VD> t = four.placed();
    const Vector3<VD> normal = cross(t.e1, t.e2);
    Integrals<VD> found = no_integrals<VD>();
    add_densities(normals_from<VD>(rim, rim.ball.irregular, first), t.e1, t.e2, normal, dot(normal, normal), piece,
                  found);
    add_lanes(rim.ball, found);
  }
  rim.ball.irregular.count = 0;
}

/// Lets triangles that wait from place `first` on take the general form, those in the lanes of `mask`.
template <bool kMoments, class Real>
[[gnu::noinline]] void hand_on(const Rim<Real>& rim, int first, unsigned mask) {
  for (; mask != 0; mask &= mask - 1) {
    const int place = first + __builtin_ctz(mask);
    if (rim.query.all_careful) {
      rim.query.careful(rim.query.context, rim.ball.waiting.triangle[place], rim.number);
    } else {
      make_irregular(rim.ball.waiting, place, rim.ball.irregular);
    }
  }
  if (rim.ball.irregular.count >= kRim) add_irregular<kMoments>(rim);
}

/// For triangles that the rounding of squared distances is not to hide. In floats what it hides is less than what it
/// does to the others.
template <class V>
[[gnu::always_inline]] inline V margin_of(V longest_sq, double radius) {
  constexpr double kRounding = 1e-14;  // of squared distances over longest_sq: more than that of the powers
  if constexpr (std::is_same_v<RealOf<V>, double>) {
    const V r = splat<V>(radius);
    return splat<V>(Limits<double>::kClear) * r * max(r, sqrt(longest_sq)) + splat<V>(kRounding) * longest_sq;
  } else {
    return splat<V>(0);
  }
}

/// As many triangles as a vector has lanes, and what is found of them step by step. A processor looks a few hundred
/// instructions ahead, less than all steps take: one after the other they wait for roots and quotients, while the same
/// step of several batches does not.
template <class V>
struct Batch {
  using M = decltype(V{} < V{});
  Vector3<V> e1, e2, normal;  ///< edges from the first corner, and their cross product
  V from_plane;               ///< product of the normal with any point of the plane
  Around<V> around;
  Disc<V> disc;
  V longest_sq;
  M all, cut, outside;  ///< inside the ball, with corners inside and outside, with corners outside alone
  Turn<M> turn;
  Corner<V> corner;
  Piece<V> piece;
};

/// Member by member: g++ copies whole structs in halves of vectors, which loads of whole ones then wait for.
template <class V>
[[gnu::always_inline]] inline void assign(const Vector3<V>& from, Vector3<V>& to) {
  to.x = from.x;
  to.y = from.y;
  to.z = from.z;
}

/// Fetches triangles, with the powers of their corners.
template <class Real, class V>
[[gnu::always_inline]] inline void place(const Rim<Real>& rim, int first, Batch<V>& b) {
  const InLanes<V> from(rim, rim.ball.waiting, first);
  const Placed<V> t = from.placed();
  const Vector3<V> normal = cross(t.e1, t.e2);
  assign(t.e1, b.e1);
  assign(t.e2, b.e2);
  assign(normal, b.normal);
  b.from_plane = dot(normal, t.x);
  const Powers<V> p = from.powers(splat<V>(rim.ball.radius_sq));
  b.around.power[0] = p.first, b.around.power[1] = p.second, b.around.power[2] = p.third;
  b.around.rise[0] = p.to_second, b.around.rise[1] = p.to_third - p.to_second, b.around.rise[2] = -p.to_third;
}

/// Tells those inside, cut and outside apart. `count`: lanes that hold a triangle.
template <class Real, class V>
[[gnu::always_inline]] inline void tell(const Rim<Real>& rim, int count, Batch<V>& b) {
  const V zero = splat<V>(0), one = splat<V>(1), radius_sq = splat<V>(rim.ball.radius_sq);
  const Vector3<V> e3 = b.e2 - b.e1;
  const V e11 = dot(b.e1, b.e1), e33 = dot(e3, e3), e22 = dot(b.e2, b.e2);
  b.around.edge_sq[0] = e11, b.around.edge_sq[1] = e33, b.around.edge_sq[2] = e22;
  b.longest_sq = max(e11, max(e33, e22));
  const V normal_sq = dot(b.normal, b.normal), disc_sq = radius_sq * normal_sq - b.from_plane * b.from_plane;
  b.disc.normal_sq = normal_sq;
  b.disc.disc_sq = disc_sq;
  b.disc.over_disc_sq = one / disc_sq;
  const auto in0 = b.around.power[0] <= zero, in1 = b.around.power[1] <= zero, in2 = b.around.power[2] <= zero;
  const auto valid = first_lanes(zero, count), all = in0 & in1 & in2 & valid, any = (in0 | in1 | in2) & valid;
  b.all = all;
  b.cut = any & ~all;
  b.outside = valid & ~any;
  const Turn<decltype(in0)> turn(in0, in1, in2);
  b.turn.second = turn.second;
  b.turn.third = turn.third;
}

/// Sets the pieces: whole triangles, parts of those cut where the cheap form is right, else nothing.
template <class Real, bool kMoments, class V>
[[gnu::always_inline]] inline void measure(const Rim<Real>& rim, Batch<V>& b) {
  const V zero = splat<V>(0), one = splat<V>(1);
  const auto good = rim.query.all_careful ? (b.cut & ~b.cut) : (b.cut & b.corner.good);
  const Piece<V> part = turned_back(corner_piece<Real, kMoments>(b.corner, b.disc), b.turn);
  b.piece.share = select(good, part.share, select(b.all, one, zero));
  b.piece.m1 = select(good, part.m1, zero);
  b.piece.m2 = select(good, part.m2, zero);
  b.corner.good = good;
}

/// Counts what was measured, and hands on what was not.
template <bool kMoments, class Real, class V>
[[gnu::always_inline]] inline void account(const Rim<Real>& rim, int first, const Batch<V>& b) {
  using M = decltype(V{} < V{});
  count_measured(rim.ball, b.longest_sq, b.corner.good);
  rim.ball.faces += static_cast<unsigned>(__builtin_popcount(bits(b.all)));
  M other = b.cut & ~b.corner.good;
  if (bits(b.outside))
    other = other | (b.outside & may_reach<Real, M>(b.around, b.disc, margin_of(b.longest_sq, rim.ball.radius)));
  if (const unsigned rest = bits(other)) hand_on<kMoments>(rim, first, rest);
}

/// Adds the first `count` of the triangles that wait.
template <bool kMoments, class Real>
[[gnu::always_inline]] inline void add_first(const Rim<Real>& rim, int count) {
  using V = RimVector<Real>;
  const V radius_sq = splat<V>(rim.ball.radius_sq);
  const auto& waiting = rim.ball.waiting;
  Batch<V> batches[kRim / kLanes<V>];
  const auto each = [&](const auto& step) __attribute__((always_inline)) {
    for (int first = 0; first < count; first += kLanes<V>) step(first, batches[first / kLanes<V>]);
  };
  each([&](int first, Batch<V>& b) __attribute__((always_inline)) { place(rim, first, b); });
  each([&](int first, Batch<V>& b) __attribute__((always_inline)) { tell(rim, count - first, b); });
  each([&](int, Batch<V>& b) __attribute__((always_inline)) { cross_edges<Real>(turned(b.around, b.turn), b.corner); });
  each([&](int, Batch<V>& b)
           __attribute__((always_inline)) { find_chord<Real>(b.disc, b.longest_sq, radius_sq, b.corner); });
  each([&](int, Batch<V>& b) __attribute__((always_inline)) { measure<Real, kMoments>(rim, b); });
  if (const double* const beside = rim.triangles.beside)
    each([&](int first, Batch<V>& b) { add_beside(beside, waiting.triangle + first, b.piece.share, rim.ball); });
  if (const double* const weights = rim.triangles.weights)
    each([&](int first, Batch<V>& b) { weigh(weights, waiting.triangle + first, b.piece); });
  each([&](int first, Batch<V>& b) __attribute__((always_inline)) { account<kMoments>(rim, first, b); });
  Integrals<V> found = no_integrals<V>();
  each([&](int first, Batch<V>& b) __attribute__((always_inline)) {
    add_densities(normals_from<V>(rim, waiting, first), b.e1, b.e2, b.normal, b.disc.normal_sq, b.piece, found);
  });
  add_lanes(rim.ball, found);
}

/// Adds all that waits.
template <bool kMoments, class Real>
[[gnu::noinline]] void add_all_waiting(const Rim<Real>& rim) {
  add_first<kMoments>(rim, rim.ball.waiting.count);
  rim.ball.waiting.count = 0;
  add_irregular<kMoments>(rim);
}

/// Adds kRim of those that wait, and leaves the others, fewer than kWidth.
template <bool kMoments, class Real>
[[gnu::noinline]] void add_most(const Rim<Real>& rim) {
  add_first<kMoments>(rim, kRim);
  move_down(rim.ball.waiting);
}

template <bool kMoments, class Real>
inline void make_room(const Rim<Real>& rim) {
  if (rim.ball.waiting.count >= kRim) add_most<kMoments>(rim);
}

}  // namespace
}  // namespace kappa::kernels
