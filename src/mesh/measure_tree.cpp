// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/measure_tree.hpp"

#include <algorithm>
#include <cmath>

#include "../core/large_array.hpp"
#include "ball_workspace.hpp"
#include "measure_tree_order.hpp"

namespace kappa {
namespace {

using kernels::BoxBlock;
using kernels::kWidth;
using kernels::Leaf;
using kernels::TreeView;

constexpr std::size_t kBlock = 64;
constexpr std::size_t kTogether = 16;  ///< queries that share the way to where they start

/// The triangles in the order of the tree.
MeasuredTriangles in_order(MeasuredTriangles t) {
  const std::vector<Index> order = tree_order(t);
  const auto apply = [&](auto& values) {
    if (values.empty()) return;
    std::decay_t<decltype(values)> sorted;
    reserve_large(sorted, values.size());
    for (const Index i : order) sorted.push_back(values[i]);
    values = std::move(sorted);
  };
  apply(t.corners);
  apply(t.weights);
  apply(t.measures);
  apply(t.beside);
  apply(t.faces);
  return t;
}

/// Unit and origin of the boxes: floats in [-1, 1], whatever the units of the data.
struct BoxFrame {
  Vec3 middle = Vec3::Zero();
  double unit = 1;

  BoxFrame() = default;
  explicit BoxFrame(const MeasuredTriangles& t) {
    Bounds b;
    for (const auto& corners : t.corners) {
      for (const Index v : corners) {
        b.min = b.min.cwiseMin(t.x[v]);
        b.max = b.max.cwiseMax(t.x[v]);
      }
    }
    if (b.empty()) return;
    middle = b.min / 2 + b.max / 2;
    const double half = (b.max / 2 - b.min / 2).maxCoeff();
    if (half > 0 && std::isfinite(1 / half)) unit = 1 / half;
  }

  Vec3 placed(const Vec3& x) const { return (x - middle) * unit; }
};

float rounded_down(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) <= v ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}

float rounded_up(double v) {
  return -rounded_down(-v);
}

BoxBlock empty_block() {
  BoxBlock block;
  std::fill_n(&block.lo[0][0], 3 * kWidth, std::numeric_limits<float>::infinity());
  std::fill_n(&block.hi[0][0], 3 * kWidth, -std::numeric_limits<float>::infinity());
  return block;
}

/// Boxes and sums of the nodes of one level.
struct LevelData {
  std::vector<BoxBlock> boxes;
  std::vector<MeasureSum> sums;

  explicit LevelData(std::size_t nodes)
      : boxes(large_vector((nodes + kWidth - 1) / kWidth, empty_block())), sums(large_vector<MeasureSum>(nodes)) {}

