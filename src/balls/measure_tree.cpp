// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/balls/measure_tree.hpp"

#include <algorithm>

#include "ball_workspace.hpp"
#include "core/large_array.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/spatial_order.hpp"
#include "measure_tree_nodes.hpp"
#include "measure_tree_order.hpp"
#include "whole_measures.hpp"

namespace kappa {
namespace {

using kernels::BoxBlock;
using kernels::kWidth;
using kernels::Leaf;
using kernels::TreeView;

constexpr std::size_t kBlock = 64;
constexpr std::size_t kTogether = 16;  ///< queries that share the way to where they start

/// The triangles in the order of the tree.
Triangles in_order(Triangles t, const Execution& run) {
  const std::vector<Index> order = tree_order(t, stage(run, 0.0, 0.0));
  const auto put_in_order = [&](auto& values) {
    if (values.empty()) return;
    std::decay_t<decltype(values)> sorted;
    reserve_large(sorted, values.size());
    for (const Index i : order) sorted.push_back(values[i]);
    values = std::move(sorted);
  };
  const std::function<void()> arrays[] = {[&] { put_in_order(t.corners); }, [&] { put_in_order(t.weights); },
                                          [&] { put_in_order(t.faces); }, [&] { put_in_order(t.beside); }};
  parallel_for(std::size(arrays), 1, stage(run, 0.8, 0.8), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) arrays[i]();
  });
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
std::vector<SharedWalk> shared_walks(const SortedRadii& all, double mean_area) {
  constexpr double kMostFaces = 400;
  std::vector<SharedWalk> walks;
  const std::size_t count = all.radii.size();
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    const auto small = [&](double radius) { return kPi * radius * radius <= kMostFaces * mean_area; };
    for (++last; last < count && small(all.radii[last]);) ++last;
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
  /// `walks`: the most that a centre has; `shared`: whether one may serve several radii.
  WalkSpace(const Triangles& t, const std::vector<MeasureSum>& measures, std::size_t leaves, std::size_t walks,
            BallDefinition ball, bool shared) {
    const std::size_t room = leaves + 2 * kWidth;
    for (int list = 0; list < 2; ++list) {
      // Left as they are, for most of the room is never touched.
      nodes_[list].reset(new std::uint32_t[room]);
      if (shared) ranges_[list].reset(new kernels::Range[room]);
      visits.nodes[list] = nodes_[list].get();
      visits.ranges[list] = ranges_[list].get();
    }
    for (std::size_t walk = 0; walk < walks; ++walk) balls.emplace_back(t, measures, ball);
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
  Hierarchy(const Triangles& t, std::vector<MeasureSum>& measures, const Execution& run)
      : triangles_(t.size()),
        frame_(t, stage(run, 0.0, 0.0)),
        levels_(make_levels(t, measures, frame_, stage(run, 0.0, 0.0))) {
    if (std::is_same_v<Real, float>) std::vector<MeasureSum>().swap(measures);
    leaves_ = make_leaves<Real>(t, frame_, run);
  }

  std::size_t bytes() const {
    std::size_t total = leaves_.capacity() * sizeof(Leaf<Real>);
    for (const LevelData& level : levels_)
      total += level.boxes.capacity() * sizeof(BoxBlock) + level.sums.capacity() * sizeof(MeasureSum);
    return total;
  }

  std::size_t leaves() const { return leaves_.size(); }

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

 private:
  std::size_t triangles_;
  BoxFrame frame_;
  std::vector<LevelData> levels_;
  std::vector<Leaf<Real>> leaves_;
};

/// Sums over one tree for one call.
template <class Real>
class Summing {
 public:
  using Space = WalkSpace<Real>;

  Summing(const Hierarchy<Real>& hierarchy, const kernels::TriangleView& triangles, const kernels::Table& table,
          const std::vector<Vec3>& centres)
      : tree_(hierarchy.view(triangles)), mean_area_(hierarchy.mean_area()), table_(table), centres_(centres) {}

  /// Balls of the same radii around all centres, in `order`.
  void sum_common(const BallRadii& radii, const std::vector<Index>& order,
                  const std::function<Space(std::size_t)>& make, const Execution& run,
                  const BallSum::Sink& sink) const {
    const std::vector<SharedWalk> walks = shared_walks(SortedRadii(radii.of(0), radii.count()), mean_area_);
    std::vector<Space> spaces = spaces_for(walks.size(), make, run);
    for (Space& space : spaces) {
      for (std::size_t w = 0; w < walks.size(); ++w) space.balls[w].use(walks[w].radii);
    }
    parallel_for(order.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int worker) {
      Space& space = spaces[static_cast<std::size_t>(worker)];
      space.sums.resize((end - begin) * radii.count());
      // Walk by walk, so that what balls of one size need stays at hand.
      for (std::size_t w = 0; w < walks.size(); ++w) {
        for (std::size_t i = begin; i < end; ++i) {
          if ((i - begin) % kTogether == 0) approach(order, i, std::min(end, i + kTogether), walks[w], space);
          walk(order[i], walks[w], space.balls[w], space, &space.sums[(i - begin) * radii.count()]);
        }
      }
      for (std::size_t i = begin; i < end; ++i) sink(order[i], &space.sums[(i - begin) * radii.count()]);
    });
  }

  /// Balls of own radii around each centre, in `order`.
  void sum_own(const BallRadii& radii, const std::vector<Index>& order, const std::function<Space(std::size_t)>& make,
               const Execution& run, const BallSum::Sink& sink) const {
    std::vector<Space> spaces = spaces_for(1, make, run);
    parallel_for(order.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int worker) {
      Space& space = spaces[static_cast<std::size_t>(worker)];
      for (std::size_t i = begin; i < end; ++i) {
        space.sums.assign(radii.count(), {});
        const std::vector<SharedWalk> walks = own_walks(radii.of(order[i]), radii.count());
        for (const SharedWalk& w : walks) {
          space.balls[0].use(w.radii);
          approach(order, i, i + 1, w, space);
          walk(order[i], w, space.balls[0], space, space.sums.data());
        }
        sink(order[i], space.sums.data());
      }
    });
  }

