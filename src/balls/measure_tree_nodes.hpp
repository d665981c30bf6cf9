// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "balls/kernels/views.hpp"
#include "core/large_array.hpp"
#include "core/parallel_bounds.hpp"
#include "kappa/balls/triangles.hpp"
#include "kappa/core/bounds.hpp"

// Boxes, sums and leaves of a measure tree over triangles in its order.

namespace kappa {

/// Unit and origin of the boxes: floats in [-1, 1], whatever the units of the data.
struct BoxFrame {
  Vec3 middle = Vec3::Zero();
  double unit = 1;

  BoxFrame() = default;
  BoxFrame(const Triangles& t, const Execution& run) {
    const Bounds b = parallel_bounds(t.size(), run, [&](std::size_t i, Bounds& part) {
      for (const Index v : t.corners[i]) {
        part.min = part.min.cwiseMin(t.x[v]);
        part.max = part.max.cwiseMax(t.x[v]);
      }
    });
    if (b.empty()) return;
    middle = b.min / 2 + b.max / 2;
    const double half = (b.max / 2 - b.min / 2).maxCoeff();
    if (half > 0 && std::isfinite(1 / half)) unit = 1 / half;
  }

  Vec3 placed(const Vec3& x) const { return (x - middle) * unit; }
};

inline float rounded_down(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) <= v ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}

inline float rounded_up(double v) {
  return -rounded_down(-v);
}

inline kernels::BoxBlock empty_block() {
  kernels::BoxBlock block;
  std::fill_n(&block.lo[0][0], 3 * kernels::kWidth, std::numeric_limits<float>::infinity());
  std::fill_n(&block.hi[0][0], 3 * kernels::kWidth, -std::numeric_limits<float>::infinity());
  return block;
}

/// Boxes and sums of the nodes of one level.
struct LevelData {
  std::vector<kernels::BoxBlock> boxes;
  std::vector<MeasureSum> sums;

  LevelData(std::size_t nodes, const Execution& run)
      : boxes(large_vector((nodes + kernels::kWidth - 1) / kernels::kWidth, empty_block(), run)),
        sums(large_vector(nodes, MeasureSum(), run)) {}

  void extend(std::size_t node, int axis, float lo, float hi) {
    kernels::BoxBlock& block = boxes[node / kernels::kWidth];
    float &to_lo = block.lo[axis][node % kernels::kWidth], &to_hi = block.hi[axis][node % kernels::kWidth];
    to_lo = std::min(to_lo, lo);
    to_hi = std::max(to_hi, hi);
  }
};

/// Bounds of the corners of a leaf's triangles.
inline Bounds bounds_of_leaf(const Triangles& t, std::size_t leaf) {
  Bounds b;
  for (std::size_t i = kernels::kWidth * leaf; i < std::min(t.size(), kernels::kWidth * (leaf + 1)); ++i) {
    for (const Index v : t.corners[i]) {
      b.min = b.min.cwiseMin(t.x[v]);
      b.max = b.max.cwiseMax(t.x[v]);
    }
  }
  return b;
}

inline constexpr std::size_t kNodes = 512;  ///< that a thread makes at a time, whole blocks of boxes

inline LevelData leaf_level(const Triangles& t, const std::vector<MeasureSum>& measures, const BoxFrame& frame,
                            const Execution& run) {
  LevelData level((t.size() + kernels::kWidth - 1) / kernels::kWidth, run);
  parallel_for(level.sums.size(), kNodes, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      for (std::size_t i = kernels::kWidth * leaf; i < std::min(t.size(), kernels::kWidth * (leaf + 1)); ++i)
        level.sums[leaf] += measures[i];
      const Bounds b = bounds_of_leaf(t, leaf);
      const Vec3 lo = frame.placed(b.min), hi = frame.placed(b.max);
      for (int axis = 0; axis < 3; ++axis) level.extend(leaf, axis, rounded_down(lo[axis]), rounded_up(hi[axis]));
    }
  });
  return level;
}

inline LevelData parent_level(const LevelData& below, const Execution& run) {
  LevelData level(below.boxes.size(), run);
  for (std::size_t child = 0; child < below.sums.size(); ++child) {
    const std::size_t node = child / kernels::kWidth, lane = child % kernels::kWidth;
    level.sums[node] += below.sums[child];
    const kernels::BoxBlock& block = below.boxes[node];
    for (int axis = 0; axis < 3; ++axis) level.extend(node, axis, block.lo[axis][lane], block.hi[axis][lane]);
  }
  return level;
}

inline std::vector<LevelData> make_levels(const Triangles& t, const std::vector<MeasureSum>& measures,
                                          const BoxFrame& frame, const Execution& run) {
  std::vector<LevelData> levels;
  if (t.size() == 0) return levels;
  levels.push_back(leaf_level(t, measures, frame, run));
  while (levels.back().boxes.size() > 1) levels.push_back(parent_level(levels.back(), run));
  return levels;
}

