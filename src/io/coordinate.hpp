// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/scan/scan.hpp"

namespace kappa::io {

/// Coordinate `axis` of a point as it was in the file it came from.
inline double coordinate(const Scan& scan, std::size_t point, int axis) {
  const double origin = scan.origin[axis];
  return origin == 0.0 ? scan.points[point][axis] : origin + scan.points[point][axis];  // 0 + -0 would lose the sign
}

}  // namespace kappa::io
