// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rim.hpp"

// The walk through the tree for one centre and all radii. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// What is nearer than this over the radius squared may touch the ball; the shares decide.
template <class Real>
struct Reach;
template <>
struct Reach<double> {
  static constexpr double kOut = 1 + 1e-12, kIn = 1;
};
template <>
struct Reach<float> {
  static constexpr double kOut = 1 + 4e-6, kIn = 1 - 4e-6;
};

/// A block of 8 nodes that the spheres of radii [first, last) cut.
struct Task {
  int level, first, last;
  std::uint32_t block;
};

/// Squared distances from the centre to the nearest and farthest point of 8 boxes.
struct BoxDistances {
  VD least[2], most[2];
};

inline BoxDistances box_distances(const BoxBlock& block, const double* centre) {
  BoxDistances d;
  const VD zero = spread(0.0);
  for (int half = 0; half < 2; ++half) {
    VD least = zero, most = zero;
    const auto add_axis = [&](int axis) {
      const VD c = spread(centre[axis]);
      const VD below = load<VD>(block.lo[axis] + 4 * half) - c, above = c - load<VD>(block.hi[axis] + 4 * half);
      const VD gap = max(max(below, above), zero), reach = min(below, above);
      least += gap * gap;
      most += reach * reach;
    };
    add_axis(0);
    add_axis(1);
    add_axis(2);
    d.least[half] = least;
    d.most[half] = most;
  }
  return d;
}

/// Lanes whose value is at most `bound`.
inline unsigned at_most(const VD (&values)[2], double bound) {
  return bits(values[0] <= spread(bound)) | bits(values[1] <= spread(bound)) << 4;
}
inline unsigned at_most(const VF (&values)[1], double bound) {
  return bits(values[0] <= spread(static_cast<float>(bound)));
}

/// A leaf's corners relative to the centre, and the squared distances that place its triangles.
template <class Real>
struct LeafDistances {
  static constexpr int kParts = kWidth / Lanes<Real>::kCount;
  using V = typename Lanes<Real>::V;
  Real x[9][kWidth];
  V least[kParts];     ///< lower bound over the triangle: that of its box
  V farthest[kParts];  ///< of the farthest corner
};

inline void leaf_shift(const Leaf<double>&, const double* centre, double (&shift)[3]) {
  for (int axis = 0; axis < 3; ++axis) shift[axis] = -centre[axis];
}
inline void leaf_shift(const Leaf<float>& leaf, const double* centre, float (&shift)[3]) {
  for (int axis = 0; axis < 3; ++axis) shift[axis] = static_cast<float>(leaf.origin[axis] - centre[axis]);
}

template <class Real>
inline void place_leaf(const Leaf<Real>& leaf, const double* centre, LeafDistances<Real>& d) {
  using V = typename Lanes<Real>::V;
  const V zero = spread(Real(0));
  Real shift[3];
  leaf_shift(leaf, centre, shift);
  for (int part = 0; part < LeafDistances<Real>::kParts; ++part) {
    const int at = part * Lanes<Real>::kCount;
    V a_sq = zero, b_sq = zero, c_sq = zero, least = zero;
    // Without inner loops: the compiler keeps all of it in registers.
    const auto add_axis = [&](int axis) {
      const V by = spread(shift[axis]);
      const V a = load<V>(leaf.x[axis] + at) + by, b = load<V>(leaf.x[3 + axis] + at) + by;
      const V c = load<V>(leaf.x[6 + axis] + at) + by;
      store(d.x[axis] + at, a);
      store(d.x[3 + axis] + at, b);
      store(d.x[6 + axis] + at, c);
      a_sq += a * a;
      b_sq += b * b;
      c_sq += c * c;
      const V gap = max(max(min(a, min(b, c)), -max(a, max(b, c))), zero);
      least += gap * gap;
    };
    add_axis(0);
    add_axis(1);
    add_axis(2);
    d.least[part] = least;
    d.farthest[part] = max(a_sq, max(b_sq, c_sq));
  }
}

