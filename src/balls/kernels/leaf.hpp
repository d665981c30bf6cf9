// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rim.hpp"

// Leaves of a tree against balls: what they hold is inside, outside, or waits to be measured. Included by kernel files
// alone.

namespace kappa::kernels {
namespace {

/// A leaf to a centre: squared distances of the corners of its triangles less `base`, in the unit of the leaf.
struct Met {
  VF origin[3];  ///< of the leaf, from the centre
  VF distance_sq[3];
  VF to_second, to_third;  ///< by how much those of the other corners are more than that of the first; for floats alone
  double base;
};

inline VF least(const Met& m) {
  return min(m.distance_sq[0], min(m.distance_sq[1], m.distance_sq[2]));
}

/// Of the tree.
inline double unit_of(const Leaf<float>&) {
  return 1;
}
inline double unit_of(const Leaf<double>& leaf) {
  return static_cast<double>(leaf.steps_a_unit);
}

/// The squared distance of a corner o + a, o the origin of the leaf, is taken as 2 o.a + a.a over o.o, for the sake of
/// digits: on the rim of a large ball both are small.
[[gnu::always_inline]] inline void meet(const Leaf<double>& leaf, const double* centre, Met& m) {
  VF a_sq = spread(0.0F), b_sq = a_sq, c_sq = a_sq;
  m.base = 0;
  // Without inner loops: the compiler keeps all of it in registers.
  const auto add_axis = [&](int axis) __attribute__((always_inline)) {
    const double o = (leaf.origin[axis] - centre[axis]) * unit_of(leaf);
    m.base += o * o;
    m.origin[axis] = spread(static_cast<float>(o));
    const VF a = widened(leaf.x[axis]), b = widened(leaf.x[3 + axis]), c = widened(leaf.x[6 + axis]);
    const VF twice = m.origin[axis] + m.origin[axis];
    a_sq += a * (twice + a);
    b_sq += b * (twice + b);
    c_sq += c * (twice + c);
  };
  add_axis(0);
  add_axis(1);
  add_axis(2);
  m.distance_sq[0] = a_sq;
  m.distance_sq[1] = b_sq;
  m.distance_sq[2] = c_sq;
}

/// Likewise, the other corners from the first: |x + e|^2 = |x|^2 + <2 x + e, e>.
[[gnu::always_inline]] inline void meet(const Leaf<float>& leaf, const double* centre, Met& m) {
  VF first_sq = spread(0.0F), second = first_sq, third = first_sq;
  m.base = 0;
  const auto add_axis = [&](int axis) __attribute__((always_inline)) {
    const double o = static_cast<double>(leaf.origin[axis]) - centre[axis];
    m.base += o * o;
    m.origin[axis] = spread(static_cast<float>(o));
    const VF a = load<VF>(leaf.x[axis]), e1 = load<VF>(leaf.e1[axis]), e2 = load<VF>(leaf.e2[axis]);
    const VF x = m.origin[axis] + a, twice = x + x;
    first_sq += a * (m.origin[axis] + x);
    second += e1 * (twice + e1);
    third += e2 * (twice + e2);
  };
  add_axis(0);
  add_axis(1);
  add_axis(2);
  m.to_second = second;
  m.to_third = third;
  m.distance_sq[0] = first_sq;
  m.distance_sq[1] = first_sq + second;
  m.distance_sq[2] = first_sq + third;
}

/// Corners of the triangles of a leaf along an axis, from the centre.
struct Row {
  VF first, second, third;
};
inline Row row_of(const Leaf<double>& leaf, const Met& m, int axis) {
  const VF o = m.origin[axis];
  return {widened(leaf.x[axis]) + o, widened(leaf.x[3 + axis]) + o, widened(leaf.x[6 + axis]) + o};
}
inline Row row_of(const Leaf<float>& leaf, const Met& m, int axis) {
  const VF a = load<VF>(leaf.x[axis]) + m.origin[axis];
  return {a, a + load<VF>(leaf.e1[axis]), a + load<VF>(leaf.e2[axis])};
}

/// Triangles that lie beyond a plane which the ball does not reach, that square to the way to their centroid.
template <class Real>
inline MF beyond_plane(const Leaf<Real>& leaf, const Met& m, VF reach_sq) {
  VF a_along = spread(0.0F), b_along = a_along, c_along = a_along, way_sq = a_along;
  for (int axis = 0; axis < 3; ++axis) {
    const Row row = row_of(leaf, m, axis);
    const VF way = row.first + row.second + row.third;
    a_along += row.first * way;
    b_along += row.second * way;
    c_along += row.third * way;
    way_sq += way * way;
  }
  const VF least_along = min(a_along, min(b_along, c_along));
  return (least_along > spread(0.0F)) & (least_along * least_along > reach_sq * way_sq);
}

/// What of a leaf is certainly inside a ball, what waits to be measured, and what waits unless a plane keeps it out.
struct Found {
  unsigned inside, near, perhaps;
  float reach_sq;  ///< of the ball, with what distances may be off by
};

/// Triangles with a corner within the square root of `reach_sq`, and those without that may reach into the ball. A
/// point with barycentric coordinates b_i is at |x|^2 = sum b_i |x_i|^2 - sum b_i b_j |x_i - x_j|^2: nearer than the
/// nearest corner by at most a third of the longest edge squared. `reach_sq`: squared radius with what the distances
/// may be off by.
template <class Real>
[[gnu::always_inline]] inline Found find_near(const Leaf<Real>& leaf, const Met& m, double reach_sq) {
  constexpr double kOut = 1 + 4e-6;  // for the roundings of floats
  const VF nearest = least(m);
  const double out_sq = reach_sq * kOut, bound = out_sq - m.base + static_cast<double>(leaf.third_of_longest_sq);
  const unsigned near = bits(nearest <= spread(static_cast<float>(reach_sq - m.base)));
  return {0, near, bits(nearest <= spread(static_cast<float>(bound))) & ~near, static_cast<float>(out_sq)};
}

/// Decides on those that are perhaps near.
template <class Real>
[[gnu::always_inline]] inline void settle(const Leaf<Real>& leaf, const Met& m, Found& found) {
  // Of places as far away as the leaf or its triangles reach, floats lose so much: (r + d)^2 <= 1.001 r^2 + 1001 d^2.
  const float away_sq = 2 * (static_cast<float>(m.base) + 3 * leaf.third_of_longest_sq);
  const float reach_sq = 1.001F * found.reach_sq + 1e-9F * away_sq;
  found.near |= found.perhaps & ~bits(beyond_plane(leaf, m, spread(reach_sq)));
}

/// Lets the triangles in the lanes of `mask` wait. `power`: of their first corners.
[[gnu::always_inline]] inline void let_wait(Waiting<float>& w, const Leaf<float>& leaf, const Met& m, VF names,
                                            VF power, unsigned mask) {
  const Compression<VF> packed(mask);
  const int at = w.count;
  for (int axis = 0; axis < 3; ++axis) {
    store(w.x[axis] + at, packed(load<VF>(leaf.x[axis]) + m.origin[axis]));
    store(w.e1[axis] + at, packed(load<VF>(leaf.e1[axis])));
    store(w.e2[axis] + at, packed(load<VF>(leaf.e2[axis])));
    store(w.u[axis] + at, packed(load<VF>(leaf.u[axis]) + spread(leaf.normal[axis])));
    store(w.d1[axis] + at, packed(load<VF>(leaf.d1[axis])));
    store(w.d2[axis] + at, packed(load<VF>(leaf.d2[axis])));
  }
  store(w.power + at, packed(power));
  store(w.to_second + at, packed(m.to_second));
  store(w.to_third + at, packed(m.to_third));
  let_wait(w, packed, names, mask);
}

/// What a leaf has for a ball. Places without a triangle are infinitely far.
[[gnu::always_inline]] inline Found look(const Rim<float>& rim, const Leaf<float>& leaf, const Met& m, std::size_t) {
  return find_near(leaf, m, rim.ball.radius_sq);
}

/// What the squared distance of a corner may be off by where it is about that of the radius, in steps: a corner is off
/// by half a step along each axis, and floats by 4e-7 |a| (2 |o| + |a|) with |a| below 57,000.
inline double doubt(double radius) {
  return 2.2 * radius + 1.2e4;
}

/// Those that are certainly inside have their measures; any doubt is left to the corners of the mesh. `count`:
/// triangles from the first of the leaf on.
[[gnu::always_inline]] inline Found look(const Rim<double>& rim, const Leaf<double>& leaf, const Met& m,
                                         std::size_t count) {
  const double radius = rim.ball.radius * rim.ball.to_tree * unit_of(leaf), radius_sq = radius * radius;
  const double off = doubt(radius);
  const VF low = spread(static_cast<float>(radius_sq - m.base - off));
  const VF farthest = max(m.distance_sq[0], max(m.distance_sq[1], m.distance_sq[2]));
  const unsigned present = count < kWidth ? (1U << count) - 1 : 255, inside = bits(farthest <= low) & present;
  Found found = find_near(leaf, m, radius_sq + off);
  const unsigned others = present & ~inside;
  found.inside = inside;
  found.near &= others;
  found.perhaps &= others;
  return found;
}

/// Gives the triangles in the lanes of `mask` to the forms that take them from the mesh.
template <class Real>
[[gnu::noinline]] void leave_to_mesh(const Rim<Real>& rim, VF names, unsigned mask) {
  std::uint32_t triangles[kWidth];
  store(triangles, names);
  for (; mask != 0; mask &= mask - 1) rim.query.careful(rim.query.context, triangles[__builtin_ctz(mask)], rim.number);
}

/// Triangles whose planes the ball does not reach, whatever floats make of places as far away as these.
inline unsigned out_of_plane(const Vector3<VF>& x, const Vector3<VF>& normal, VF longest_sq, VF radius) {
  // The normal is off by roundings of longest^2, which for needles is much more than its length.
  const VF off = spread(1e-6F) * longest_sq * (sqrt(dot(x, x)) + sqrt(longest_sq));
  return bits(absolute(dot(normal, x)) > sqrt(dot(normal, normal)) * radius + off);
}

/// Takes those of a leaf that reaches much farther than the ball, as among scattered or giant triangles. Squared
/// distances from its origin have too few digits left; those from where the corners are do, unless that is too far
/// away. Triangles that are too large themselves take the general form, which goes by places.
template <bool kMoments>
[[gnu::noinline]] void take_far(const Rim<float>& rim, const Leaf<float>& leaf, const Met& m, VF names, unsigned near) {
  constexpr double kFarthest = 64;
  constexpr float kLargest = 16;
  const VF radius_sq = spread(static_cast<float>(rim.ball.radius_sq));
  const VF radius = spread(static_cast<float>(rim.ball.radius));
  const Vector3<VF> x = rows_of<VF>(leaf.x, 0) + Vector3<VF>{m.origin[0], m.origin[1], m.origin[2]};
  const Vector3<VF> e1 = rows_of<VF>(leaf.e1, 0), e2 = rows_of<VF>(leaf.e2, 0), e3 = e2 - e1;
  const VF longest_sq = max(dot(e1, e1), max(dot(e2, e2), dot(e3, e3))), power = dot(x, x) - radius_sq;
  near &= ~out_of_plane(x, cross(e1, e2), longest_sq, radius);
  if (m.base > kFarthest * kFarthest * rim.ball.radius_sq) return leave_to_mesh(rim, names, near);
  const unsigned large = near & bits(longest_sq > spread(kLargest * kLargest) * radius_sq);
  Waiting<float>& waiting = rim.ball.waiting;
  if (const int first = waiting.count; large) {
    let_wait(waiting, leaf, m, names, power, large);
    hand_on<kMoments>(rim, first, (1U << (waiting.count - first)) - 1);
    waiting.count = first;
  }
  let_wait(waiting, leaf, m, names, power, near & ~large);
  make_room<kMoments>(rim);
}

/// Lets what was found wait.
template <bool kMoments>
[[gnu::always_inline]] inline void take(const Rim<float>& rim, const Leaf<float>& leaf, const Met& m, VF names,
                                        const Found& found) {
  constexpr double kFar = 12;  // in radii
  if (!found.near) return;
  if (m.base + static_cast<double>(3 * leaf.third_of_longest_sq) > kFar * kFar * rim.ball.radius_sq)
    return take_far<kMoments>(rim, leaf, m, names, found.near);
  const VF bound = spread(static_cast<float>(rim.ball.radius_sq - m.base));
  let_wait(rim.ball.waiting, leaf, m, names, m.distance_sq[0] - bound, found.near);
  make_room<kMoments>(rim);
}
template <bool kMoments>
[[gnu::always_inline]] inline void take(const Rim<double>& rim, const Leaf<double>&, const Met&, VF names,
                                        const Found& found) {
  rim.ball.faces += let_whole_wait(rim.ball, rim.triangles.measures, names, found.inside);
  let_wait(rim.ball.waiting, Compression<VF>(found.near), names, found.near);
  make_room<kMoments>(rim);
}

/// Leaves, step by step as batches on the rim: what is not to be foreseen, whether any triangle of a leaf is perhaps
/// near, is told when nothing waits for it any more.
template <class Real, bool kMoments>
class Leaves {
 public:
  static constexpr int kTogether = 16;