/// Squared length of the longest edge of a leaf's triangles.
inline double longest_edge_sq(const Triangles& t, std::size_t leaf) {
  double longest_sq = 0;
  for (std::size_t i = kernels::kWidth * leaf; i < std::min(t.size(), kernels::kWidth * (leaf + 1)); ++i) {
    const auto& c = t.corners[i];
    for (std::size_t k = 0; k < 3; ++k)
      longest_sq = std::max(longest_sq, (t.x[c[k]] - t.x[c[(k + 1) % 3]]).squaredNorm());
  }
  return longest_sq;
}

/// Calls `use(lane, corners)` for the triangles of a leaf.
template <class Use>
void for_triangles(const Triangles& t, std::size_t leaf, const Use& use) {
  const std::size_t first = kernels::kWidth * leaf, count = std::min<std::size_t>(kernels::kWidth, t.size() - first);
  for (std::size_t lane = 0; lane < count; ++lane) use(lane, t.corners[first + lane]);
}

/// The steps reach from the middle of the leaf to its farthest side; they are not so small that squares overflow.
inline void fill(const Triangles& t, std::size_t number, const BoxFrame& frame, kernels::Leaf<double>& leaf) {
  constexpr double kSteps = 32767, kMostAUnit = 1e12;
  const Bounds b = bounds_of_leaf(t, number);
  const Vec3 lo = frame.placed(b.min), hi = frame.placed(b.max), origin = (lo + hi) / 2;
  const double half = ((hi - lo) / 2).maxCoeff();
  std::copy_n(origin.data(), 3, leaf.origin);
  leaf.steps_a_unit = static_cast<float>(half * kMostAUnit > kSteps ? kSteps / half : kMostAUnit);
  const auto steps = static_cast<double>(leaf.steps_a_unit);
  for_triangles(t, number, [&](std::size_t lane, const auto& corners) {
    for (std::size_t row = 0; row < 9; ++row) {
      const auto axis = static_cast<Eigen::Index>(row % 3);
      const double x = (t.x[corners[row / 3]][axis] - frame.middle[axis]) * frame.unit - origin[axis];
      leaf.x[row][lane] = static_cast<std::int16_t>(std::lrint(x * steps));
    }
  });
  // Corners are off by less than a step: as far away as an edge is long, that much more in the squared distance.
  const double longest = std::sqrt(longest_edge_sq(t, number)) * frame.unit * steps;
  leaf.third_of_longest_sq = rounded_up((longest / 3 + 2) * longest);
}

/// A place in [-1, 1]^3 about `v` that floats hold as it is. (Not by way of a float and back: where g++ 12 makes
/// vectors of it, it leaves both conversions out.)
inline Vec3 place_for_floats(const Vec3& v) {
  constexpr double kSteps = 1 << 23;
  return (v * kSteps).array().round() / kSteps;
}

inline void put(const Vec3& v, float (&rows)[3][kernels::kWidth], std::size_t lane) {
  for (int axis = 0; axis < 3; ++axis) rows[axis][lane] = static_cast<float>(v[axis]);
}

inline Vec3 mean_normal(const Triangles& t, std::size_t leaf) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for_triangles(t, leaf, [&](std::size_t, const auto& corners) {
    sum += t.u[corners[0]];
    ++count;
  });
  return sum / count;
}

inline void fill(const Triangles& t, std::size_t number, const BoxFrame& frame, kernels::Leaf<float>& leaf) {
  constexpr double kRounding = 1e-5;  // of the squared distances of corners from balls smaller than the leaf
  const Bounds b = bounds_of_leaf(t, number);
  const Vec3 lo = frame.placed(b.min), hi = frame.placed(b.max);
  const Vec3 origin = place_for_floats((lo + hi) / 2), normal = place_for_floats(mean_normal(t, number));
  for (int axis = 0; axis < 3; ++axis) {
    leaf.origin[axis] = static_cast<float>(origin[axis]);
    leaf.normal[axis] = static_cast<float>(normal[axis]);
  }
  std::fill_n(&leaf.x[0][0], 3 * kernels::kWidth, std::numeric_limits<float>::infinity());
  for_triangles(t, number, [&](std::size_t lane, const auto& corners) {
    const Vec3 &x0 = t.x[corners[0]], &u0 = t.u[corners[0]];
    put(frame.placed(x0) - origin, leaf.x, lane);
    put((t.x[corners[1]] - x0) * frame.unit, leaf.e1, lane);
    put((t.x[corners[2]] - x0) * frame.unit, leaf.e2, lane);
    put(u0 - normal, leaf.u, lane);
    put(t.u[corners[1]] - u0, leaf.d1, lane);
    put(t.u[corners[2]] - u0, leaf.d2, lane);
  });
  const double longest = std::sqrt(longest_edge_sq(t, number)) * frame.unit, half = ((hi - lo) / 2).maxCoeff();
  leaf.third_of_longest_sq = rounded_up(longest * longest / 3 + kRounding * half * half);
}

/// Rows that are not filled are 0.
template <class Real>
std::vector<kernels::Leaf<Real>> make_leaves(const Triangles& t, const BoxFrame& frame, const Execution& run) {
  const std::size_t count = (t.size() + kernels::kWidth - 1) / kernels::kWidth;
  auto leaves = large_vector(count, kernels::Leaf<Real>(), run);
  parallel_for(leaves.size(), kNodes, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) fill(t, i, frame, leaves[i]);
  });
  return leaves;
}

}  // namespace kappa