template <class Real>
void add_leaf(const TreeView<Real>& tree, const BallQuery& query, std::size_t leaf, int first, int last) {
  LeafDistances<Real> d;
  place_leaf(tree.leaves[leaf], query.centre, d);
  const std::uint32_t* const order = tree.order + kWidth * leaf;
  for (int radius = first; radius < last; ++radius) {
    BallAccumulator& ball = query.balls[radius];
    const double r_sq = query.radii_sq[radius];
    const unsigned in = at_most(d.farthest, r_sq * Reach<Real>::kIn);
    const unsigned met = at_most(d.least, r_sq * Reach<Real>::kOut);
    for (unsigned rest = in; rest != 0; rest &= rest - 1)
      add_whole(ball, tree.measures + kSums * std::size_t{order[__builtin_ctz(rest)]}, 1);
    for (unsigned rest = met & ~in; rest != 0; rest &= rest - 1) {
      const int from = __builtin_ctz(rest), to = ball.rim_count++;
      for (int i = 0; i < 9; ++i) ball.rim[i][to] = static_cast<double>(d.x[i][from]);
      ball.rim_triangle[to] = order[from];
      prefetch_triangle(tree, order[from]);
      if (ball.rim_count == kRim) add_rim(tree, query, radius);
    }
  }
}

/// Triangles below a node of a level.
template <class Real>
inline std::uint64_t faces_below(const TreeView<Real>& tree, int level, std::size_t node) {
  const int shift = 3 * (level + 1);
  const std::uint64_t begin = static_cast<std::uint64_t>(node) << shift, end = begin + (std::uint64_t{1} << shift);
  return (end < tree.triangles ? end : tree.triangles) - begin;
}

/// Radii of a task that hold a child whole or do not reach it narrow those for which it is opened.
template <class Real>
inline Task narrowed(const TreeView<Real>& tree, const BallQuery& query, const Task& task, std::size_t node,
                     double least, double most) {
  Task child = {task.level - 1, task.first, task.last, static_cast<std::uint32_t>(node)};
  while (child.first < child.last && least > query.radii_sq[child.first] * Reach<double>::kOut) ++child.first;
  while (child.first < child.last && most <= query.radii_sq[child.last - 1]) {
    --child.last;
    add_whole(query.balls[child.last], tree.level[task.level].sums + kSums * node, faces_below(tree, task.level, node));
  }
  return child;
}

template <class Real>
void walk(const TreeView<Real>& tree, const BallQuery& query) {
  Task stack[kWidth * kMaxLevels];
  int waiting = 0;
  if (tree.levels > 0) stack[waiting++] = {tree.levels - 1, 0, query.count, 0};
  while (waiting > 0) {
    const Task task = stack[--waiting];
    const BoxDistances d = box_distances(tree.level[task.level].boxes[task.block], query.centre);
    const unsigned met = at_most(d.least, query.radii_sq[task.last - 1] * Reach<double>::kOut);
    double least[kWidth], most[kWidth];
    for (int half = 0; half < 2; ++half) {
      store(least + 4 * half, d.least[half]);
      store(most + 4 * half, d.most[half]);
    }
    for (unsigned rest = met; rest != 0; rest &= rest - 1) {
      const int i = __builtin_ctz(rest);
      const std::size_t node = std::size_t{kWidth} * task.block + static_cast<std::size_t>(i);
      const Task child = narrowed(tree, query, task, node, least[i], most[i]);
      if (child.first >= child.last) continue;
      if (task.level > 0) {
        stack[waiting++] = child;
      } else {
        add_leaf(tree, query, node, child.first, child.last);
      }
    }
  }
}

template <class Real>
void run_query(const TreeView<Real>& tree, const BallQuery& query) {
  walk(tree, query);
  for (int radius = 0; radius < query.count; ++radius) {
    BallAccumulator& ball = query.balls[radius];
    if (ball.rim_count > 0) add_rim(tree, query, radius);
    add_waiting(ball);
  }
}

}  // namespace
}  // namespace kappa::kernels
