// SPDX-License-Identifier: BSD-3-Clause
#include "point_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/large_array.hpp"
#include "kappa/core/bounds.hpp"

namespace kappa {
namespace {

using kernels::kBlockPoints;
using kernels::PointBlock;
using kernels::PointBoxes;

constexpr std::size_t kChildren = 8;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<PointBlock> blocks_of(const std::vector<Vec3>& points) {
  std::vector<PointBlock> blocks;
  reserve_large(blocks, (points.size() + kBlockPoints - 1) / kBlockPoints);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % kBlockPoints == 0) blocks.push_back(empty_block());
    for (int axis = 0; axis < 3; ++axis) blocks.back().x[axis][i % kBlockPoints] = points[i][axis];
  }
  return blocks;
}

Bounds bounds_of(const PointBlock& block) {
  Bounds box;
  for (std::size_t i = 0; i < kBlockPoints; ++i) {
    const Vec3 x(block.x[0][i], block.x[1][i], block.x[2][i]);
    if (x.x() == kInfinity) break;  // no more points
    box.min = box.min.cwiseMin(x);
    box.max = box.max.cwiseMax(x);
  }
  return box;
}

}  // namespace

PointBlock empty_block() {
  PointBlock block;
  for (auto& row : block.x) std::fill(std::begin(row), std::end(row), kInfinity);
  return block;
}

namespace {

template <class Node>
std::vector<PointBoxes> boxes_over(std::size_t count, const Node& bounds_of_node) {
  std::vector<PointBoxes> level((count + kChildren - 1) / kChildren);
  for (std::size_t i = 0; i < level.size() * kChildren; ++i) {
    const Bounds box = i < count ? bounds_of_node(i) : Bounds();
    for (int axis = 0; axis < 3; ++axis) {
      level[i / kChildren].low[axis][i % kChildren] = box.min[axis];
      level[i / kChildren].high[axis][i % kChildren] = box.max[axis];
    }
  }
  return level;
}

Bounds bounds_of(const PointBoxes& boxes) {
  Bounds whole;
  for (int axis = 0; axis < 3; ++axis) {
    whole.min[axis] = *std::min_element(std::begin(boxes.low[axis]), std::end(boxes.low[axis]));
    whole.max[axis] = *std::max_element(std::begin(boxes.high[axis]), std::end(boxes.high[axis]));
  }
  return whole;
}

}  // namespace

PointBlocks::PointBlocks(const std::vector<Vec3>& points) : size_(points.size()), blocks_(blocks_of(points)) {
  if (points.empty()) return;
  levels_.push_back(boxes_over(blocks_.size(), [&](std::size_t i) { return bounds_of(blocks_[i]); }));
  while (levels_.back().size() > 1) {
    const std::vector<PointBoxes>& below = levels_.back();
    levels_.push_back(boxes_over(below.size(), [&](std::size_t i) { return bounds_of(below[i]); }));
  }
}

void PointBlocks::near_box(const Vec3& low, const Vec3& high, double distance, Work& work) const {
  work.blocks.clear();
  if (levels_.empty()) return;
  work.blocks.push_back(0);
  for (std::size_t level = levels_.size(); level-- > 0;) {
    std::swap(work.blocks, work.opened);
    work.blocks.resize(kChildren * work.opened.size() + kChildren);
    const std::size_t met =
        kernels::best_point_table().open(levels_[level].data(), work.opened.data(), work.opened.size(), low.data(),
                                         high.data(), distance * distance, work.blocks.data());
    work.blocks.resize(met);
  }
}

void PointBlocks::near_run(const Vec3& low, const Vec3& high, double distance, Work& work) const {
  near_box(low, high, distance, work);
  work.boxes.resize((work.blocks.size() + kChildren - 1) / kChildren);
  for (std::size_t i = 0; i < work.boxes.size() * kChildren; ++i) {
    kernels::NamedBoxes& to = work.boxes[i / kChildren];
    const bool any = i < work.blocks.size();
    const std::uint32_t block = any ? work.blocks[i] : 0;
    const PointBoxes& from = levels_[0][block / kChildren];
    to.names[i % kChildren] = block;
    for (int axis = 0; axis < 3; ++axis) {
      to.boxes.low[axis][i % kChildren] = any ? from.low[axis][block % kChildren] : kInfinity;
      to.boxes.high[axis][i % kChildren] = any ? from.high[axis][block % kChildren] : -kInfinity;
    }
  }
}

