// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/scan/filter.hpp"
#include "kappa/scan/ground.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/scan/units.hpp"

namespace kappa {

/// How the ground of an airborne scan is found. What is not given is the default of the method, lengths in metres where
/// the file states its unit, else in units of the points.
struct GroundFilter {
  GroundMethod method = GroundMethod::Morphological;
  std::optional<double> cell;    ///< of the grid; length
  std::optional<double> slope;   ///< rise over run above which it is an object
  std::optional<double> window;  ///< half the width of the largest object, for Progressive the largest window; length
  std::optional<double> threshold;  ///< distance of ground from its surface; length
  std::optional<double> scaling;    ///< growth of that with the slope; Morphological only
  std::optional<double> max_rise;   ///< greatest rise in a window; length, Progressive only
  /// What Progressive calls with the points and the length of a metre in their unit: 1 or 0 for each point. The filter
  /// of PCL stands in a room above: `progressive_ground` (kappa/pcl/ground.hpp).
  std::function<std::vector<char>(const std::vector<Vec3>& points, const GroundFilter& filter, double metre)>
      progressive;
};

/// What becomes of points that their file flags as withheld.
enum class Withheld {
  SetAside,  ///< they keep their rows and are not measured
  Measured   ///< they count as any other point
};

/// Which points of a scan are measured, and in what unit. The filters act in this order.
struct FilterOptions {
  Withheld withheld = Withheld::SetAside;
  PointFilter points;
  std::optional<GroundFilter> ground;  ///< if given, only the ground stays
  double voxel = 0;                    ///< edge of the cubes of which each keeps one point; length, 0 keeps all
  std::optional<double> z_scale;       ///< units of x and y in a unit of height; none: 1
};

/// @throws OptionError that names the member: `voxel` or `z_scale` out of range, `ground.max_rise` or `ground.scaling`
/// given for the other method, `ground.method` without the function that it needs.
void validate(const FilterOptions& options);

/// What was done to a scan before it is measured.
struct FilteredScan {
  std::size_t points = 0;  ///< in the file
  FilterCounts selected;
  std::size_t objects = 0, thinned = 0;  ///< taken away as no ground, and for others in their cell
  std::optional<SetAside> no_returns, withheld;
  HeightUnit heights;

  /// Gives the filtered scan the heights and positions of the file again.
  void restore(Scan& scan) const;
};

/// Leaves in `scan` the points that are asked for, and brings it into the unit of x and y. `name` is what messages call
/// it, such as the path of its file.
/// @throws Error as the filters do; Cancelled, which leaves the scan as far as the filters came.
FilteredScan filter_scan(Scan& scan, const std::string& name, const FilterOptions& options, const Execution& run = {});

/// One sentence for a scan whose file states another unit for heights than for x and y where no `z_scale` is given,
/// with the factor to give; empty if there is nothing to say.
std::string unit_warning(const Scan& scan, const std::string& name, const FilterOptions& options);

}  // namespace kappa