 private:
  static std::vector<Space> spaces_for(std::size_t walks, const std::function<Space(std::size_t)>& make,
                                       const Execution& run) {
    std::vector<Space> spaces;
    spaces.reserve(static_cast<std::size_t>(thread_count(run)));
    for (int i = 0; i < thread_count(run); ++i) spaces.push_back(make(walks));
    return spaces;
  }

  /// The walks of a centre for its radii other than 0.
  std::vector<SharedWalk> own_walks(const double* radii, std::size_t count) const {
    std::vector<std::size_t> places;
    std::vector<double> positive;
    for (std::size_t r = 0; r < count; ++r) {
      if (radii[r] == 0) continue;
      places.push_back(r);
      positive.push_back(radii[r]);
    }
    std::vector<SharedWalk> walks = shared_walks(SortedRadii(positive), mean_area_);
    for (SharedWalk& w : walks) {
      for (std::size_t& place : w.places) place = places[place];
    }
    return walks;
  }

  /// Finds where the queries [begin, end) of an order start.
  void approach(const std::vector<Index>& order, std::size_t begin, std::size_t end, const SharedWalk& walk,
                Space& space) const {
    const Bounds around = bounds_of(centres_, order, begin, end);
    table_.approach(tree_.nodes, around.min.data(), around.max.data(), walk.radii.radii.back(), space.visits.start);
  }

  void walk(Index query, const SharedWalk& walk, BallWorkspace<Real>& balls, Space& space, BallMeasures* to) const {
    const BallMeasures* const got =
        balls.measure(centres_[query], [&](const auto& asked) { query_of<Real>(table_)(tree_, asked, space.visits); });
    for (std::size_t k = 0; k < walk.places.size(); ++k) to[walk.places[k]] = got[k];
  }

  TreeView<Real> tree_;
  double mean_area_;
  const kernels::Table& table_;
  const std::vector<Vec3>& centres_;
};

}  // namespace

struct MeasureTree::Impl {
  Triangles triangles;
  std::vector<MeasureSum> measures;  ///< of the triangles; empty in fast
  const kernels::Table& table;
  std::unique_ptr<const Hierarchy<double>> in_double;
  std::unique_ptr<const Hierarchy<float>> in_float;
  kernels::TriangleView view;

  Impl(Triangles given, Precision precision, const kernels::Table& kernels, const Execution& run)
      : triangles(in_order(std::move(given), stage(run, 0.0, 0.6))),
        measures(measure_triangles(triangles, kernels, stage(run, 0.6, 0.7))),
        table(kernels) {
    const Execution last = stage(run, 0.7, 1.0);
    if (precision == Precision::Double) {
      in_double = std::make_unique<Hierarchy<double>>(triangles, measures, last);
    } else {
      in_float = std::make_unique<Hierarchy<float>>(triangles, measures, last);
    }
    view = view_of(triangles, measures);
  }

  template <class Real>
  void sum(const Hierarchy<Real>& tree, const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball,
           const Execution& run, const Sink& sink) const {
    const Summing<Real> summing(tree, view, table, centres);
    const std::vector<Index> order = spatial_order(centres, stage(run, 0.0, 0.0));
    const auto make = [&](std::size_t walks) {
      return WalkSpace<Real>(triangles, measures, tree.leaves(), walks, ball, radii.count() > 1);
    };
    if (radii.are_common()) {
      summing.sum_common(radii, order, make, run, sink);
    } else {
      summing.sum_own(radii, order, make, run, sink);
    }
  }
};

MeasureTree::MeasureTree(Triangles triangles, Precision precision, const Execution& run)
    : MeasureTree(std::move(triangles), precision, kernels::best_table(), run) {}

MeasureTree::MeasureTree(Triangles triangles, Precision precision, const kernels::Table& table, const Execution& run)
    : impl_(std::make_unique<Impl>(std::move(triangles), precision, table, run)) {}

MeasureTree::~MeasureTree() = default;

const Triangles& MeasureTree::triangles() const {
  return impl_->triangles;
}

MeasureSum MeasureTree::measures_of(std::size_t triangle) const {
  return impl_->measures.empty() ? kappa::measures_of(impl_->triangles, triangle) : impl_->measures[triangle];
}

std::size_t MeasureTree::bytes() const {
  const std::size_t measures = impl_->measures.capacity() * sizeof(MeasureSum);
  return measures + (impl_->in_double ? impl_->in_double->bytes() : impl_->in_float->bytes());
}

void MeasureTree::do_sum(const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball,
                         const Execution& run, const Sink& sink) const {
  if (impl_->in_double) {
    impl_->sum(*impl_->in_double, centres, radii, ball, run, sink);
  } else {
    impl_->sum(*impl_->in_float, centres, radii, ball, run, sink);
  }
}

}  // namespace kappa
