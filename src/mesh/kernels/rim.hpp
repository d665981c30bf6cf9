// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "corner_share.hpp"
#include "sums.hpp"

// What a ball gets from the triangles on its rim: they wait by kind and are measured as many together as a vector has
// lanes. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// What all steps need for one ball.
template <class Real>
struct Rim {
  const TriangleView& triangles;
  const BallQuery<Real>& query;
  int radius;
  Gathering<Real>& ball;
};

/// Lengths on the rim are in the unit of the tree in floats, so that their range does for data in any units.
inline double radius_of(const Rim<double>& rim) {
  return rim.query.radii[rim.radius];
}
inline float radius_of(const Rim<float>& rim) {
  return static_cast<float>(rim.ball.reach);
}
inline double radius_sq_of(const Rim<double>& rim) {
  return rim.query.radii_sq[rim.radius];
}
inline float radius_sq_of(const Rim<float>& rim) {
  return static_cast<float>(rim.ball.reach * rim.ball.reach);
}

/// Which corner is alone on its side of the sphere.
template <class M>
struct Turn {
  M second, third;
  Turn(M in0, M in1, M in2) : second((in0 ^ in1) & ~(in0 ^ in2)), third((in0 ^ in2) & ~(in0 ^ in1)) {}
};

/// Stores what triangles are called while they wait.
inline void store_names(std::uint64_t* to, const Compression<VD>& packed, VD triangles, const Turn<MD>& turn) {
  constexpr long long kTurn = 1LL << 32;
  const MD second = {kTurn, kTurn, kTurn, kTurn};
  store(to, packed(reinterpret_cast<VD>(reinterpret_cast<MD>(triangles) | (turn.second & second) |
                                        (turn.third & (second + second)))));
}
inline void store_names(std::uint64_t* to, const Compression<VF>& packed, VF triangles, const Turn<MF>& turn) {
  const MF one = {1, 1, 1, 1, 1, 1, 1, 1};
  const MF turns = (turn.second & one) | (turn.third & (one + one));
  store_pairs(to, packed(triangles), packed(reinterpret_cast<VF>(turns)));
}

/// Lanes [0, count) of a vector.
inline MD first_lanes(double count) {
  return VD{0, 1, 2, 3} < spread(count);
}
inline MF first_lanes(float count) {
  return VF{0, 1, 2, 3, 4, 5, 6, 7} < spread(count);
}

template <class Real>
inline Corners<Vector<Real>> corners_at(const Waiting<Real>& w, int first) {
  using V = Vector<Real>;
  const auto row = [&](int i) { return load<V>(w.x[i] + first); };
  return {{row(0), row(1), row(2)}, {row(3), row(4), row(5)}, {row(6), row(7), row(8)}};
}

/// Lets the triangle at place `from` of `w` wait in `to`, turned by so many corners.
template <class Real>
inline int hand_on(const Waiting<Real>& w, int from, int turn, Waiting<Real>& to) {
  const int place = to.count++;
  for (int corner = 0; corner < 3; ++corner) {
    const int of = (corner + turn) % 3;
    for (int axis = 0; axis < 3; ++axis) to.x[3 * corner + axis][place] = w.x[3 * of + axis][from];
  }
  to.id[place] = triangle_of(w.id[from]) | ((w.id[from] >> 32) + static_cast<std::uint64_t>(turn)) % 3 << 32;
  return place;
}

/// Calls `measure(first place, lanes that count)` for vectors of what waits, and empties it. The other lanes hold
/// triangles that waited before; what they yield is not used.
template <class Real, class Measure>
inline void for_lanes(Waiting<Real>& w, const Measure& measure) {
  constexpr int kLanes = Lanes<Real>::kCount;
  for (int first = 0; first < w.count; first += kLanes) measure(first, first_lanes(static_cast<Real>(w.count - first)));
  w.count = 0;
}

/// Adds the pieces in the lanes of `good`.
template <class Real, bool kMoments, class M>
inline void add_pieces(const Rim<Real>& rim, const Waiting<Real>& w, int first, const Piece<Vector<Real>>& piece,
                       const Corners<Vector<Real>>& t, M good) {
  using V = Vector<Real>;
  // A lane that does not count may hold NaN, which 0 does not cancel.
  const V zero = spread(Real(0));
  const std::uint64_t* const ids = w.id + first;
  const V by = weights_of<Real>(rim.triangles, ids);
  const auto counted = [&](V of) { return select(good, by * of, zero); };
  const Piece<V> weighted = {counted(piece.share), kMoments ? counted(piece.m1) : zero,
                             kMoments ? counted(piece.m2) : zero};
  add_densities(fan_of(rim.triangles.normals, rim.triangles, ids, Lanes<Real>()), t.x1 - t.x0, t.x2 - t.x0, weighted,
                rim.ball);
  if (!rim.triangles.beside) return;
  Real share[Lanes<Real>::kCount];
  store(share, select(good, piece.share, zero));
  add_shares(rim.triangles.beside, ids, share, rim.ball);
}