  void extend(std::size_t node, int axis, float lo, float hi) {
    BoxBlock& block = boxes[node / kWidth];
    float &to_lo = block.lo[axis][node % kWidth], &to_hi = block.hi[axis][node % kWidth];
    to_lo = std::min(to_lo, lo);
    to_hi = std::max(to_hi, hi);
  }
};

/// Bounds of the corners of a leaf's triangles.
Bounds bounds_of_leaf(const MeasuredTriangles& t, std::size_t leaf) {
  Bounds b;
  for (std::size_t i = kWidth * leaf; i < std::min(t.size(), kWidth * (leaf + 1)); ++i) {
    for (const Index v : t.corners[i]) {
      b.min = b.min.cwiseMin(t.x[v]);
      b.max = b.max.cwiseMax(t.x[v]);
    }
  }
  return b;
}

LevelData leaf_level(const MeasuredTriangles& t, const BoxFrame& frame) {
  LevelData level((t.size() + kWidth - 1) / kWidth);
  for (std::size_t leaf = 0; leaf < level.sums.size(); ++leaf) {
    for (std::size_t i = kWidth * leaf; i < std::min(t.size(), kWidth * (leaf + 1)); ++i)
      level.sums[leaf] += t.measures[i];
    const Bounds b = bounds_of_leaf(t, leaf);
    const Vec3 lo = frame.placed(b.min), hi = frame.placed(b.max);
    for (int axis = 0; axis < 3; ++axis) level.extend(leaf, axis, rounded_down(lo[axis]), rounded_up(hi[axis]));
  }
  return level;
}

LevelData parent_level(const LevelData& below) {
  LevelData level(below.boxes.size());
  for (std::size_t child = 0; child < below.sums.size(); ++child) {
    const std::size_t node = child / kWidth, lane = child % kWidth;
    level.sums[node] += below.sums[child];
    const BoxBlock& block = below.boxes[node];
    for (int axis = 0; axis < 3; ++axis) level.extend(node, axis, block.lo[axis][lane], block.hi[axis][lane]);
  }
  return level;
}

std::vector<LevelData> make_levels(const MeasuredTriangles& t, const BoxFrame& frame) {
  std::vector<LevelData> levels;
  if (t.size() == 0) return levels;
  levels.push_back(leaf_level(t, frame));
  while (levels.back().boxes.size() > 1) levels.push_back(parent_level(levels.back()));
  return levels;
}

/// Squared length of the longest edge of a leaf's triangles.
double longest_edge_sq(const MeasuredTriangles& t, std::size_t leaf) {
  double longest_sq = 0;
  for (std::size_t i = kWidth * leaf; i < std::min(t.size(), kWidth * (leaf + 1)); ++i) {
    const auto& c = t.corners[i];
    for (std::size_t k = 0; k < 3; ++k)
      longest_sq = std::max(longest_sq, (t.x[c[k]] - t.x[c[(k + 1) % 3]]).squaredNorm());
  }
  return longest_sq;
}

/// Calls `set(row, lane, coordinate)` for the corners of a leaf, coordinates from its origin in the unit of the tree.
template <class Set>
void for_corners(const MeasuredTriangles& t, std::size_t leaf, const BoxFrame& frame, const double* origin,
                 const Set& set) {
  for (std::size_t lane = 0; lane < std::min<std::size_t>(kWidth, t.size() - kWidth * leaf); ++lane) {
    const auto& corners = t.corners[kWidth * leaf + lane];
    for (std::size_t row = 0; row < 9; ++row) {
      const auto axis = static_cast<Eigen::Index>(row % 3);
      set(row, lane, (t.x[corners[row / 3]][axis] - frame.middle[axis]) * frame.unit - origin[axis]);
    }
  }
}

/// The steps reach from the middle of the leaf to its farthest side; they are not so small that squares overflow.
void fill_corners(const MeasuredTriangles& t, std::size_t number, const BoxFrame& frame, double half,
                  Leaf<double>& leaf) {
  constexpr double kSteps = 32767, kMostAUnit = 1e12;
  leaf.steps_a_unit = static_cast<float>(half * kMostAUnit > kSteps ? kSteps / half : kMostAUnit);
  for_corners(t, number, frame, leaf.origin, [&](std::size_t row, std::size_t lane, double x) {
    leaf.x[row][lane] = static_cast<std::int16_t>(std::lrint(x * static_cast<double>(leaf.steps_a_unit)));
  });
  // Corners are off by less than a step: as far away as an edge is long, that much more in the squared distance.
  const double longest = std::sqrt(longest_edge_sq(t, number)) * frame.unit * static_cast<double>(leaf.steps_a_unit);
  leaf.third_of_longest_sq = rounded_up((longest / 3 + 2) * longest);
}

void fill_corners(const MeasuredTriangles& t, std::size_t number, const BoxFrame& frame, double half,
                  Leaf<float>& leaf) {
  constexpr double kRounding = 1e-5;  // of the squared distances of corners from balls smaller than the leaf
  std::fill_n(&leaf.x[0][0], 9 * kWidth, std::numeric_limits<float>::infinity());
  for_corners(t, number, frame, leaf.origin,
              [&](std::size_t row, std::size_t lane, double x) { leaf.x[row][lane] = static_cast<float>(x); });
  const double longest = std::sqrt(longest_edge_sq(t, number)) * frame.unit;
  leaf.third_of_longest_sq = rounded_up(longest * longest / 3 + kRounding * half * half);
}

template <class Real>
std::vector<Leaf<Real>> make_leaves(const MeasuredTriangles& t, const BoxFrame& frame) {
  auto leaves = large_vector<Leaf<Real>>((t.size() + kWidth - 1) / kWidth);
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const Bounds b = bounds_of_leaf(t, i);
    const Vec3 lo = frame.placed(b.min), hi = frame.placed(b.max), origin = (lo + hi) / 2;
    std::copy_n(origin.data(), 3, leaves[i].origin);
    fill_corners(t, i, frame, ((hi - lo) / 2).maxCoeff(), leaves[i]);
  }
  return leaves;
}

/// What a tree in floats keeps of the measures of whole triangles.
std::vector<float> float_measures(const MeasuredTriangles& t) {
  std::vector<float> floats;
  reserve_large(floats, kernels::kSums * t.size());
  for (const MeasureSum& m : t.measures) {
    for (const double v : {m.area, m.mu0, m.mu2}) floats.push_back(static_cast<float>(v));
    for (const double v : m.mu_sym) floats.push_back(static_cast<float>(v));
  }
  return floats;
}

template <class Real>
auto query_of(const kernels::Table& table) {
  if constexpr (std::is_same_v<Real, double>) {
    return table.query_double;
  } else {
    return table.query_float;
  }
}

/// What the walks of one thread need.
class WalkSpace {
 public:
  WalkSpace(std::size_t leaves, std::size_t radii) {
    const std::size_t room = leaves + 2 * kWidth;
    for (int list = 0; list < 2; ++list) {
      // Left as they are, for most of the room is never touched.
      nodes_[list].reset(new std::uint32_t[room]);
      if (radii > 1) ranges_[list].reset(new kernels::Range[room]);
      visits.nodes[list] = nodes_[list].get();
      visits.ranges[list] = ranges_[list].get();
    }
  }

  kernels::Visits visits{};

 private:
  std::unique_ptr<std::uint32_t[]> nodes_[2];
  std::unique_ptr<kernels::Range[]> ranges_[2];
};

