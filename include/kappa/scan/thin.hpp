// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "kappa/scan/scan.hpp"

namespace kappa {

/// Thins the cloud to one point a cell of a grid of cubes: the point nearest to the mean of those in the cell; of
/// equally near ones the first. The cells begin at the least coordinates of the points, so that the result depends
/// neither on the local origin nor on the offset of a file; coordinates within 1e-6 of a border count as on it, and to
/// the cell above. A point is kept rather than the mean written, so that every attribute is one that was measured. An
/// organised cloud becomes a list. Points without a position are taken away. `cell`: edge of a cell along each axis, in
/// units of the points. Cost: O(n log n), 16 bytes a point.
/// @returns the number of points taken away.
/// @throws Error InvalidArgument, naming `path`, if an edge is not positive, if there would be more than 2^62 cells, or
/// if the scan has faces.
std::size_t thin(Scan& scan, const Vec3& cell, const std::string& path);

}  // namespace kappa
