// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/triangle_ball.hpp"

namespace kappa::detail {

/// What the closed ball of `radius` around the origin holds of the degenerate triangle `x`, which is taken for a line
/// or a point: the share and centroid of the part of its parameter simplex that lies inside. `met` is true where the
/// share is positive.
TriangleShare share_of_simplex(const std::array<Vec3, 3>& x, double radius);

}  // namespace kappa::detail
