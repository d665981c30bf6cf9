// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/shapes/analytic.hpp"

namespace kappa::detail {

/// A grid of quads over vertices first + v * columns + u.
struct QuadGrid {
  Index columns = 0, rows = 0;  ///< vertices along u and v
  bool closed_u = false;        ///< the last column is joined to the first
  bool closed_v = false;        ///< the last row is joined to the first
  Index first = 0;              ///< vertex (0, 0)
};

/// Adds the faces of a grid, counter-clockwise seen from the side of du x dv.
void add_grid_faces(Faces& faces, const QuadGrid& grid, GridFaces kind);

}  // namespace kappa::detail
