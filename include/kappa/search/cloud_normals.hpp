// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/execution.hpp"
#include "kappa/mesh/mesh.hpp"
#include "kappa/search/neighbours.hpp"

namespace kappa {

/// Indices of the first point at each position: representative[i] == i for a point that stands for
/// itself, kNoIndex for one that is not finite.
std::vector<Index> find_duplicates(const std::vector<Vec3>& points);

struct PcaOptions {
  int neighbours = 24;  ///< points of different position a plane is fitted to, the point included; at least 3
  /// If positive: all points within this radius, where they are at least `neighbours`; the more, the less noise.
  double radius = 0;
};

/// Unit normals of the planes of least squares through the nearest neighbours, sign arbitrary. The zero
/// vector where the point is not finite or its neighbours are collinear or fewer than three.
/// Exact duplicates count once. Of more than 8192 points within the radius (and a little farther) every m-th is taken.
/// @throws Error InvalidArgument if there are fewer than 3 neighbours, or the radius is negative or not finite.
Normals pca_normals(const std::vector<Vec3>& points, const PcaOptions& options, const Execution& run = {});

/// Turns each normal so that it points to the side of `viewpoint`.
void orient_towards(const std::vector<Vec3>& points, const Vec3& viewpoint, Normals& normals);

/// Turns each normal so that its scalar product with `direction` is not negative, (0, 0, 1) for terrain.
void orient_along(const Vec3& direction, Normals& normals);

}  // namespace kappa
