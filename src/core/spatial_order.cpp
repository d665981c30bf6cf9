// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/spatial_order.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "kappa/core/bounds.hpp"
#include "parallel_bounds.hpp"
#include "sort_by_key.hpp"

namespace kappa {
namespace {

/// Spreads the low 21 bits of v to every third bit.
std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffff;
  v = (v | v << 16) & 0x1f0000ff0000ff;
  v = (v | v << 8) & 0x100f00f00f00f00f;
  v = (v | v << 4) & 0x10c30c30c30c30c3;
  return (v | v << 2) & 0x1249249249249249;
}

std::uint64_t morton_code(const Vec3& p, const Bounds& b, double extent) {
  constexpr double kCells = 2097151;  // 2^21 - 1
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = (p[axis] - b.min[axis]) / extent * kCells;
    code |= spread_bits(static_cast<std::uint64_t>(cell)) << axis;
  }
  return code;
}

}  // namespace

std::vector<Index> spatial_order(const std::vector<Vec3>& points, const Execution& run) {
  constexpr std::size_t kBlock = 16384;
  const Bounds b = parallel_bounds(points.size(), stage(run, 0.0, 0.1), [&](std::size_t i, Bounds& part) {
    if (!is_finite(points[i])) return;
    part.min = part.min.cwiseMin(points[i]);
    part.max = part.max.cwiseMax(points[i]);
  });
  const double extent = std::max((b.max - b.min).maxCoeff(), std::numeric_limits<double>::min());
  std::vector<Keyed> keyed(points.size());
  parallel_for(points.size(), kBlock, stage(run, 0.1, 0.4), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const bool finite = is_finite(points[i]);
      keyed[i] = {finite ? morton_code(points[i], b, extent) : ~std::uint64_t{0}, static_cast<Index>(i)};
    }
  });
  sort_by_key(keyed, stage(run, 0.4, 1.0));
  std::vector<Index> order(points.size());
  std::transform(keyed.begin(), keyed.end(), order.begin(), [](const Keyed& entry) { return entry.index; });
  report_progress(run, 1.0);
  return order;
}

}  // namespace kappa
