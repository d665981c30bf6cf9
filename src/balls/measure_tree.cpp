// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/balls/measure_tree.hpp"

#include <algorithm>

#include "ball_workspace.hpp"
#include "core/large_array.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/spatial_order.hpp"
#include "measure_tree_nodes.hpp"
#include "measure_tree_order.hpp"

namespace kappa {
namespace {

using kernels::BoxBlock;
using kernels::kWidth;
using kernels::Leaf;
using kernels::TreeView;

constexpr std::size_t kBlock = 64;
constexpr std::size_t kTogether = 16;  ///< queries that share the way to where they start

/// The triangles in the order of the tree. Where their measures follow from the rest they are computed anew in their
/// place: a second array of them would be the largest thing that a run ever holds, and takes longer to fill.
MeasuredTriangles in_order(MeasuredTriangles t, const kernels::Table& table, const Execution& run) {
  const std::vector<Index> order = tree_order(t, stage(run, 0.0, 0.0));
  const auto put_in_order = [&](auto& values) {
    if (values.empty()) return;
    std::decay_t<decltype(values)> sorted;
    reserve_large(sorted, values.size());
    for (const Index i : order) sorted.push_back(values[i]);
    values = std::move(sorted);
  };
  const bool keeps_measures = !t.beside.empty();
  const std::function<void()> arrays[] = {[&] { put_in_order(t.corners); }, [&] { put_in_order(t.weights); },
                                          [&] { put_in_order(t.faces); }, [&] { put_in_order(t.beside); },
                                          [&] {
                                            if (keeps_measures) put_in_order(t.measures);
                                          }};
  parallel_for(std::size(arrays), 1, stage(run, 0.6, 0.6), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) arrays[i]();
  });
  if (!keeps_measures) measure_all(t, table, stage(run, 0.6, 0.7));
  return t;
}

template <class Real>
auto query_of(const kernels::Table& table) {
  if constexpr (std::is_same_v<Real, double>) {
    return table.query_double;
  } else {
    return table.query_float;
  }
}

/// Radii that are served by one walk, and where they stood among those given.
struct SharedWalk {
  std::vector<std::size_t> places;
  SortedRadii radii;
};

/// Small balls around one centre open mostly the same leaves. Larger ones share little more than the way to them, which
/// costs less than telling them apart: those have a walk each.
std::vector<SharedWalk> shared_walks(const std::vector<double>& radii, double mean_area) {
  constexpr double kMostFaces = 400;
  const SortedRadii all(radii);
  std::vector<SharedWalk> walks;
  for (std::size_t first = 0, last = 0; first < radii.size(); first = last) {
    const auto small = [&](double radius) { return kPi * radius * radius <= kMostFaces * mean_area; };
    for (++last; last < radii.size() && small(all.radii[last]);) ++last;
    const auto part = [&](const auto& of) {
      return std::decay_t<decltype(of)>(of.begin() + static_cast<std::ptrdiff_t>(first),
                                        of.begin() + static_cast<std::ptrdiff_t>(last));
    };
    walks.push_back({part(all.given), SortedRadii(part(all.radii))});
  }
  return walks;
}

/// What one thread needs.
template <class Real>
class WalkSpace {
 public:
  WalkSpace(const MeasuredTriangles& t, std::size_t leaves, const std::vector<SharedWalk>& walks, BallDefinition ball) {
    const std::size_t room = leaves + 2 * kWidth;
    const bool shared = std::any_of(walks.begin(), walks.end(), [](const auto& w) { return w.places.size() > 1; });
    for (int list = 0; list < 2; ++list) {
      // Left as they are, for most of the room is never touched.
      nodes_[list].reset(new std::uint32_t[room]);
      if (shared) ranges_[list].reset(new kernels::Range[room]);
      visits.nodes[list] = nodes_[list].get();
      visits.ranges[list] = ranges_[list].get();
    }
    for (const SharedWalk& walk : walks) balls.emplace_back(t, walk.radii, ball);
  }

