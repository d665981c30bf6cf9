// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/surface/umbrella.hpp"

namespace kappa {

struct GridOptions {
  /// Greatest difference of the distances of two corners from the scanner, relative to the smaller: above it the
  /// surface is taken to end there. Positive.
  double max_depth_jump = 0.05;
  /// Greatest angle, in degrees, between the line of sight and the normal of a triangle; in (0, 90].
  double max_incidence = 80;
};

/// What a grid lost, in triangles.
struct GridCuts {
  std::size_t depth_jumps = 0;  ///< corners at too different distances
  std::size_t grazing = 0;      ///< seen too flatly
  std::size_t degenerate = 0;   ///< of zero area: two returns at one place, or three on a line
};

/// A surface of cells of a grid.
struct GridSurface {
  CloudSurface surface;  ///< weights empty: every face counts whole; starless_points: finite, but in no face
  GridCuts cuts;
};

/// The surface of an organised cloud, row by row, NaN where there was no return: every cell of four neighbours is split
/// in two triangles along the diagonal that leaves more of them after the cuts, of two equals the shorter one, of two
/// equal ones that from the second to the third corner. A cell with three returns is one triangle. Faces turn
/// counter-clockwise seen from `viewpoint`.
///
/// `points` has width * height entries and, like `viewpoint`, is relative to `origin`. Every finite point stands for
/// itself, also where two share a position.
/// @throws Error InvalidArgument if the size is not width * height, the viewpoint is not finite or an option is out of
/// range.
GridSurface grid_surface(const Vec3& origin, const std::vector<Vec3>& points, std::size_t width, std::size_t height,
                         const Vec3& viewpoint, const GridOptions& options, const Execution& run = {});

}  // namespace kappa
