// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "corner_share.hpp"
#include "sums.hpp"
#include "waiting.hpp"

// What a ball gets from triangles near its sphere: they wait until there are as many as a vector has lanes, and are
// measured together. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Pieces times the weights of their triangles.
template <class V>
[[gnu::noinline]] Piece<V> weighed(const double* weights, const std::uint32_t* triangles, const Piece<V>& piece) {
  V by = splat<V>(0);
  for (int lane = 0; lane < Lanes<RealOf<V>>::kCount; ++lane)
    by[lane] = static_cast<RealOf<V>>(weights[triangles[lane]]);
  return {by * piece.share, by * piece.m1, by * piece.m2};
}

/// Adds what triangles have beside their densities, times their shares.
template <class Real, class V>
[[gnu::noinline]] void add_beside(const double* beside, const std::uint32_t* triangles, V share,
                                  Gathering<Real>& ball) {
  for (int lane = 0; lane < Lanes<RealOf<V>>::kCount; ++lane) {
    const double* const s = beside + std::size_t{kSums} * triangles[lane];
    for (int i = 0; i < kSums; ++i) ball.sum[i] += static_cast<double>(share[lane]) * s[i];
  }
}

/// Adds pieces of triangles, 0 in the lanes that do not count.
template <class Real, class V>
[[gnu::always_inline]] inline void add_pieces(const Rim<Real>& rim, const std::uint32_t* names, const Fan<V>& u,
                                              const Placed<V>& t, const Vector3<V>& normal, V normal_sq,
                                              Piece<V> piece) {
  if (rim.triangles.beside) add_beside(rim.triangles.beside, names, piece.share, rim.ball);
  if (rim.triangles.weights) piece = weighed(rim.triangles.weights, names, piece);
  add_densities(u, t.e1, t.e2, normal, normal_sq, piece, rim.ball);
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
    const auto part = disc_shares<double, VD, MD>(four.corners(), rim.ball.radius);
    const MD valid = first_lanes(zero, count - first), certain = part.certain & valid;
    for (unsigned rest = bits(valid & ~certain & ~part.missed); rest != 0; rest &= rest - 1)
      rim.query.careful(rim.query.context, names[__builtin_ctz(rest)], rim.number);
    if (!bits(certain)) continue;
    count_measured(rim.ball, part.longest * part.longest, certain);
    // A lane that does not count may hold NaN, which 0 does not cancel.
    const auto counted = [&](VD of) { return select(certain, of, zero); };
    const Piece<VD> piece = {counted(part.share), kMoments ? counted(part.share * (part.b1 - third)) : zero,
                             kMoments ? counted(part.share * (part.b2 - third)) : zero};
    const Placed<VD> t = four.placed();
    const Vector3<VD> normal = cross(t.e1, t.e2);
    add_pieces(rim, names, four.normals(), t, normal, dot(normal, normal), piece);
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
  if constexpr (std::is_same_v<RealOf<V>, double>) {
    const V r = splat<V>(radius);
    return splat<V>(Limits<double>::kClear) * r * max(r, sqrt(longest_sq));
  } else {
    return splat<V>(0);
  }
}

/// Adds as many waiting triangles as there are lanes, from place `first` on and below `end`.
template <bool kMoments, class Real>
[[gnu::always_inline]] inline void add_lanes_from(const Rim<Real>& rim, int first, int end) {
  using V = Vector<Real>;
  using M = decltype(V{} < V{});
  const V zero = splat<V>(0), one = splat<V>(1), radius_sq = splat<V>(rim.ball.radius_sq);
  const InLanes<Real> from(rim, rim.ball.waiting, first);
  const Placed<V> t = from.placed();
  const Vector3<V> e3 = t.e2 - t.e1, normal = cross(t.e1, t.e2);
  const Powers<V> p = from.powers(radius_sq);
  const Around<V> a = {{p.first, p.second, p.third},
                       {p.to_second, p.to_third - p.to_second, -p.to_third},
                       {dot(t.e1, t.e1), dot(e3, e3), dot(t.e2, t.e2)}};
  const V longest_sq = max(a.edge_sq[0], max(a.edge_sq[1], a.edge_sq[2])), from_plane = dot(normal, t.x);
  const V normal_sq = dot(normal, normal), disc_sq = radius_sq * normal_sq - from_plane * from_plane;
  const Disc<V> d = {normal_sq, disc_sq, one / disc_sq};
  const M in0 = p.first <= zero, in1 = p.second <= zero, in2 = p.third <= zero, valid = first_lanes(zero, end - first);
  const M all = in0 & in1 & in2 & valid, any = (in0 | in1 | in2) & valid, cut = any & ~all;

  const Turn<M> turn(in0, in1, in2);
  const auto corner = corner_piece<Real, kMoments, M>(turned(a, turn), d, longest_sq, radius_sq);
  const M good = rim.query.all_careful ? (cut & ~cut) : (cut & corner.good);
  const Piece<V> part = turned_back(corner.piece, turn);
  const Piece<V> piece = {select(good, part.share, select(all, one, zero)), select(good, part.m1, zero),
                          select(good, part.m2, zero)};
  const std::uint32_t* const names = rim.ball.waiting.triangle + first;
  count_measured(rim.ball, longest_sq, good);
  rim.ball.faces += static_cast<unsigned>(__builtin_popcount(bits(all)));
  M other = cut & ~good;
  const M outside = valid & ~any;
  if (bits(outside)) other = other | (outside & may_reach<Real, M>(a, d, margin_of(longest_sq, rim.ball.radius)));
  if (const unsigned rest = bits(other)) hand_on<kMoments>(rim, first, rest);
  add_pieces(rim, names, from.normals(), t, normal, normal_sq, piece);
}

/// Adds all that waits.
template <bool kMoments, class Real>
[[gnu::noinline]] void add_all_waiting(const Rim<Real>& rim) {
  const int end = rim.ball.waiting.count;
  for (int first = 0; first < end; first += Lanes<Real>::kCount) add_lanes_from<kMoments>(rim, first, end);
  rim.ball.waiting.count = 0;
  add_irregular<kMoments>(rim);
}

/// Adds kRim of those that wait, and leaves the others, fewer than kWidth.
template <bool kMoments, class Real>
[[gnu::noinline]] void add_most(const Rim<Real>& rim) {
  for (int first = 0; first < kRim; first += Lanes<Real>::kCount) add_lanes_from<kMoments>(rim, first, kRim);
  move_down(rim.ball.waiting);
}

template <bool kMoments, class Real>
inline void make_room(const Rim<Real>& rim) {
  if (rim.ball.waiting.count >= kRim) add_most<kMoments>(rim);
}

/// Lets triangles in the lanes of `mask` wait whose stored measures count as they are.
inline void let_inside_wait(const Rim<double>& rim, VF names, unsigned mask) {
  rim.ball.faces += let_whole_wait(rim.ball, rim.triangles.measures, names, mask);
}

}  // namespace
}  // namespace kappa::kernels
