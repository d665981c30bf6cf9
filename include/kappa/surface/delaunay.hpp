// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/names.hpp"
#include "kappa/surface/umbrella.hpp"

namespace kappa {

/// Which of several points above each other the surface goes through.
enum class PlanDuplicates {
  Highest,  ///< the surface seen from above
  Lowest    ///< nearer to the ground
};
const std::vector<Named<PlanDuplicates>>& names_of(PlanDuplicates);

struct DelaunayOptions {
  /// Greatest length in plan of the edges of a face, in units of the spacing; positive, infinity to fill the convex
  /// hull.
  double max_edge = 6;
  PlanDuplicates duplicates = PlanDuplicates::Highest;
};

/// A surface with one height at each place in plan.
struct PlanSurface {
  /// Weights empty: every face counts whole; starless_points: in no face. `representative` is the point that the
  /// surface goes through at the position in plan; the others there are the duplicates.
  CloudSurface surface;
  double spacing = kNaN;      ///< median length in plan of the edges of all triangles, before the cut
  std::size_t cut_faces = 0;  ///< with an edge that is too long
};

/// The Delaunay triangulation of the points projected along z, as for airborne scans. Faces turn counter-clockwise
/// seen from above. Of points at one position in plan, to 2^-29 of the extent, only one is kept; of equal height, the
/// first. A cell of a square grid is split along its shorter diagonal in space.
/// No face is made of points that are collinear to that accuracy.
/// Cost: O(n log n), one thread; 7 s for a million random points on a busy machine.
/// @throws Error InvalidArgument if an option is out of range.
PlanSurface delaunay_surface(const Vec3& origin, const std::vector<Vec3>& points, const DelaunayOptions& options,
                             const Execution& run = {});

}  // namespace kappa
