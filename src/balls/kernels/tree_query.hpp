// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/bounds.hpp"
#include "leaf.hpp"
#include "nodes.hpp"

// The walk through the tree for one centre and all radii: level by level, so that the order of all additions is that of
// the nodes, wherever the walk starts. Included by kernel files alone.

namespace kappa::kernels {
namespace {

/// Triangles that a node of the level has less than others, if it is the last one.
inline std::uint64_t missing_in_last(const NodeView& tree, int level) {
  return (static_cast<std::uint64_t>(tree.level[level].nodes) << 3 * (level + 1)) - tree.triangles;
}

/// The unit in which triangles on the rim are measured: that of the mesh in doubles; that of the tree in floats, so
/// that their range does for data in any units.
inline void set_unit(const NodeView& tree, Gathering<double>& ball) {
  ball.to_tree = tree.unit;
}
inline void set_unit(const NodeView& tree, Gathering<float>& ball) {
  ball.unit = tree.unit;
  ball.to_tree = 1;
  ball.radius *= tree.unit;
  ball.radius_sq = ball.radius * ball.radius;
}

template <class Real, bool kMoments>
class Walk {
 public:
  Walk(const TreeView<Real>& tree, const BallQuery<Real>& query, const Visits& visits)
      : tree_(tree),
        query_(query),
        visits_(visits),
        place_(tree.nodes, query.centre),
        leaves_(tree, place_.at),
        level_(visits.start.level) {
    for (int axis = 0; axis < 3; ++axis) at_[axis] = static_cast<float>(place_.at[axis]);
    for (int i = 0; i < query.count; ++i) {
      Gathering<Real>& ball = query.balls[i];
      set_unit(tree.nodes, ball);
      const BoxBounds bounds(query.radii[i] * tree.nodes.unit, place_.farthest);
      ball.out_sq = bounds.out_sq;
      ball.in_sq = bounds.in_sq;
    }
  }

  template <bool kMany>
  void run() {
    const Range all = {0, query_.count};
    for (int i = 0; i < visits_.start.count; i += kWidth) visit<kMany>(boxes_at(visits_.start, i), all);
    finish_level();
    while (level_ > 0) {
      --level_;
      const std::uint32_t* const blocks = visits_.nodes[now_];
      const Range* const ranges = visits_.ranges[now_];
      const std::size_t count = found_;
      now_ ^= 1;
      found_ = 0;
      for (std::size_t i = 0; i < count; ++i) {
        prefetch_block(blocks[i + (i + kAhead < count ? kAhead : 0)]);
        visit<kMany>(boxes_of(tree_.nodes, level_, blocks[i]), kMany ? ranges[i] : all);
      }
      finish_level();
    }
    add_leaves<kMany>(static_cast<int>(found_));
  }

 private:
  static constexpr std::size_t kAhead = 2;

  void prefetch_block(std::uint32_t block) const {
    const BoxBlock& b = tree_.nodes.level[level_].boxes[block];
    __builtin_prefetch(&b.lo[0][0]);
    __builtin_prefetch(&b.lo[2][0]);
    __builtin_prefetch(&b.hi[1][0]);
  }

  void prefetch_leaf(std::uint32_t leaf) const {
    const auto* const first = reinterpret_cast<const char*>(tree_.leaves + leaf);
    for (std::size_t byte = 0; byte < sizeof(Leaf<Real>); byte += 64) __builtin_prefetch(first + byte);
  }

  const double* sums() const { return tree_.nodes.level[level_].sums; }

  template <bool kMany>
  void visit(const Boxes& boxes, const Range& range) {
    const VF least = least_distances(boxes, at_, at_), most = most_distances(boxes, at_);
    if (kMany) {
      visit_for_many(boxes, least, most, range);
    } else {
      visit_for_one(boxes, least, most);
    }
  }

  void visit_for_one(const Boxes& boxes, VF least, VF most) {
    Gathering<Real>& ball = query_.balls[0];
    const unsigned met = at_most(least, ball.out_sq), in = at_most(most, ball.in_sq) & met;
    const int shift = 3 * (level_ + 1);
    ball.faces += std::uint64_t{let_whole_wait(ball, sums(), boxes.names, in)} << shift;
    count_less(ball, boxes.names, in);
    store(visits_.nodes[now_] + found_, Compression<VF>(met & ~in)(boxes.names));
    found_ += static_cast<unsigned>(__builtin_popcount(met & ~in));
  }