  Leaves(const TreeView<Real>& tree, const double* centre) : tree_(tree), centre_(centre) {}

  /// Adds `count` leaves, at most kTogether, to one ball.
  void add(const std::uint32_t* leaves, int count, const Rim<Real>& rim) {
    leaves_ = leaves;
    add_those(
        rim, count, [](int i) { return i; }, [&](int i) { meet(leaf(i), centre_, met_[i]); });
  }

  /// Adds them to several balls, `rim_of(number)` each: to those of the range of radii that each leaf has.
  template <class RimOf>
  void add(const std::uint32_t* leaves, int count, const RimOf& rim_of, int balls, const Range* radii) {
    leaves_ = leaves;
    for (int i = 0; i < count; ++i) meet(leaf(i), centre_, met_[i]);
    for (int ball = 0; ball < balls; ++ball) {
      int chosen[kTogether], meant = 0;
      for (int i = 0; i < count; ++i) {
        chosen[meant] = i;
        meant += static_cast<int>(radii[i].first <= ball) & static_cast<int>(ball < radii[i].last);
      }
      add_those(
          rim_of(ball), meant, [&](int k) { return chosen[k]; }, [](int) {});
    }
  }

 private:
  /// Of the leaves `which(k)`, each made ready by `prepare`.
  template <class Which, class Prepare>
  [[gnu::always_inline]] void add_those(const Rim<Real>& rim, int count, const Which& which, const Prepare& prepare) {
    Found found[kTogether];
    int open[kTogether], opened = 0;
    for (int k = 0; k < count; ++k) {
      const int i = which(k);
      prepare(i);
      found[k] = look(rim, leaf(i), met_[i], tree_.triangles.count - std::size_t{kWidth} * leaves_[i]);
      open[opened] = k;
      opened += static_cast<int>(found[k].perhaps != 0);
    }
    for (int o = 0; o < opened; ++o) settle(leaf(which(open[o])), met_[which(open[o])], found[open[o]]);
    for (int k = 0; k < count; ++k) {
      const int i = which(k);
      take<kMoments>(rim, leaf(i), met_[i], numbers_from(kWidth * leaves_[i]), found[k]);
    }
  }

  const Leaf<Real>& leaf(int i) const { return tree_.leaves[leaves_[i]]; }

  const TreeView<Real>& tree_;
  const double* centre_;
  const std::uint32_t* leaves_ = nullptr;
  Met met_[kTogether];
};

}  // namespace
}  // namespace kappa::kernels