  kernels::Visits visits{};
  std::vector<BallWorkspace<Real>> balls;  ///< of each walk
  std::vector<BallMeasures> sums;          ///< of a block of queries, a ball a radius each

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
  /// In floats it takes the measures away: those of whole nodes stand in their sums, and the leaves have all the rest.
  Hierarchy(MeasuredTriangles& t, const Execution& run)
      : triangles_(t.size()), frame_(t, stage(run, 0.0, 0.0)), levels_(make_levels(t, frame_, stage(run, 0.0, 0.0))) {
    if (std::is_same_v<Real, float>) std::vector<MeasureSum>().swap(t.measures);
    leaves_ = make_leaves<Real>(t, frame_, run);
  }

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
    const std::vector<SharedWalk> walks = shared_walks(radii, mean_area());
    const std::vector<Index> order = spatial_order(centres, stage(run, 0.0, 0.0));
    std::vector<WalkSpace<Real>> spaces;
    spaces.reserve(static_cast<std::size_t>(thread_count(run)));
    for (int i = 0; i < thread_count(run); ++i) spaces.emplace_back(t, leaves_.size(), walks, ball);
    parallel_for(centres.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int worker) {
      WalkSpace<Real>& space = spaces[static_cast<std::size_t>(worker)];
      space.sums.resize((end - begin) * radii.size());
      // Walk by walk, so that what balls of one size need stays at hand.
      for (std::size_t w = 0; w < walks.size(); ++w) {
        for (std::size_t i = begin; i < end; ++i) {
          if ((i - begin) % kTogether == 0) {
            const Bounds around = bounds_of(centres, order, i, std::min(end, i + kTogether));
            table.approach(tree.nodes, around.min.data(), around.max.data(), walks[w].radii.radii.back(),
                           space.visits.start);
          }
          const BallMeasures* const got = space.balls[w].measure(
              centres[order[i]], [&](const auto& query) { query_of<Real>(table)(tree, query, space.visits); });
          for (std::size_t k = 0; k < walks[w].places.size(); ++k)
            space.sums[(i - begin) * radii.size() + walks[w].places[k]] = got[k];
        }
      }
      for (std::size_t i = begin; i < end; ++i) sink(order[i], &space.sums[(i - begin) * radii.size()]);
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

  double mean_area() const {
    MeasureSum all;
    if (!levels_.empty()) {
      for (const MeasureSum& sum : levels_.back().sums) all += sum;
    }
    return all.area / static_cast<double>(std::max<std::size_t>(triangles_, 1));
  }

  std::size_t triangles_;
  BoxFrame frame_;
  std::vector<LevelData> levels_;
  std::vector<Leaf<Real>> leaves_;
};

}  // namespace

struct MeasureTree::Impl {
  MeasuredTriangles triangles;
  const kernels::Table& table;
  std::unique_ptr<const Hierarchy<double>> in_double;
  std::unique_ptr<const Hierarchy<float>> in_float;
  kernels::TriangleView view;

  Impl(MeasuredTriangles measured, Precision precision, const kernels::Table& kernels, const Execution& run)
      : triangles(in_order(std::move(measured), kernels, run)), table(kernels) {
    const Execution last = stage(run, 0.7, 1.0);
    if (precision == Precision::Double) {
      in_double = std::make_unique<Hierarchy<double>>(triangles, last);
    } else {
      in_float = std::make_unique<Hierarchy<float>>(triangles, last);
    }
    view = view_of(triangles);
  }
};

MeasureTree::MeasureTree(MeasuredTriangles triangles, Precision precision, const Execution& run)
    : MeasureTree(std::move(triangles), precision, kernels::best_table(), run) {}

MeasureTree::MeasureTree(MeasuredTriangles triangles, Precision precision, const kernels::Table& table,
                         const Execution& run)
    : impl_(std::make_unique<Impl>(std::move(triangles), precision, table, run)) {}

MeasureTree::~MeasureTree() = default;

const MeasuredTriangles& MeasureTree::triangles() const {
  return impl_->triangles;
}

std::size_t MeasureTree::bytes() const {
  return impl_->in_double ? impl_->in_double->bytes() : impl_->in_float->bytes();
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