kernels::ChosenBlocks PointBlocks::near_ball(const Vec3& centre, double radius, Work& work) const {
  const std::size_t room = kChildren * work.boxes.size() + kChildren;
  if (work.of_ball.size() < room) work.of_ball.resize(room);
  const std::size_t count = kernels::best_point_table().meet(work.boxes.data(), work.boxes.size(), centre.data(),
                                                             radius * radius, work.of_ball.data());
  return {blocks_.data(), work.of_ball.data(), count};
}

std::size_t PointBlocks::measure(const Vec3& centre, double radius, Work& work) const {
  const kernels::ChosenBlocks from{blocks_.data(), work.blocks.data(), work.blocks.size()};
  work.points.resize(std::max(work.points.size(), from.places() + kBlockPoints));
  work.distances_sq.resize(work.points.size());
  return kernels::best_point_table().measure(from, centre.data(), radius * radius, work.points.data(),
                                             work.distances_sq.data());
}

void PointBlocks::within(const Vec3& query, double radius, std::vector<Index>& indices,
                         std::vector<double>& distances_sq, Work& work) const {
  near_box(query, query, radius, work);
  const auto count = static_cast<std::ptrdiff_t>(measure(query, radius, work));
  distances_sq.assign(work.distances_sq.begin(), work.distances_sq.begin() + count);
  indices.resize(distances_sq.size());
  std::transform(work.points.begin(), work.points.begin() + count, indices.begin(),
                 [](double point) { return static_cast<Index>(point); });
}

namespace {

std::array<double, kChildren> distances_sq(const PointBoxes& boxes, const Vec3& query) {
  std::array<double, kChildren> sum{};
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < kChildren; ++i) {
      const double below = boxes.low[axis][i] - query[axis], above = query[axis] - boxes.high[axis][i];
      const double gap = std::max({below, above, 0.0});
      sum[i] += gap * gap;
    }
  }
  return sum;
}

}  // namespace

/// Goes down into the nearest boxes first.
class PointBlocks::Nearest {
 public:
  Nearest(const PointBlocks& of, const Vec3& query, std::size_t k) : of_(of), query_(query), k_(k) {}

  std::vector<std::pair<double, Index>> all(std::size_t level) {
    look_into(level, 0);
    std::sort_heap(heap_.begin(), heap_.end());
    return std::move(heap_);
  }

 private:
  void look_into(std::size_t level, std::size_t node) {
    std::array<double, kChildren> rest = distances_sq(of_.levels_[level][node], query_);
    for (std::size_t visited = 0; visited < kChildren; ++visited) {
      const auto nearest = std::min_element(rest.begin(), rest.end());
      if (*nearest == kInfinity || *nearest > worst_) return;
      *nearest = kInfinity;
      const std::size_t child = kChildren * node + static_cast<std::size_t>(nearest - rest.begin());
      if (level == 0) {
        add_block(child);
      } else {
        look_into(level - 1, child);
      }
    }
  }

  void add_block(std::size_t block) {
    const PointBlock& b = of_.blocks_[block];
    for (std::size_t i = 0; i < kBlockPoints; ++i) {
      const double d_sq = (Vec3(b.x[0][i], b.x[1][i], b.x[2][i]) - query_).squaredNorm();
      if (d_sq <= worst_ && d_sq < kInfinity) add(static_cast<Index>(block * kBlockPoints + i), d_sq);
    }
  }

  void add(Index point, double d_sq) {
    const std::pair<double, Index> found(d_sq, point);
    if (heap_.size() == k_) {
      if (!(found < heap_.front())) return;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
    }
    heap_.push_back(found);
    std::push_heap(heap_.begin(), heap_.end());
    if (heap_.size() == k_) worst_ = heap_.front().first;
  }

  const PointBlocks& of_;
  const Vec3& query_;
  const std::size_t k_;
  double worst_ = kInfinity;
  std::vector<std::pair<double, Index>> heap_;  ///< the farthest first
};

namespace {

void take_apart(const std::vector<std::pair<double, Index>>& found, std::vector<Index>& indices,
                std::vector<double>& distances_sq) {
  indices.clear();
  distances_sq.clear();
  for (const auto& [d_sq, point] : found) {
    indices.push_back(point);
    distances_sq.push_back(d_sq);
  }
}

}  // namespace

void PointBlocks::nearest(const Vec3& query, std::size_t k, std::vector<Index>& indices,
                          std::vector<double>& distances_sq) const {
  std::vector<std::pair<double, Index>> found;
  if (!levels_.empty() && k > 0) found = Nearest(*this, query, k).all(levels_.size() - 1);
  take_apart(found, indices, distances_sq);
}

