// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

/// Thins a cloud to one point in each cell of a grid, and returns the number of points that it takes away.
///
/// `cell` are the lengths of a cell along the axes, in units of the points. Of the points in a cell the one nearest to
/// their mean stays, and of equally near ones the first; distances are measured in lengths of the cell. So every
/// attribute that is left was measured. Points without a position are taken away, and an organised cloud becomes a
/// list. `path` is the file that messages name.
///
/// The cells begin at the least coordinates of the points. So the result depends neither on the local origin nor on the
/// offset of a file. A coordinate within 1e-6 cells below a border belongs to the cell above it.
/// Cost: linear, 32 bytes a point.
/// @throws Error InvalidArgument if a length is not positive and finite, if there would be more than 2^62 cells, or if
/// the scan has faces; Cancelled.
std::size_t thin(Scan& scan, const Vec3& cell, const std::string& path, const Execution& run = {});

}  // namespace kappa
