// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/bounds.hpp"

#include <algorithm>
#include <cmath>

namespace kappa {

Bounds bounds(const std::vector<Vec3>& points) {
  Bounds b;
  for (const Vec3& p : points) {
    if (!is_finite(p)) continue;
    b.min = b.min.cwiseMin(p);
    b.max = b.max.cwiseMax(p);
  }
  return b;
}

Vec3 choose_origin(const Bounds& bounds) {
  Vec3 origin = Vec3::Zero();
  if (bounds.empty()) return origin;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = bounds.max[axis] - bounds.min[axis];
    const double centre = bounds.min[axis] + 0.5 * extent;
    // Closer to 0 a local origin gains nothing. Beyond, every coordinate lies within a factor 2 of the origin, so
    // that the difference is exact (Sterbenz) and so is adding the origin back.
    if (std::abs(centre) <= 4 * extent) continue;
    const double unit = std::exp2(std::floor(std::log2(std::max(extent, std::abs(centre) * 0x1p-40))));
    const double rounded = std::round(centre / unit) * unit;
    origin[axis] = std::abs(rounded - centre) <= 0.25 * std::abs(centre) ? rounded : centre;
  }
  return origin;
}

}  // namespace kappa
