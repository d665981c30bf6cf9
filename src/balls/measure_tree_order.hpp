// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/balls/triangles.hpp"

namespace kappa {

/// The triangles in the order of the leaves of a measure tree: median splits of the centroids along the longest axis,
/// at multiples of powers of two, until 8 or fewer are left. The tree over them is implicit: every aligned run of 8^k
/// is a node.
std::vector<Index> tree_order(const Triangles& triangles, const Execution& run);

}  // namespace kappa
