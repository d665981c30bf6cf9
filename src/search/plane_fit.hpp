// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "kappa/core/types.hpp"
#include "search/kernels/views.hpp"

namespace kappa {

/// How many points there are, and their first and second moments about a place among them.
struct Moments {
  std::size_t count = 0;
  Vec3 sum = Vec3::Zero();
  Mat3 products = Mat3::Zero();

  /// Adds the point at `d` from the place.
  void add(const Vec3& d) {
    ++count;
    sum += d;
    products += d * d.transpose();
  }
};

/// Of `count` points by the sums over them.
using PlaneSums = std::array<double, kernels::kPlaneSums>;
Moments moments_of(std::size_t count, const PlaneSums& sums);

/// A plane of least squares: its normal, zero if the points are collinear or fewer than three, and how far their
/// centroid lies from the place that they were measured from.
struct Plane {
  Vec3 normal;
  double offset;
};

Plane plane_of_moments(const Moments& moments);

}  // namespace kappa
