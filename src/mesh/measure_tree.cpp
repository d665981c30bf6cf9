// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/mesh/measure_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/tree_view.hpp"
#include "measure_tree_order.hpp"

namespace kappa {
namespace {

using kernels::BallAccumulator;
using kernels::BallQuery;
using kernels::BoxBlock;
using kernels::kSums;
using kernels::kWidth;
using kernels::Leaf;
using kernels::TreeView;

constexpr std::size_t kBlock = 64;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

static_assert(sizeof(MeasureSum) == kSums * sizeof(double), "kernels add a MeasureSum as 9 doubles");
static_assert(sizeof(std::array<Index, 3>) == 3 * sizeof(std::uint32_t) && sizeof(Vec3) == 3 * sizeof(double),
              "kernels read corners and normals as plain arrays");

bool has_avx2() {
#if defined(KAPPA_AVX2_KERNELS)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

template <class Real>
using Query = void (*)(const TreeView<Real>&, const BallQuery&);

template <class Real>
Query<Real> best_query() {
#if defined(KAPPA_AVX2_KERNELS)
  if (has_avx2()) return static_cast<Query<Real>>(kernels::query_avx2);
#endif
  return static_cast<Query<Real>>(kernels::query_baseline);
}

BoxBlock empty_block() {
  BoxBlock block;
  std::fill_n(&block.lo[0][0], 3 * kWidth, kInfinity);
  std::fill_n(&block.hi[0][0], 3 * kWidth, -kInfinity);
  return block;
}

/// Boxes and sums of the nodes of one level.
struct LevelData {
  std::vector<BoxBlock> boxes;
  std::vector<MeasureSum> sums;

  explicit LevelData(std::size_t nodes) : boxes((nodes + kWidth - 1) / kWidth, empty_block()), sums(nodes) {}

  void extend(std::size_t node, int axis, double lo, double hi) {
    BoxBlock& block = boxes[node / kWidth];
    double &to_lo = block.lo[axis][node % kWidth], &to_hi = block.hi[axis][node % kWidth];
    to_lo = std::min(to_lo, lo);
    to_hi = std::max(to_hi, hi);
  }
};

LevelData leaf_level(const MeasuredTriangles& t, const std::vector<Index>& order) {
  LevelData level((t.size() + kWidth - 1) / kWidth);
  for (std::size_t place = 0; place < t.size(); ++place) {
    const std::size_t leaf = place / kWidth;
    level.sums[leaf] += t.measures[order[place]];
    for (const Index v : t.corners[order[place]]) {
      for (int axis = 0; axis < 3; ++axis) level.extend(leaf, axis, t.x[v][axis], t.x[v][axis]);
    }
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

std::vector<LevelData> make_levels(const MeasuredTriangles& t, const std::vector<Index>& order) {
  std::vector<LevelData> levels;
  if (t.size() == 0) return levels;
  levels.push_back(leaf_level(t, order));
  while (levels.back().boxes.size() > 1) levels.push_back(parent_level(levels.back()));
  return levels;
}

void set_origin(Leaf<double>&, const Vec3&) {}
void set_origin(Leaf<float>& leaf, const Vec3& origin) {
  std::copy_n(origin.data(), 3, leaf.origin);
}

double origin_of(const Leaf<double>&, int) {
  return 0;
}
double origin_of(const Leaf<float>& leaf, int axis) {
  return leaf.origin[axis];
}

template <class Real>
std::vector<Leaf<Real>> make_leaves(const MeasuredTriangles& t, const std::vector<Index>& order) {
  std::vector<Leaf<Real>> leaves((t.size() + kWidth - 1) / kWidth);
  for (std::size_t place = 0; place < kWidth * leaves.size(); ++place) {
    Leaf<Real>& leaf = leaves[place / kWidth];
    const std::size_t lane = place % kWidth;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3 x = place < t.size() ? t.x[t.corners[order[place]][corner]] : Vec3(Vec3::Constant(kInfinity));
      if (lane == 0 && corner == 0) set_origin(leaf, x);
      for (int axis = 0; axis < 3; ++axis)
        leaf.x[3 * static_cast<int>(corner) + axis][lane] = static_cast<Real>(x[axis] - origin_of(leaf, axis));
    }
  }
  return leaves;
}

/// Radii in increasing order, and where each stood.
struct SortedRadii {
  std::vector<std::size_t> given;
  std::vector<double> radii, radii_sq;

  explicit SortedRadii(const std::vector<double>& unsorted) : given(unsorted.size()) {
    std::iota(given.begin(), given.end(), std::size_t{0});
    std::stable_sort(given.begin(), given.end(),
                     [&](std::size_t a, std::size_t b) { return unsorted[a] < unsorted[b]; });
    for (const std::size_t i : given) {
      radii.push_back(unsorted[i]);
      radii_sq.push_back(unsorted[i] * unsorted[i]);
    }
  }
};

/// What one thread needs over and over.
struct Workspace {
  std::vector<BallAccumulator> balls;  ///< by increasing radius
  std::vector<BallMeasures> careful;   ///< likewise
  std::vector<BallMeasures> sums;      ///< in the order given
  const MeasuredTriangles* triangles = nullptr;
  const SortedRadii* radii = nullptr;
  Vec3 centre;
  BallDefinition ball = BallDefinition::ExactDensity;

  void prepare(const MeasuredTriangles& of, const SortedRadii& sorted, BallDefinition definition) {
    triangles = &of;
    radii = &sorted;
    ball = definition;
    balls.resize(sorted.radii.size());
    careful.resize(sorted.radii.size());
    sums.resize(sorted.radii.size());
  }

  void start(const Vec3& at) {
    centre = at;
    for (BallAccumulator& b : balls) {
      std::fill(std::begin(b.sum), std::end(b.sum), 0.0);
      std::fill_n(&b.excess[0][0], sizeof(b.excess) / sizeof(double), 0.0);
      b.faces = 0;
      b.whole_count = b.rim_count = 0;
    }
    std::fill(careful.begin(), careful.end(), BallMeasures{});
  }

  static void add_careful(void* workspace, std::uint32_t triangle, int radius) {
    Workspace& w = *static_cast<Workspace*>(workspace);
    const auto r = static_cast<std::size_t>(radius);
    add_triangle_in_ball(*w.triangles, triangle, w.centre, w.radii->radii[r], w.ball, w.careful[r]);
  }

  /// The sums of the ball in all their parts.
  BallMeasures total(std::size_t r) const {
    const BallAccumulator& b = balls[r];
    const auto lanes = [&](int i) { return std::accumulate(b.excess[i], b.excess[i] + kWidth, 0.0); };
    BallMeasures m;
    m.sum.area = b.sum[0];
    m.sum.mu0 = b.sum[1] + lanes(0);
    m.sum.mu2 = b.sum[2] + lanes(1);
    for (int i = 0; i < 6; ++i) m.sum.mu_sym[static_cast<std::size_t>(i)] = b.sum[3 + i] + lanes(2 + i);
    m.sum += careful[r].sum;
    m.face_count = static_cast<Index>(b.faces) + careful[r].face_count;
    return m;
  }

  void finish() {
    for (std::size_t r = 0; r < balls.size(); ++r) sums[radii->given[r]] = total(r);
  }
};

/// The tree with leaves of one precision.
template <class Real>
class Hierarchy {
 public:
  explicit Hierarchy(const MeasuredTriangles& t)
      : order_(tree_order(t)), levels_(make_levels(t, order_)), leaves_(make_leaves<Real>(t, order_)) {}

  std::size_t bytes() const {
    std::size_t total = order_.capacity() * sizeof(Index) + leaves_.capacity() * sizeof(Leaf<Real>);
    for (const LevelData& level : levels_)
      total += level.boxes.capacity() * sizeof(BoxBlock) + level.sums.capacity() * sizeof(MeasureSum);
    return total;
  }

  TreeView<Real> view(const MeasuredTriangles& t) const {
    TreeView<Real> v{};
    v.levels = static_cast<int>(levels_.size());
    for (std::size_t i = 0; i < levels_.size(); ++i) v.level[i] = {levels_[i].boxes.data(), &levels_[i].sums[0].area};
    v.leaves = leaves_.data();
    v.order = order_.data();
    v.triangles = t.size();
    if (t.size() == 0) return v;
    v.measures = &t.measures[0].area;
    v.corners = t.corners[0].data();
    v.normals = t.u[0].data();
    v.weights = t.weights.data();
    return v;
  }

  void sum(const MeasuredTriangles& t, const std::vector<Vec3>& centres, const std::vector<double>& radii,
           BallDefinition ball, const Execution& run, const BallSum::Sink& sink) const {
    const TreeView<Real> tree = view(t);
    const SortedRadii sorted(radii);
    const Query<Real> query = best_query<Real>();
    const std::vector<Index> order = spatial_order(centres);
    std::vector<Workspace> workspaces(static_cast<std::size_t>(thread_count(run)));
    for (Workspace& w : workspaces) w.prepare(t, sorted, ball);
    parallel_for(centres.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int worker) {
      Workspace& w = workspaces[static_cast<std::size_t>(worker)];
      for (std::size_t i = begin; i < end; ++i) {
        w.start(centres[order[i]]);
        if (is_finite(w.centre)) {
          query(tree, {{w.centre[0], w.centre[1], w.centre[2]},
                       sorted.radii.data(),
                       sorted.radii_sq.data(),
                       static_cast<int>(radii.size()),
                       ball == BallDefinition::ExactDensity,
                       w.balls.data(),
                       Workspace::add_careful,
                       &w});
        }
        w.finish();
        sink(order[i], w.sums.data());
      }
    });
  }

 private:
  std::vector<Index> order_;
  std::vector<LevelData> levels_;
  std::vector<Leaf<Real>> leaves_;
};

}  // namespace

struct MeasureTree::Impl {
  MeasuredTriangles triangles;
  std::unique_ptr<const Hierarchy<double>> in_double;
  std::unique_ptr<const Hierarchy<float>> in_float;
};

MeasureTree::MeasureTree(MeasuredTriangles triangles, Precision precision) : impl_(std::make_unique<Impl>()) {
  impl_->triangles = std::move(triangles);
  if (precision == Precision::Double) {
    impl_->in_double = std::make_unique<Hierarchy<double>>(impl_->triangles);
  } else {
    impl_->in_float = std::make_unique<Hierarchy<float>>(impl_->triangles);
  }
}

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
  if (impl_->in_double) {
    impl_->in_double->sum(impl_->triangles, centres, radii, ball, run, sink);
  } else {
    impl_->in_float->sum(impl_->triangles, centres, radii, ball, run, sink);
  }
}

}  // namespace kappa
