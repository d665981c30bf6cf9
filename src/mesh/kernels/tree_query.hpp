// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "leaf.hpp"

// The walk through the tree for one centre and all radii. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// A block of 8 nodes that the spheres of radii [first, last) cut.
struct Task {
  int level, first, last;
  std::uint32_t block;
};

/// The centre in the unit of the tree.
struct BoxCentre {
  float at[3];
};

/// Bounds of the squared distances of boxes that leave no doubt in spite of the rounding of the boxes' floats: `slack`
/// is what centre and corners may be off by, and a relative 1e-6 is far more than what the sums of squares are.
template <class Real>
inline BoxCentre prepare(const TreeView<Real>& tree, const BallQuery<Real>& query) {
  constexpr double kRounding = 1.2e-7, kRelative = 1e-6;
  BoxCentre centre;
  double largest = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double c = (query.centre[axis] - tree.middle[axis]) * tree.unit;
    centre.at[axis] = static_cast<float>(c);
    largest = c > largest ? c : -c > largest ? -c : largest;
  }
  const double slack = kRounding * largest;
  for (int i = 0; i < query.count; ++i) {
    const double r = query.radii[i] * tree.unit, out = (r + slack) * (1 + kRelative);
    const double in = (r - slack) * (1 - kRelative);
    query.balls[i].out_sq = static_cast<float>(out * out);
    query.balls[i].in_sq = in > slack ? static_cast<float>(in * in) : -1.0F;
  }
  return centre;
}

/// Squared distances from the centre to the nearest and farthest point of 8 boxes.
struct BoxDistances {
  VF least, most;
};

inline BoxDistances box_distances(const BoxBlock& block, const BoxCentre& centre) {
  const VF zero = spread(0.0F);
  BoxDistances d = {zero, zero};
  const auto add_axis = [&](int axis) {
    const VF c = spread(centre.at[axis]);
    const VF below = load<VF>(block.lo[axis]) - c, above = c - load<VF>(block.hi[axis]);
    const VF gap = max(max(below, above), zero), reach = min(below, above);
    d.least += gap * gap;
    d.most += reach * reach;
  };
  add_axis(0);
  add_axis(1);
  add_axis(2);
  return d;
}

inline unsigned at_most(VF values, float bound) {
  return bits(values <= spread(bound));
}

inline void number_lanes(std::size_t first, VD (&triangles)[2]) {
  const auto i = static_cast<long long>(first);
  triangles[0] = reinterpret_cast<VD>(MD{i, i + 1, i + 2, i + 3});
  triangles[1] = reinterpret_cast<VD>(MD{i + 4, i + 5, i + 6, i + 7});
}
inline void number_lanes(std::size_t first, VF (&triangles)[1]) {
  const auto i = static_cast<int>(first);
  triangles[0] = reinterpret_cast<VF>(MF{0, 1, 2, 3, 4, 5, 6, 7} + MF{i, i, i, i, i, i, i, i});
}

template <class Real>
void add_leaf(const TreeView<Real>& tree, const BallQuery<Real>& query, std::size_t leaf, int first, int last) {
  constexpr int kParts = kWidth / Lanes<Real>::kCount;
  Placed<Real> p[kParts];
  for (int part = 0; part < kParts; ++part) place(tree.leaves[leaf], part * Lanes<Real>::kCount, query.centre, p[part]);
  const std::size_t begin = kWidth * leaf, left = tree.triangles.count - begin;
  Vector<Real> triangles[kParts];
  number_lanes(begin, triangles);
  for (int radius = first; radius < last; ++radius) {
    add_leaf_to(Rim<Real>{tree.triangles, query, radius, query.balls[radius]}, tree.leaves[leaf], p, triangles,
                tree.level[0].sums + kSums * leaf, left < kWidth ? static_cast<unsigned>(left) : kWidth);
  }
}

