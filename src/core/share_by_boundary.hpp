// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/triangle_ball.hpp"

namespace kappa::detail {

/// What the closed ball of `radius` around the origin holds of the triangle `x`, from the boundary of the intersection:
/// chords on the edges and arcs between them, in a frame on the longest edge. Nothing larger than the triangle is
/// summed. The triangle must not be degenerate (kDegenerateRatio). `met` is true where the share is positive.
TriangleShare share_by_boundary(const std::array<Vec3, 3>& x, double radius);

/// The same in extended precision, for slivers and for triangles tiny beside the ball, whose coordinates along the
/// edges cancel.
TriangleShare share_by_long_boundary(const std::array<Vec3, 3>& x, double radius);

}  // namespace kappa::detail
