// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// The points that an algorithm on clouds works on: one at each position, each with a normal.
struct DistinctPoints {
  std::vector<Vec3> x;
  Normals u;                          ///< unit
  std::vector<Index> original;        ///< index of each in the cloud, increasing
  std::vector<Index> representative;  ///< of each point of the cloud, see find_duplicates
};

/// A position is left out if the first point there has no finite normal other than zero.
/// @throws Error InvalidArgument if sizes differ.
DistinctPoints distinct_points(const std::vector<Vec3>& points, const Normals& normals);

}  // namespace kappa
