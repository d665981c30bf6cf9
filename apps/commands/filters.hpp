// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "json.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/scan/filter.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/scan/units.hpp"

namespace kappa::app {

/// Options that say which points of a scan are measured, and in what unit.
struct FilterArguments {
  PointFilter points;
  std::string bounds;
  double voxel = 0;               ///< 0: all points stay
  std::optional<double> z_scale;  ///< none: 1
  bool withheld = false;          ///< measure points that are flagged so, too
  std::string ground;             ///< "smrf" or "pmf", empty: objects stay
  std::optional<double> ground_cell, ground_slope, ground_window, ground_threshold, ground_scaling, ground_max;
};
void declare(CLI::App& command, FilterArguments& options);

/// @throws CLI::ValidationError if options contradict each other or bounds are malformed: to be called before any work.
void check(const FilterArguments& arguments);

/// What was done to a scan before it is measured.
struct Filtered {
  std::size_t points = 0;  ///< in the file
  FilterCounts selected;
  std::size_t objects = 0, thinned = 0;  ///< taken away as no ground, and for others in their cell
  std::optional<SetAside> no_returns, withheld;
  HeightUnit heights;

  /// Gives a filtered scan the heights and positions of the file again.
  void restore(Scan& scan) const;
  std::size_t taken_away() const;
};

/// Leaves in `scan`, which was read from `path`, the points that are asked for, and brings it into the unit of x and y.
/// @throws Error as the filters do.
Filtered filter(Scan& scan, const std::string& path, const FilterArguments& arguments, const Execution& run);

/// One sentence on heights in another unit than x and y, with the option to give; empty if there is nothing to say.
std::string unit_warning(const Scan& scan, const std::string& path, const FilterArguments& arguments);

/// What a filter did, for people; empty if nothing.
std::string describe(const Filtered& filtered);
Json to_json(const Filtered& filtered);

}  // namespace kappa::app