void PointBlocks::nearest(const Vec3& query, std::size_t k, double guess, std::vector<Index>& indices,
                          std::vector<double>& distances_sq, Work& work) const {
  near_box(query, query, guess, work);
  const std::size_t count = measure(query, guess, work);
  if (count < k) return nearest(query, k, indices, distances_sq);
  std::vector<std::pair<double, Index>> found(count);
  for (std::size_t i = 0; i < count; ++i) found[i] = {work.distances_sq[i], static_cast<Index>(work.points[i])};
  const auto end = found.begin() + static_cast<std::ptrdiff_t>(k);
  std::nth_element(found.begin(), end, found.end());
  std::sort(found.begin(), end);
  found.erase(end, found.end());
  take_apart(found, indices, distances_sq);
}

PointRun::PointRun(const PointBlocks& blocks, std::size_t begin, std::size_t most, double extent)
    : end(begin + 1), low(blocks.point(begin)), high(low) {
  for (const std::size_t last = std::min(blocks.size(), begin + most); end < last; ++end) {
    const Vec3 x = blocks.point(end);
    const Vec3 new_low = low.cwiseMin(x), new_high = high.cwiseMax(x);
    if ((new_high - new_low).maxCoeff() > extent) return;
    low = new_low;
    high = new_high;
  }
}

namespace {

constexpr std::size_t kRun = 16;         // points
constexpr std::size_t kMostRanked = 64;  // and twice the neighbours: ranks take the square of the time
constexpr std::size_t kMostBlocks = 16;  // times the neighbours

/// Radius of a disc of k points over the root of k, by the distance of two that follow each other.
constexpr double kUsualReach = 0.65;

}  // namespace

double NearestInRuns::first_guess(std::size_t begin, std::size_t end) const {
  std::vector<double> steps;
  for (std::size_t i = begin + 1; i < end; ++i) steps.push_back((blocks_.point(i) - blocks_.point(i - 1)).norm());
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return kUsualReach * std::sqrt(static_cast<double>(k_)) * *middle;
}

/// Most of the neighbours that come next are within this, if they are as far on the average. A point far from all
/// others says little about the next ones.
double NearestInRuns::next_guess(double distance_sq) const {
  constexpr double kMargin = 1.2, kGrowth = 1.5;
  const double guess = kMargin * std::sqrt(distance_sq);
  return reach_ > 0 ? std::min(guess, kGrowth * reach_) : guess;
}

std::size_t NearestInRuns::choose_run(std::size_t begin, std::size_t end) {
  const PointRun run(blocks_, begin, std::min(kRun, end - begin), 2 * reach_);
  blocks_.near_box(run.low, run.high, reach_, of_run_);
  return run.end;
}

/// In the reach of the run, else alone in a wider one, as most points at a border need it.
void NearestInRuns::find(std::size_t i) {
  constexpr double kWider = 1.7;
  const Vec3 centre = blocks_.point(i);
  if (find_in_reach(centre, reach_, of_run_)) return;
  blocks_.near_box(centre, centre, kWider * reach_, of_point_);
  if (!find_in_reach(centre, kWider * reach_, of_point_)) blocks_.nearest(centre, k_, indices_, distances_sq_);
}

/// False if the ball of that radius holds too few, or so many that a search through the boxes takes no longer.
bool NearestInRuns::find_in_reach(const Vec3& centre, double reach, PointBlocks::Work& work) {
  if (work.blocks.size() > kMostBlocks * k_) return false;
  const std::size_t count = blocks_.measure(centre, reach, work);
  if (count < k_ || count > kMostRanked + 2 * k_) return false;
  ranks_.resize(count + kBlockPoints);
  kernels::best_point_table().rank(work.distances_sq.data(), count, ranks_.data());
  order_.assign(count, kNoIndex);
  for (std::size_t n = 0; n < count; ++n) {
    std::size_t at = ranks_[n];
    while (order_[at] != kNoIndex) ++at;  // equally far
    order_[at] = static_cast<std::uint32_t>(n);
  }
  indices_.resize(k_);
  distances_sq_.resize(k_);
  for (std::size_t at = 0; at < k_; ++at) {
    indices_[at] = static_cast<Index>(work.points[order_[at]]);
    distances_sq_[at] = work.distances_sq[order_[at]];
  }
  return true;
}

}  // namespace kappa
