// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/names.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// How the ground is found.
enum class GroundMethod {
  Morphological,  ///< `find_ground`
  Progressive     ///< PCL's progressive morphological filter, for comparison
};
const std::vector<Named<GroundMethod>>& names_of(GroundMethod);

/// Parameters of `find_ground`. Lengths are in units of the points; the defaults are for metres.
struct GroundOptions {
  double cell = 1;         ///< edge of the cells of the grid
  double slope = 0.15;     ///< steepest slope of the ground under objects, rise over run
  double window = 18;      ///< half the width of the largest object that is taken off the ground
  double threshold = 0.5;  ///< greatest distance of a ground point from the ground surface, where that is level
  double scaling = 1.25;   ///< how much the threshold grows with the slope of the surface
};

/// Which points of an airborne scan are ground: a simple morphological filter after Pingel, Clarke and McBride (ISPRS
/// Journal 77, 2013), which continues the progressive one of Zhang et al. (IEEE TGRS 41, 2003).
///
/// The lowest points of the cells of a grid make a surface. Cells far below all their neighbours are taken off as false
/// echoes. The surface is opened with discs of growing radius up to `window`; a cell that sinks in one step by more
/// than `slope` times the radius is an object. Without objects and false echoes the surface is filled by harmonic
/// interpolation, and a point is ground if it lies within `threshold + scaling * slope there` of it.
///
/// `points`: any origin, z up. Points that are not finite are no ground. Returns 1 or 0 for each point. Equal for any
/// number of threads, and under any shift of the points by whole cells.
/// Cost: O(cells * radius) a radius, where the radii in cells grow by a quarter, plus O(points).
/// @throws Error InvalidArgument if an option is not positive (slope, threshold, scaling: not negative) or not finite,
/// or if there are more than 4e8 cells; InvalidData if no point is finite.
std::vector<char> find_ground(const std::vector<Vec3>& points, const GroundOptions& options, const Execution& run = {});

}  // namespace kappa