/// Triangles below a node of a level.
template <class Real>
inline std::uint64_t faces_below(const TreeView<Real>& tree, int level, std::size_t node) {
  const int shift = 3 * (level + 1);
  const std::uint64_t begin = static_cast<std::uint64_t>(node) << shift, end = begin + (std::uint64_t{1} << shift);
  return (end < tree.triangles.count ? end : tree.triangles.count) - begin;
}

template <class Real>
struct Walk {
  const TreeView<Real>& tree;
  const BallQuery<Real>& query;
  Task stack[kWidth * kMaxLevels];
  int waiting;

  void open(const Task& task, std::size_t node, int first, int last) {
    if (task.level > 0) {
      stack[waiting++] = {task.level - 1, first, last, static_cast<std::uint32_t>(node)};
      __builtin_prefetch(&tree.level[task.level - 1].boxes[node]);
      __builtin_prefetch(&tree.level[task.level - 1].boxes[node].hi[0][0]);
    } else {
      add_leaf(tree, query, node, first, last);
    }
  }

  void prefetch_leaves(std::size_t begin, unsigned mask) {
    for (; mask != 0; mask &= mask - 1) {
      const auto* const leaf = reinterpret_cast<const char*>(tree.leaves + begin + __builtin_ctz(mask));
      for (std::size_t byte = 0; byte < sizeof(Leaf<Real>); byte += 64) __builtin_prefetch(leaf + byte);
    }
  }

  void add_node(const Task& task, std::size_t node, int radius) {
    add_whole(query.balls[radius], tree.level[task.level].sums + kSums * node, faces_below(tree, task.level, node));
  }

  void open_for_one(const Task& task, const BoxDistances& d) {
    const Gathering<Real>& ball = query.balls[task.first];
    const std::size_t begin = std::size_t{kWidth} * task.block;
    const unsigned met = at_most(d.least, ball.out_sq), in = at_most(d.most, ball.in_sq) & met;
    for (unsigned rest = in; rest != 0; rest &= rest - 1)
      add_node(task, begin + static_cast<std::size_t>(__builtin_ctz(rest)), task.first);
    if (task.level == 0) prefetch_leaves(begin, met & ~in);
    for (unsigned rest = met & ~in; rest != 0; rest &= rest - 1)
      open(task, begin + static_cast<std::size_t>(__builtin_ctz(rest)), task.first, task.last);
  }

  /// Radii of a task that hold a child whole or do not reach it narrow those for which it is opened.
  void open_for_many(const Task& task, const BoxDistances& d) {
    float least[kWidth], most[kWidth];
    store(least, d.least);
    store(most, d.most);
    for (unsigned rest = at_most(d.least, query.balls[task.last - 1].out_sq); rest != 0; rest &= rest - 1) {
      const int i = __builtin_ctz(rest);
      const std::size_t node = std::size_t{kWidth} * task.block + static_cast<std::size_t>(i);
      int first = task.first, last = task.last;
      while (first < last && least[i] > query.balls[first].out_sq) ++first;
      while (first < last && most[i] <= query.balls[last - 1].in_sq) add_node(task, node, --last);
      if (first < last) open(task, node, first, last);
    }
  }
};

template <class Real>
void run_query(const TreeView<Real>& tree, const BallQuery<Real>& query) {
  const BoxCentre centre = prepare(tree, query);
  Walk<Real> walk{tree, query, {}, 0};
  if (tree.levels > 0) walk.stack[walk.waiting++] = {tree.levels - 1, 0, query.count, 0};
  while (walk.waiting > 0) {
    const Task task = walk.stack[--walk.waiting];
    const BoxDistances d = box_distances(tree.level[task.level].boxes[task.block], centre);
    if (task.last - task.first == 1) {
      walk.open_for_one(task, d);
    } else {
      walk.open_for_many(task, d);
    }
  }
  for (int radius = 0; radius < query.count; ++radius)
    finish_rim(Rim<Real>{tree.triangles, query, radius, query.balls[radius]});
}

}  // namespace
}  // namespace kappa::kernels
