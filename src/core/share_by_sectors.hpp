// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/triangle_ball.hpp"

namespace kappa::detail {

/// What the closed ball of `radius` around the origin holds of the triangle `x`, as a signed sum over the edges of a
/// chord part and of circular sectors beyond it. The triangle must be neither degenerate (kDegenerateRatio) nor small
/// beside the ball: the sum has terms of the size of the disc. `met` is true where the share is positive.
/// Cost: one atan2 an edge.
TriangleShare share_by_sectors(const std::array<Vec3, 3>& x, double radius);

}  // namespace kappa::detail
