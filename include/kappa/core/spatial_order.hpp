// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// The indices of `points` along a space-filling curve (Morton order), so that neighbours in space come close to each
/// other. The curve visits 2^21 cells along the longest side of the points. Points of one cell keep their order, and
/// points that are not finite come last.
/// @throws Cancelled, and Error as `parallel_for` does. Cost: linear, 32 bytes a point.
std::vector<Index> spatial_order(const std::vector<Vec3>& points, const Execution& run = {});

}  // namespace kappa
