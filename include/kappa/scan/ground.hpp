// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/names.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// How the ground of an airborne scan is told from what stands on it.
enum class GroundMethod {
  Morphological,  ///< `find_ground`
  Progressive     ///< PCL's filter: `find_ground_progressively` of kappa/pcl/ground.hpp
};

/// The words for the methods: smrf, pmf.
const std::vector<Named<GroundMethod>>& names_of(GroundMethod);

/// The parameters of `find_ground`. Lengths are in units of the points; the defaults are for metres. Their errors on
/// the ISPRS samples are in experiments/results/ground-samples.csv.
struct GroundOptions {
  double cell = 1;         ///< edge of the cells of the grid, > 0
  double slope = 0.15;     ///< steepest slope of the ground under objects, rise over run, >= 0
  double window = 18;      ///< half the width of the largest object that is taken off the ground, > 0
  double threshold = 0.5;  ///< greatest distance of a ground point from the ground surface where it is level, >= 0
  double scaling = 1.25;   ///< growth of the threshold with the slope of the ground surface, >= 0
};

/// Which points of an airborne scan are ground: a simple morphological filter (Pingel, Clarke, McBride, ISPRS Journal
/// 77, 2013), which continues the progressive one of Zhang et al. (IEEE TGRS 41(4), 2003).
///
/// 1. The lowest points of the cells of a grid make a surface. Empty cells are filled by harmonic interpolation.
/// 2. Cells far below all their neighbours are false echoes and are taken off.
/// 3. The surface is opened with discs of growing radius, up to `window`. A cell that sinks in one step by more than
///    `slope` times the radius belongs to an object.
/// 4. The surface is filled again without objects and false echoes. A point is ground if it lies within
///    threshold + scaling * (slope of the surface there) of it.
///
/// `points` are in any local frame with z up. The result has 1 for each point that is ground, and 0 for all others; a
/// point that is not finite is no ground. It is the same for every number of threads, and if all points are shifted by
/// whole cells.
/// Cost: cells * radius for each radius (in cells, growing by a quarter), and linear in the points.
/// @throws Error InvalidArgument if an option is out of its range, or if there would be more than 4e8 cells;
/// InvalidData if no point is finite; Cancelled.
std::vector<char> find_ground(const std::vector<Vec3>& points, const GroundOptions& options, const Execution& run = {});

}  // namespace kappa
