// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa::view_detail {

/// A disc of the size of the gap around a point of a cloud, in its tangent plane.
struct Disc {
  Index point;
  Vec3 normal;  ///< unit
  double radius;
};

/// One disc for each finite point, in the order of the points, wide enough to close the gaps to its neighbours.
///
/// A disc has the normal given for its point. A point without a normal, or with one that is zero or not finite, gets
/// the normal of the plane through its nearest neighbours, on the side of `towards`. Radii above three times the median
/// radius are cut to that. The result does not depend on the number of threads.
/// @throws Cancelled.
std::vector<Disc> make_discs(const std::vector<Vec3>& points, const Normals& normals, const Vec3& towards,
                             const Execution& run);

/// Median over a sample of the finite points of the distance to the nearest point at another position. 0 if there are
/// fewer than two positions.
/// @throws Cancelled.
double median_spacing(const std::vector<Vec3>& points, const Execution& run);

}  // namespace kappa::view_detail
