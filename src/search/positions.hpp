// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/search/fitted_normals.hpp"
#include "point_blocks.hpp"

namespace kappa {

/// The finite positions of a cloud, each once, along a space-filling curve, with a search among them: what the stages
/// of a surface share.
struct Positions {
  explicit Positions(const std::vector<Vec3>& points, const Execution& run = {});
  /// Those for which keep[i] is not 0.
  Positions(const Positions& all, const std::vector<char>& keep);

  std::vector<Index> representative;  ///< of each point of the cloud, see find_duplicates
  std::vector<Index> original;        ///< index in the cloud of the first point at each position
  std::vector<Vec3> x;
  PointBlocks search;  ///< among x
};

/// Normals of the points of the cloud, see there.
Normals fitted_normals(const Positions& positions, const NormalFitOptions& options, const Execution& run);

}  // namespace kappa
