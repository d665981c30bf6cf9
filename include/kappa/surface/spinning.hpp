// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/surface/grid.hpp"

namespace kappa {

/// A sweep of a spinning scanner arranged as it was seen: one row a ring (a laser of fixed elevation), one column a
/// step of the azimuth about the z axis through the sensor, a full turn wide. The last column is next to the first.
struct SpinningSweep {
  std::size_t rings = 0, columns = 0;
  std::vector<Index> cells;        ///< rings * columns points, row by row from the highest ring; kNoIndex: no return
  std::vector<double> elevation;   ///< of each ring, median, radians above the horizon
  double azimuth_step = kNaN;      ///< of a column, radians
  std::size_t invalid_points = 0;  ///< not finite
  std::size_t at_sensor = 0;       ///< nearer to the sensor than 1e-6 of the extent: how scanners store "no return"
  std::size_t extra_returns = 0;   ///< in a cell that holds a nearer return, or beyond a full turn
};

/// Finds the rings and columns of an unorganised sweep. `ring` is the ring number of each point where the file has
/// one; empty, the rings are the clusters of the elevation angles about `sensor`, set apart where the sorted gaps
/// between angles fall off most steeply (by a factor of 3 at least). The step of the columns is the average of the
/// steps between neighbours in a ring that are no wider than 1.5 medians. The nearest of several returns in one
/// direction is kept.
/// @throws Error InvalidArgument if sizes differ or the sensor is not finite; InvalidData if no rings can be told
/// apart, or more than 512, or there are fewer than four returns a ring.
SpinningSweep organise_sweep(const std::vector<Vec3>& points, const Vec3& sensor, const std::vector<double>& ring = {});

/// Cuts for sweeps: rings are much farther apart than columns, and ground is seen at small angles. Of ground that a
/// sensor 2 m above it sees, this keeps what lies within 20 m.
inline constexpr GridOptions kSpinningCuts{0.25, 84};

/// A surface of the cells of a sweep (see grid_surface), its faces seen counter-clockwise from the sensor. Points in
/// no cell are corners of no face; `starless_points` does not count those at the sensor.
struct SpinningSurface {
  GridSurface grid;
  SpinningSweep sweep;
};

/// `sensor` is relative to `origin`, as the points are.
/// @throws Error as organise_sweep and grid_surface do.
SpinningSurface spinning_surface(const Vec3& origin, const std::vector<Vec3>& points, const Vec3& sensor,
                                 const std::vector<double>& ring, const GridOptions& options = kSpinningCuts,
                                 const Execution& run = {});

}  // namespace kappa
