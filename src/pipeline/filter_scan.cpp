// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pipeline/filter_scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/scan/thin.hpp"
#include "kappa/scan/units.hpp"

namespace kappa {
namespace {

std::vector<char> ground_of(const std::vector<Vec3>& points, const GroundFilter& filter, double metre,
                            const Execution& run) {
  if (filter.method == GroundMethod::Progressive) return filter.progressive(points, filter, metre);
  GroundOptions options;
  options.cell = filter.cell.value_or(options.cell * metre);
  options.slope = filter.slope.value_or(options.slope);
  options.window = filter.window.value_or(options.window * metre);
  options.threshold = filter.threshold.value_or(options.threshold * metre);
  options.scaling = filter.scaling.value_or(options.scaling);
  return find_ground(points, options, run);
}

std::vector<Vec3> with_heights_scaled(std::vector<Vec3> points, double z_scale) {
  for (Vec3& p : points) p.z() *= z_scale;
  return points;
}

/// Takes away what is no ground; returns how many points these are.
std::size_t keep_ground(Scan& scan, const std::string& name, const GroundFilter& filter, double z_scale,
                        const Execution& run) {
  if (scan.is_mesh())
    throw Error(ErrorCode::InvalidArgument, "'" + name + "' is a mesh, whose faces need all points; give a cloud");
  const double metre = 1 / scan.units.horizontal.value_or(1);
  const std::vector<char> ground =
      ground_of(with_heights_scaled(scan.points, z_scale), filter, metre, stage(run, 0.0, 0.9));
  const auto kept = static_cast<std::size_t>(std::count(ground.begin(), ground.end(), 1));
  if (kept == 0) throw Error(ErrorCode::InvalidData, "'" + name + "': no point is ground; leave --ground out");
  leave_out(scan, ground, stage(run, 0.9, 1.0));
  return ground.size() - kept;
}

SetAside set_withheld_aside(Scan& scan, const std::string& name) {
  SetAside withheld(scan, find_withheld(scan));
  const bool any_left = std::any_of(scan.points.begin(), scan.points.end(), [](const Vec3& p) { return is_finite(p); });
  if (withheld.size() > 0 && !any_left)
    throw Error(ErrorCode::InvalidData,
                "'" + name + "': every point is flagged as withheld; give --withheld to measure them all the same");
  return withheld;
}

}  // namespace

void validate(const FilterOptions& options) {
  if (!(options.voxel >= 0 && std::isfinite(options.voxel)))
    throw OptionError("voxel", "= " + std::to_string(options.voxel) + ": give a finite length, 0 to keep all points");
  if (options.z_scale && !(*options.z_scale > 0 && std::isfinite(*options.z_scale)))
    throw OptionError("z_scale", "= " + std::to_string(*options.z_scale) + ": give a positive, finite number");
  if (!options.ground) return;
  const bool progressive = options.ground->method == GroundMethod::Progressive;
  if (options.ground->max_rise && !progressive) throw OptionError("ground.max_rise", "is for `ground.method` pmf");
  if (options.ground->scaling && progressive) throw OptionError("ground.scaling", "is not for `ground.method` pmf");
  if (progressive && !options.ground->progressive)
    throw OptionError("ground.method",
                      "pmf needs a function that finds the ground (ground.progressive); give progressive_ground of "
                      "kappa's room pcl, or take smrf");
}

void FilteredScan::restore(Scan& scan) const {
  heights.restore(scan);
  if (withheld) withheld->restore(scan);
  if (no_returns) no_returns->restore(scan);
}

FilteredScan filter_scan(Scan& scan, const std::string& name, const FilterOptions& options, const Execution& run) {
  validate(options);
  FilteredScan f;
  f.points = scan.points.size();
  f.heights = HeightUnit(options.z_scale.value_or(1));
  f.no_returns.emplace(scan, find_no_returns(scan));
  if (options.withheld == Withheld::SetAside) f.withheld = set_withheld_aside(scan, name);
  f.selected = select_points(scan, options.points, name, stage(run, 0.1, 0.2));
  const double z_scale = f.heights.z_scale();
  if (options.ground) f.objects = keep_ground(scan, name, *options.ground, z_scale, stage(run, 0.2, 0.7));
  const Vec3 cell = Vec3(1, 1, 1 / z_scale) * options.voxel;
  if (options.voxel > 0) f.thinned = thin(scan, cell, name, stage(run, 0.7, 0.95));
  f.heights.apply(scan, stage(run, 0.95, 1.0));
  return f;
}

std::string unit_warning(const Scan& scan, const std::string& name, const FilterOptions& options) {
  const double factor = scan.units.z_scale();
  if (options.z_scale || factor == 1) return "";
  char number[32];
  std::snprintf(number, sizeof number, "%.10g", factor);
  return name +
         ": its coordinate system states another unit for heights than for x and y, so that curvatures are wrong; "
         "give --z-scale " +
         number;
}

}  // namespace kappa