/// Bounds of the centres [begin, end) in an order.
Bounds bounds_of(const std::vector<Vec3>& centres, const std::vector<Index>& order, std::size_t begin,
                 std::size_t end) {
  Bounds b;
  for (std::size_t i = begin; i < end; ++i) {
    if (!is_finite(centres[order[i]])) continue;
    b.min = b.min.cwiseMin(centres[order[i]]);
    b.max = b.max.cwiseMax(centres[order[i]]);
  }
  return b;
}

/// The tree with leaves of one precision, over triangles in its order.
template <class Real>
class Hierarchy {
 public:
  explicit Hierarchy(const MeasuredTriangles& t)
      : frame_(t), levels_(make_levels(t, frame_)), leaves_(make_leaves<Real>(t, frame_)) {}

  std::size_t bytes() const {
    std::size_t total = leaves_.capacity() * sizeof(Leaf<Real>);
    for (const LevelData& level : levels_)
      total += level.boxes.capacity() * sizeof(BoxBlock) + level.sums.capacity() * sizeof(MeasureSum);
    return total;
  }

  void sum(const MeasuredTriangles& t, const kernels::TriangleView& triangles, const kernels::Table& table,
           const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
           const Execution& run, const BallSum::Sink& sink) const {
    const TreeView<Real> tree = view(triangles);
    const SortedRadii sorted(radii);
    const std::vector<Index> order = spatial_order(centres);
    auto spaces = workspaces<Real>(t, sorted, ball, run);
    std::vector<WalkSpace> walks;
    for (std::size_t i = 0; i < spaces.size(); ++i) walks.emplace_back(leaves_.size(), radii.size());
    parallel_for(centres.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int worker) {
      BallWorkspace<Real>& space = spaces[static_cast<std::size_t>(worker)];
      WalkSpace& walk = walks[static_cast<std::size_t>(worker)];
      for (std::size_t i = begin; i < end; ++i) {
        if ((i - begin) % kTogether == 0) {
          const Bounds around = bounds_of(centres, order, i, std::min(end, i + kTogether));
          table.approach(tree.nodes, around.min.data(), around.max.data(), sorted.radii.back(), walk.visits.start);
        }
        sink(order[i], space.measure(centres[order[i]],
                                     [&](const auto& query) { query_of<Real>(table)(tree, query, walk.visits); }));
      }
    });
  }

 private:
  TreeView<Real> view(const kernels::TriangleView& triangles) const {
    TreeView<Real> v{};
    v.triangles = triangles;
    v.nodes.triangles = triangles.count;
    v.nodes.levels = static_cast<int>(levels_.size());
    for (std::size_t i = 0; i < levels_.size(); ++i)
      v.nodes.level[i] = {levels_[i].boxes.data(), &levels_[i].sums[0].area, levels_[i].sums.size()};
    std::copy_n(frame_.middle.data(), 3, v.nodes.middle);
    v.nodes.unit = frame_.unit;
    v.leaves = leaves_.data();
    return v;
  }

  BoxFrame frame_;
  std::vector<LevelData> levels_;
  std::vector<Leaf<Real>> leaves_;
};

}  // namespace

struct MeasureTree::Impl {
  MeasuredTriangles triangles;
  std::vector<float> measures;  ///< in floats, instead of those of `triangles`
  const kernels::Table& table;
  std::unique_ptr<const Hierarchy<double>> in_double;
  std::unique_ptr<const Hierarchy<float>> in_float;
  kernels::TriangleView view;

  Impl(MeasuredTriangles measured, Precision precision, const kernels::Table& kernels)
      : triangles(in_order(std::move(measured))), table(kernels) {
    if (precision == Precision::Double) {
      in_double = std::make_unique<Hierarchy<double>>(triangles);
    } else {
      measures = float_measures(triangles);
      in_float = std::make_unique<Hierarchy<float>>(triangles);
      std::vector<MeasureSum>().swap(triangles.measures);
    }
    view = view_of(triangles);
    view.float_measures = measures.data();
  }
};

MeasureTree::MeasureTree(MeasuredTriangles triangles, Precision precision)
    : MeasureTree(std::move(triangles), precision, kernels::best_table()) {}

MeasureTree::MeasureTree(MeasuredTriangles triangles, Precision precision, const kernels::Table& table)
    : impl_(std::make_unique<Impl>(std::move(triangles), precision, table)) {}

MeasureTree::~MeasureTree() = default;

const MeasuredTriangles& MeasureTree::triangles() const {
  return impl_->triangles;
}

std::size_t MeasureTree::bytes() const {
  const std::size_t of_tree = impl_->in_double ? impl_->in_double->bytes() : impl_->in_float->bytes();
  return of_tree + impl_->measures.capacity() * sizeof(float);
}

void MeasureTree::do_sum(const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
                         const Execution& run, const Sink& sink) const {
  if (radii.empty()) return;
  const auto sum = [&](const auto& tree) {
    tree.sum(impl_->triangles, impl_->view, impl_->table, centres, radii, ball, run, sink);
  };
  if (impl_->in_double) {
    sum(*impl_->in_double);
  } else {
    sum(*impl_->in_float);
  }
}

}  // namespace kappa
