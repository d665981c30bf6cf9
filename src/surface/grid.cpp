// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/grid.hpp"

#include <string>

#include "cell_grid.hpp"
#include "kappa/core/error.hpp"

namespace kappa {

GridSurface grid_surface(const Vec3& origin, const std::vector<Vec3>& points, std::size_t width, std::size_t height,
                         const Vec3& viewpoint, const GridOptions& options, const Execution& run) {
  check(options, viewpoint);
  if (points.size() != width * height)
    throw Error(ErrorCode::InvalidArgument, std::to_string(points.size()) + " points for a grid of " +
                                                std::to_string(width) + " x " + std::to_string(height) +
                                                ": give one a cell, NaN where there was no return");
  GridSurface result;
  CloudSurface& s = result.surface;
  s.mesh.origin = origin;
  s.mesh.vertices = points;
  CellGrid grid;
  grid.width = width;
  grid.height = height;
  grid.points.resize(points.size(), kNoIndex);
  for (Index i = 0; i < points.size(); ++i) {
    if (is_finite(points[i])) grid.points[i] = i;
    s.invalid_points += grid.points[i] == kNoIndex;
  }
  result.cuts = add_cell_faces(grid, viewpoint, options, run, s.mesh);
  s.representative = std::move(grid.points);
  s.starless_points = count_faceless(s.mesh);
  return result;
}

}  // namespace kappa