  /// Takes back what was counted too much if the last node is among those inside.
  void count_less(Gathering<Real>& ball, VF names, unsigned in) const {
    const auto last = static_cast<int>(tree_.nodes.level[level_].nodes - 1);
    const MF is_last = reinterpret_cast<MF>(names) == MF{last, last, last, last, last, last, last, last};
    if (bits(is_last) & in) ball.faces -= missing_in_last(tree_.nodes, level_);
  }

  /// Radii that hold a node whole or do not reach it narrow those for which it is opened.
  void visit_for_many(const Boxes& boxes, VF least_of, VF most_of, const Range& range) {
    float least[kWidth], most[kWidth];
    std::uint32_t names[kWidth];
    store(least, least_of);
    store(most, most_of);
    store(names, boxes.names);
    for (unsigned rest = at_most(least_of, query_.balls[range.last - 1].out_sq); rest != 0; rest &= rest - 1) {
      const int i = __builtin_ctz(rest);
      int first = range.first, last = range.last;
      while (first < last && least[i] > query_.balls[first].out_sq) ++first;
      while (first < last && most[i] <= query_.balls[last - 1].in_sq) add_node(names[i], --last);
      if (first == last) continue;
      visits_.nodes[now_][found_] = names[i];
      visits_.ranges[now_][found_++] = {first, last};
    }
  }

  void add_node(std::uint32_t node, int radius) const {
    const bool last = node + std::size_t{1} == tree_.nodes.level[level_].nodes;
    const std::uint64_t faces = std::uint64_t{1} << 3 * (level_ + 1);
    add_whole(query_.balls[radius], sums(), node, last ? faces - missing_in_last(tree_.nodes, level_) : faces);
  }

  /// Adds what waits: names of another level come next.
  void finish_level() const {
    for (int radius = 0; radius < query_.count; ++radius) add_waiting(query_.balls[radius], sums());
  }

  Rim<Real> rim_of(int radius) const { return {tree_.triangles, query_, radius, query_.balls[radius]}; }

  template <bool kMany>
  void add_leaves(int count) {
    constexpr int kTogether = Leaves<Real, kMoments>::kTogether;
    const std::uint32_t* const leaves = visits_.nodes[now_];
    for (int first = 0; first < count; first += kTogether) {
      const int end = first + kTogether < count ? first + kTogether : count;
      for (int next = end; next < end + kTogether && next < count; ++next) prefetch_leaf(leaves[next]);
      if (kMany) {
        const auto rims = [&](int radius) { return rim_of(radius); };
        leaves_.add(leaves + first, end - first, rims, query_.count, visits_.ranges[now_] + first);
      } else {
        leaves_.add(leaves + first, end - first, rim_of(0));
      }
    }
  }

  const TreeView<Real>& tree_;
  const BallQuery<Real>& query_;
  const Visits& visits_;
  Place place_;
  Leaves<Real, kMoments> leaves_;
  float at_[3];
  int level_;              ///< of the nodes that are looked at
  int now_ = 0;            ///< which list they are found in
  std::size_t found_ = 0;  ///< nodes of the level that are to be opened
};

/// Adds the measures of triangles that wait with them.
inline void add_whole_triangles(const Rim<double>& rim) {
  add_waiting(rim.ball, rim.triangles.measures);
}
inline void add_whole_triangles(const Rim<float>&) {}

template <class Real, bool kMoments>
void run_walk(const TreeView<Real>& tree, const BallQuery<Real>& query, const Visits& visits) {
  Walk<Real, kMoments> walk(tree, query, visits);
  if (query.count == 1) {
    walk.template run<false>();
  } else {
    walk.template run<true>();
  }
  for (int radius = 0; radius < query.count; ++radius) {
    const Rim<Real> rim = {tree.triangles, query, radius, query.balls[radius]};
    add_all_waiting<kMoments>(rim);
    add_whole_triangles(rim);
  }
}

template <class Real>
void run_query(const TreeView<Real>& tree, const BallQuery<Real>& query, const Visits& visits) {
  if (query.exact_density) {
    run_walk<Real, true>(tree, query, visits);
  } else {
    run_walk<Real, false>(tree, query, visits);
  }
}

}  // namespace
}  // namespace kappa::kernels