inline void add_whole_triangles(const Rim<double>& rim) {
  add_waiting(rim.ball, rim.triangles.measures);
}
inline void add_whole_triangles(const Rim<float>& rim) {
  add_waiting(rim.ball, rim.triangles.float_measures);
}

/// Lets the triangles in the lanes of `mask` wait, whose corners `row` gives, the one that the turn says first.
template <class Real, class Row>
[[gnu::always_inline]] inline void let_wait(Waiting<Real>& w, const Row& row, Vector<Real> triangles, unsigned mask,
                                            const Turn<Mask<Real>>& turn, Vector<Real> power) {
  using V = Vector<Real>;
  const int at = w.count;
  const Compression<V> packed(mask);
  const auto turned = [&](V a, V b, V c) { return packed(select(turn.second, b, select(turn.third, c, a))); };
  for (int axis = 0; axis < 3; ++axis) {
    const V a = row(axis), b = row(3 + axis), c = row(6 + axis);
    store(w.x[axis] + at, turned(a, b, c));
    store(w.x[3 + axis] + at, turned(b, c, a));
    store(w.x[6 + axis] + at, turned(c, a, b));
  }
  store(w.power + at, packed(power));
  store_names(w.id + at, packed, triangles, turn);
  w.count = at + __builtin_popcount(mask);
}

/// Lets the triangles in the lanes of `mask` wait, all inside of the ball.
template <class Real>
inline void let_triangles_wait(const Rim<Real>& rim, VF triangles, unsigned mask) {
  Gathering<Real>& ball = rim.ball;
  store(ball.whole + ball.whole_count, Compression<VF>(mask)(triangles));
  const int count = __builtin_popcount(mask);
  ball.whole_count += count;
  ball.faces += static_cast<unsigned>(count);
  if (ball.whole_count >= kWaiting) add_whole_triangles(rim);
}

/// Counts triangles that were measured together, and what the error of their sum depends on.
template <class Real, class M>
inline void count_measured(const Rim<Real>& rim, Vector<Real> longest_sq, M of) {
  const auto count = static_cast<unsigned>(__builtin_popcount(bits(of)));
  rim.ball.measured += count;
  rim.ball.faces += count;
  add_lanes(rim.ball.longest_sq, select(of, longest_sq, spread(Real(0))));
}

/// Whether all that waits has gone to the careful forms.
template <class Real>
inline bool all_to_careful(const Rim<Real>& rim, Waiting<Real>& w) {
  if (!rim.query.all_careful) return false;
  for (int i = 0; i < w.count; ++i)
    rim.query.careful(rim.query.context, static_cast<std::uint32_t>(w.id[i]), rim.radius);
  w.count = 0;
  return true;
}

/// Share and moments by the form that is right for every case but slivers and contact.
template <class Real, bool kMoments>
void add_irregular(const Rim<Real>& rim) {
  using V = Vector<Real>;
  Waiting<Real>& w = rim.ball.irregular;
  const V third = spread(Real(1.0 / 3));
  for_lanes(w, [&](int first, Mask<Real> valid) {
    const Corners<V> t = corners_at(w, first);
    const auto part = disc_shares<Real, V, Mask<Real>>(t, radius_of(rim));
    const Mask<Real> certain = part.certain & valid;
    for (unsigned rest = bits(valid & ~certain & ~part.missed); rest != 0; rest &= rest - 1)
      rim.query.careful(rim.query.context, static_cast<std::uint32_t>(w.id[first + __builtin_ctz(rest)]), rim.radius);
    count_measured(rim, part.longest * part.longest, certain);
    const Piece<V> piece = {part.share, part.share * (part.b1 - third), part.share * (part.b2 - third)};
    add_pieces<Real, kMoments>(rim, w, first, piece, t, certain);
  });
}

template <class Real, bool kMoments>
void add_caps(const Rim<Real>& rim) {
  using V = Vector<Real>;
  Waiting<Real>& w = rim.ball.caps;
  const V radius_sq = spread(radius_sq_of(rim));
  for_lanes(w, [&](int first, Mask<Real> valid) {
    const Corners<V> t = corners_at(w, first);
    const Piece<V> piece = cap_piece<Real>(t, load<V>(w.sign + first), radius_sq);
    add_pieces<Real, kMoments>(rim, w, first, piece, t, valid);
  });
}

