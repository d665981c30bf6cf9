// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// A box with sides along the axes. It is empty until a point is added.
struct Bounds {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

  /// Whether the box holds no point.
  bool empty() const { return !(min.x() <= max.x()); }
  /// The length of the diagonal; 0 for an empty box.
  double diagonal() const { return empty() ? 0.0 : (max - min).norm(); }
};

/// The bounds of those `points` whose three coordinates are finite.
Bounds bounds(const std::vector<Vec3>& points);

/// A local origin for points in the coordinates of a file that lie within `bounds`. Along an axis it is
/// (a) 0, if the middle of the data lies within four extents of 0;
/// (b) a round number near the middle of the data otherwise.
/// To subtract this origin from such a point, and to add it back, is exact in double. The origin of empty bounds is 0.
Vec3 choose_origin(const Bounds& bounds);

}  // namespace kappa
