// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// A box along the axes; empty unless a point was added.
struct Bounds {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());
  bool empty() const { return !(min.x() <= max.x()); }
  double diagonal() const { return empty() ? 0.0 : (max - min).norm(); }
};

/// Bounds of the finite points.
Bounds bounds(const std::vector<Vec3>& points);

/// A local origin for points given in the coordinates of a file: 0 on an axis along which the data
/// is not far from 0 for its extent, else a round number among them. Subtracting it, and adding it
/// back, is exact in double.
Vec3 choose_origin(const Bounds& bounds);

}  // namespace kappa
