// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/surface/grid.hpp"

namespace kappa {

/// Points arranged in rows and columns as a scanner saw them.
struct CellGrid {
  enum class Columns { Open, Closed };  ///< Closed: the last column is next to the first
  std::size_t width = 0, height = 0;
  std::vector<Index> points;  ///< row by row, kNoIndex where there is none; else a finite point
  Columns columns = Columns::Open;
};

/// @throws Error InvalidArgument if an option is out of range or the viewpoint is not finite.
void check(const GridOptions& options, const Vec3& viewpoint);

/// Adds the faces of the cells of the grid to `mesh`, whose vertices are the points; returns what was cut.
GridCuts add_cell_faces(const CellGrid& grid, const Vec3& viewpoint, const GridOptions& options, const Execution& run,
                        Mesh& mesh);

/// Finite points that are a corner of no face.
std::size_t count_faceless(const Mesh& mesh);

}  // namespace kappa
