// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// Heights at the middles of the cells of a grid, row by row; NaN where there is none.
struct HeightGrid {
  std::size_t columns = 0, rows = 0;
  std::vector<double> z;

  HeightGrid(std::size_t c, std::size_t r) : columns(c), rows(r), z(c * r, kNaN) {}
  double& at(std::size_t column, std::size_t row) { return z[row * columns + column]; }
  double at(std::size_t column, std::size_t row) const { return z[row * columns + column]; }

  /// Between the middles of cells, bilinear, constant beyond the outermost; `x`, `y` in cells.
  double interpolate(double x, double y) const;
};

/// The surface opened with a disc (a minimum, then a maximum, over the cells within `radius`), which flattens what is
/// narrower. Cells beyond the border do not count. No cell may be NaN.
HeightGrid opened(const HeightGrid& surface, std::size_t radius, const Execution& run);

/// Fills the cells without height by harmonic interpolation, from coarse grids to fine. Some cell must have a height.
void fill(HeightGrid& surface);

}  // namespace kappa
