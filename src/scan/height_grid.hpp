// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// Heights at the middles of the cells of a grid, row by row. NaN stands where there is none.
struct HeightGrid {
  std::size_t columns = 0, rows = 0;
  std::vector<double> z;

  HeightGrid(std::size_t c, std::size_t r) : columns(c), rows(r), z(c * r, kNaN) {}
  double& at(std::size_t column, std::size_t row) { return z[row * columns + column]; }
  double at(std::size_t column, std::size_t row) const { return z[row * columns + column]; }

  /// The height at the place (x, y), which is measured in cells from the middle of the first cell: bilinear between the
  /// middles of cells, and constant beyond the outermost ones.
  double interpolate(double x, double y) const;
};

/// Calls `use(i)` for the index `i` of every cell, on any thread.
/// @throws Cancelled as `parallel_for` does.
template <class Use>
void for_each_cell(const HeightGrid& grid, const Execution& run, const Use& use) {
  constexpr std::size_t kBlock = 65536;
  parallel_for(grid.z.size(), kBlock, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) use(i);
  });
}

/// Turns the heights upside down.
/// @throws Cancelled, with some of the heights turned.
void negate(HeightGrid& grid, const Execution& run);

/// The surface opened with a disc: for every cell the least height of the cells within `radius` cells, and of these
/// heights the greatest within `radius`. This flattens what is narrower than the disc. Cells beyond the border do not
/// count. No cell may be NaN; this is not checked.
/// @throws Cancelled.
HeightGrid opened(const HeightGrid& surface, std::size_t radius, const Execution& run);

/// Fills the cells without a height by harmonic interpolation, from coarse grids to fine ones. A grid without any
/// height stays as it is.
/// @throws Cancelled, with some of the cells filled.
void fill(HeightGrid& surface, const Execution& run);

}  // namespace kappa
