// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/types.hpp"

namespace kappa::view_detail {

/// A disc of the size of the gap around a point of a cloud, in its tangent plane.
struct Disc {
  Index point;
  Vec3 normal;  ///< unit
  double radius;
};

/// Discs that close the gaps between the finite points. A given normal is used as it is; a point without one gets
/// that of its nearest neighbours, on the side of `towards`. A radius is at most three times the median.
std::vector<Disc> make_discs(const std::vector<Vec3>& points, const Normals& normals, const Vec3& towards);

/// Median distance of a finite point to its nearest neighbours, from a sample of the points; 0 for fewer than two.
double median_spacing(const std::vector<Vec3>& points);

}  // namespace kappa::view_detail