/// Makes room for three more caps and one more irregular triangle a lane.
template <class Real, bool kMoments>
inline void make_room(const Rim<Real>& rim) {
  constexpr int kLanes = Lanes<Real>::kCount;
  if (rim.ball.caps.count + 3 * kLanes > kRim) add_caps<Real, kMoments>(rim);
  if (rim.ball.irregular.count + kLanes > kRim) add_irregular<Real, kMoments>(rim);
}

template <class Real>
inline void let_cap_wait(const Rim<Real>& rim, const Waiting<Real>& w, int place, int edge, Real sign) {
  rim.ball.caps.sign[hand_on(w, place, edge, rim.ball.caps)] = sign;
}

template <class Real, bool kMoments>
void add_corners(const Rim<Real>& rim) {
  using V = Vector<Real>;
  Waiting<Real>& w = rim.ball.corners;
  if (all_to_careful(rim, w)) return;
  const V radius_sq = spread(radius_sq_of(rim));
  for_lanes(w, [&](int first, Mask<Real> valid) {
    const Corners<V> t = corners_at(w, first);
    const auto c = corner_piece<Real, kMoments, V, Mask<Real>>(t, load<V>(w.power + first), radius_sq);
    const Mask<Real> good = c.good & valid;
    make_room<Real, kMoments>(rim);
    for (unsigned rest = bits(valid & ~good); rest != 0; rest &= rest - 1)
      hand_on(w, first + __builtin_ctz(rest), 0, rim.ball.irregular);
    for (unsigned rest = bits(c.opposite_cut & good); rest != 0; rest &= rest - 1)
      let_cap_wait(rim, w, first + __builtin_ctz(rest), 1, Real(-1));
    count_measured(rim, c.longest_sq, good);
    add_pieces<Real, kMoments>(rim, w, first, c.piece, t, good);
  });
}

/// Sorts the triangles with all corners outside.
template <class Real, bool kMoments>
void sort_outside(const Rim<Real>& rim) {
  using V = Vector<Real>;
  Waiting<Real>& w = rim.ball.outside;
  if (all_to_careful(rim, w)) return;
  const V radius = spread(radius_of(rim));
  const V radius_sq = spread(radius_sq_of(rim));
  for_lanes(w, [&](int first, Mask<Real> valid) {
    const auto c = outside_case<Real, V, Mask<Real>>(corners_at(w, first), radius, radius_sq);
    const unsigned simple = bits(c.simple & valid);
    const unsigned other = bits(valid & ~c.simple & ~c.missed);
    if (!(simple | other)) return;
    make_room<Real, kMoments>(rim);
    for (unsigned rest = other; rest != 0; rest &= rest - 1)
      hand_on(w, first + __builtin_ctz(rest), 0, rim.ball.irregular);
    for (int edge = 0; simple != 0 && edge < 3; ++edge) {
      const unsigned added = bits(c.added[edge]);
      for (unsigned rest = bits(c.cut[edge]) & simple; rest != 0; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        let_cap_wait(rim, w, first + lane, edge, (added >> lane & 1) ? Real(1) : Real(-1));
      }
    }
    count_measured(rim, c.longest_sq, c.simple & valid);
  });
}

template <class Real, bool kMoments>
void add_all_waiting(const Rim<Real>& rim) {
  add_corners<Real, kMoments>(rim);
  sort_outside<Real, kMoments>(rim);
  add_caps<Real, kMoments>(rim);
  add_irregular<Real, kMoments>(rim);
  add_whole_triangles(rim);
}

template <class Real>
inline void finish_rim(const Rim<Real>& rim) {
  if (rim.query.exact_density) {
    add_all_waiting<Real, true>(rim);
  } else {
    add_all_waiting<Real, false>(rim);
  }
}

template <class Real>
inline void make_corners_wait(const Rim<Real>& rim) {
  if (rim.query.exact_density) {
    add_corners<Real, true>(rim);
  } else {
    add_corners<Real, false>(rim);
  }
}
template <class Real>
inline void make_irregular_wait(const Rim<Real>& rim) {
  if (rim.query.exact_density) {
    add_irregular<Real, true>(rim);
  } else {
    add_irregular<Real, false>(rim);
  }
}
template <class Real>
inline void make_outside_wait(const Rim<Real>& rim) {
  if (rim.query.exact_density) {
    sort_outside<Real, true>(rim);
  } else {
    sort_outside<Real, false>(rim);
  }
}

}  // namespace
}  // namespace kappa::kernels
