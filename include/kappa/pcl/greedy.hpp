// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/surface/umbrella.hpp"

namespace kappa {

/// Parameters of PCL's greedy projection, by what PCL calls them.
struct GreedyOptions {
  double radius = 0;     ///< setSearchRadius: longest edge, in units of the points; 0 is five times the median spacing
  double mu = 2.5;       ///< setMu: edges are at most this times the distance of the nearest neighbour
  int neighbours = 100;  ///< setMaximumNearestNeighbors
};

/// The surface through a cloud by pcl::GreedyProjectionTriangulation (Marton, Rusu and Beetz, ICRA 2009), faces turned
/// to the side of the normals, PCL's angles (10 to 120 degrees in a face, 45 between normals). For comparison: it
/// leaves holes, depends on the order of the points, takes 8 s for 200,000 points and more than a minute for half a
/// million; the umbrella surface (`umbrella_surface`) has none of that. PCL works in floats: points should be relative
/// to a local origin; those that floats do not tell apart are left out.
/// @throws Error InvalidArgument if sizes differ or an option is out of range; InvalidData if there is no valid point.
CloudSurface greedy_surface(const Vec3& origin, const std::vector<Vec3>& points, const Normals& normals,
                            const GreedyOptions& options = {});

}  // namespace kappa
