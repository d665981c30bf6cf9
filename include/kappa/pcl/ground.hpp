// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/types.hpp"
#include "kappa/pipeline/filter_scan.hpp"

namespace kappa {

/// Parameters of PCL's progressive morphological filter, by what PCL calls them. Lengths are in units of the points;
/// the defaults are for metres.
struct ProgressiveGroundOptions {
  double cell = 1;                ///< setCellSize
  double slope = 1;               ///< setSlope
  int window = 20;                ///< setMaxWindowSize: windows grow as 2 * 2^k + 1 cells up to this many units
  double initial_distance = 0.5;  ///< setInitialDistance: greatest rise in the first window
  double max_distance = 3;        ///< setMaxDistance: greatest rise in any
};

/// Which points are ground by pcl::ProgressiveMorphologicalFilter: 1 or 0 for each, 0 for those that are not finite.
/// The points, in floats there, should be relative to a local origin. For comparison: `find_ground`
/// (surface/ground.hpp) makes fewer errors in less time.
/// @throws Error InvalidArgument if an option is not positive (slope, initial_distance: not negative).
std::vector<char> find_ground_progressively(const std::vector<Vec3>& points, const ProgressiveGroundOptions& options);

/// The same as the pipeline asks for it: what GroundFilter::progressive takes. `metre` is the length of a metre in the
/// unit of the points, which the defaults are multiplied by.
std::vector<char> progressive_ground(const std::vector<Vec3>& points, const GroundFilter& filter, double metre);

}  // namespace kappa
