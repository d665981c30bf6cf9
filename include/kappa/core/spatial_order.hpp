// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// Indices of `points` along a space-filling (Morton) curve; points that are not finite come last.
std::vector<Index> spatial_order(const std::vector<Vec3>& points, const Execution& run = {});

}  // namespace kappa
