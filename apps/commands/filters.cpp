// SPDX-License-Identifier: BSD-3-Clause
#include "filters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "checks.hpp"
#include "kappa/core/bounds.hpp"
#include "kappa/core/error.hpp"
#include "kappa/io/las/file.hpp"
#include "kappa/pcl/ground.hpp"
#include "kappa/scan/ground.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/scan/thin.hpp"
#include "kappa/scan/units.hpp"
#include "surface_options.hpp"

namespace kappa::app {
namespace {

void declare_ground(CLI::App& command, FilterArguments& options) {
  command
      .add_flag("--ground{smrf}", options.ground,
                "Leave the ground of an airborne scan; --ground=pmf: by PCL's progressive morphological filter")
      ->check(CLI::IsMember({"smrf", "pmf"}));
  const auto add = [&](const char* name, std::optional<double>& value, const char* help) {
    command.add_option(name, value, help)->check(not_negative())->needs("--ground");
  };
  add("--ground-cell", options.ground_cell, "Cell of the ground filter; default 1 m");
  add("--ground-slope", options.ground_slope, "Rise over run above which it is an object; default 0.15, pmf 1");
  add("--ground-window", options.ground_window,
      "Half the width of the largest object; default 18 m, pmf largest window 20 m");
  add("--ground-threshold", options.ground_threshold, "Distance of ground from its surface; default 0.5 m");
  add("--ground-scaling", options.ground_scaling, "Growth of that with the slope; default 1.25, not for pmf");
  add("--ground-max", options.ground_max, "Greatest rise in a window, for pmf alone; default 3 m");
}

Bounds parse_bounds(const std::string& text) {
  const char* const option = "--bounds";
  const auto commas = std::count(text.begin(), text.end(), ',');
  if (commas != 3 && commas != 5)
    throw CLI::ValidationError(option, "'" + text + "' is not XMIN,YMIN,XMAX,YMAX or ...,ZMIN,ZMAX");
  const std::vector<double> v = parse_numbers(option, text, static_cast<std::size_t>(commas) + 1);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{{v[0], v[1], -kInfinity}, {v[2], v[3], kInfinity}};
  if (commas == 5) {
    bounds.min.z() = v[4];
    bounds.max.z() = v[5];
  }
  if ((bounds.min.array() <= bounds.max.array()).all()) return bounds;
  throw CLI::ValidationError(option, "'" + text + "' has a least coordinate above the greatest");
}

/// `metre`: one in the unit of the points.
std::vector<char> ground_by_smrf(const std::vector<Vec3>& points, const FilterArguments& arguments, double metre,
                                 const Execution& run) {
  GroundOptions options;
  options.cell = arguments.ground_cell.value_or(options.cell * metre);
  options.slope = arguments.ground_slope.value_or(options.slope);
  options.window = arguments.ground_window.value_or(options.window * metre);
  options.threshold = arguments.ground_threshold.value_or(options.threshold * metre);
  options.scaling = arguments.ground_scaling.value_or(options.scaling);
  return find_ground(points, options, run);
}

std::vector<char> ground_by_pmf(const std::vector<Vec3>& points, const FilterArguments& arguments, double metre) {
  ProgressiveGroundOptions options;
  options.cell = arguments.ground_cell.value_or(options.cell * metre);
  options.slope = arguments.ground_slope.value_or(options.slope);
  options.window = static_cast<int>(std::lround(arguments.ground_window.value_or(options.window * metre)));
  options.initial_distance = arguments.ground_threshold.value_or(options.initial_distance * metre);
  options.max_distance = arguments.ground_max.value_or(options.max_distance * metre);
  return find_ground_progressively(points, options);
}

std::vector<Vec3> with_heights_scaled(std::vector<Vec3> points, double z_scale) {
  for (Vec3& p : points) p.z() *= z_scale;
  return points;
}

/// Takes away what is no ground.
std::size_t keep_ground(Scan& scan, const std::string& path, const FilterArguments& arguments, double z_scale,
                        const Execution& run) {
  if (scan.is_mesh())
    throw Error(ErrorCode::InvalidArgument, "'" + path + "' is a mesh, whose faces need all points; give a cloud");
  const double metre = 1 / scan.units.horizontal.value_or(1);
  const std::vector<Vec3> points = with_heights_scaled(scan.points, z_scale);
  const std::vector<char> ground = arguments.ground == "pmf" ? ground_by_pmf(points, arguments, metre)
                                                             : ground_by_smrf(points, arguments, metre, run);
  const auto kept = static_cast<std::size_t>(std::count(ground.begin(), ground.end(), 1));
  if (kept == 0) throw Error(ErrorCode::InvalidData, "'" + path + "': no point is ground; leave --ground out");
  leave_out(scan, ground);
  return ground.size() - kept;
}

SetAside set_withheld_aside(Scan& scan, const std::string& path) {
  SetAside withheld(scan, find_withheld(scan));
  const bool any_left = std::any_of(scan.points.begin(), scan.points.end(), [](const Vec3& p) { return is_finite(p); });
  if (withheld.size() > 0 && !any_left)
    throw Error(ErrorCode::InvalidData,
                "'" + path + "': every point is flagged as withheld; give --withheld to measure them all the same");
  return withheld;
}

std::size_t size_of(const std::optional<SetAside>& points) {
  return points ? points->size() : 0;
}

std::array<std::pair<const char*, std::size_t>, 6> counts_of(const Filtered& f) {
  return {{{"unplaced", f.selected.unplaced},
           {"class", f.selected.by_class},
           {"return", f.selected.by_returns},
           {"bounds", f.selected.by_bounds},
           {"ground", f.objects},
           {"voxel", f.thinned}}};
}

}  // namespace

void declare(CLI::App& command, FilterArguments& options) {
  command.add_option("--class", options.points.classes, "Only points of these classes, as 2 for the ground of a LAS")
      ->delimiter(',')
      ->check(CLI::Range(0, 255))
      ->option_text("N[,N...]");
  command.add_option("--returns", options.points.returns, "first, last or all returns of each pulse")
      ->transform(choice<Returns>({{"all", Returns::All}, {"first", Returns::First}, {"last", Returns::Last}}))
      ->option_text("WHICH=all");
  command
      .add_option("--bounds", options.bounds,
                  "Only points within XMIN,YMIN,XMAX,YMAX[,ZMIN,ZMAX] in the coordinates of the file")
      ->option_text("X,Y,X,Y[,Z,Z]");
  command.add_flag("--withheld", options.withheld, "Measure points that are flagged as withheld, too");
  command.add_option("--voxel", options.voxel, "Thin to one point (nearest to the mean) in each cube of this size")
      ->check(positive())
      ->option_text("SIZE");
  command.add_option("--z-scale", options.z_scale, "Units of x and y in a unit of height, where they differ")
      ->check(positive())
      ->option_text("S=1");
  declare_ground(command, options);
}

void check(const FilterArguments& arguments) {
  if (!arguments.bounds.empty()) parse_bounds(arguments.bounds);
  const bool pmf = arguments.ground == "pmf";
  if (arguments.ground_max && !pmf) throw CLI::ValidationError("--ground-max", "is for --ground=pmf");
  if (arguments.ground_scaling && pmf) throw CLI::ValidationError("--ground-scaling", "is not for --ground=pmf");
}

void Filtered::restore(Scan& scan) const {
  heights.restore(scan);
  if (withheld) withheld->restore(scan);
  if (no_returns) no_returns->restore(scan);
}

std::size_t Filtered::taken_away() const {
  std::size_t sum = 0;
  for (const auto& [name, count] : counts_of(*this)) sum += count;
  return sum;
}

Filtered filter(Scan& scan, const std::string& path, const FilterArguments& arguments, const Execution& run) {
  PointFilter points = arguments.points;
  if (!arguments.bounds.empty()) points.bounds = parse_bounds(arguments.bounds);
  Filtered f;
  f.points = scan.points.size();
  f.heights = HeightUnit(arguments.z_scale.value_or(1));
  f.no_returns.emplace(scan, find_no_returns(scan));
  if (!arguments.withheld) f.withheld = set_withheld_aside(scan, path);
  f.selected = select_points(scan, points, path);
  const double z_scale = f.heights.z_scale();
  if (!arguments.ground.empty()) f.objects = keep_ground(scan, path, arguments, z_scale, run);
  if (arguments.voxel > 0) f.thinned = thin(scan, Vec3(1, 1, 1 / z_scale) * arguments.voxel, path);
  f.heights.apply(scan);
  return f;
}

std::string unit_warning(const Scan& scan, const std::string& path, const FilterArguments& arguments) {
  const double factor = scan.units.z_scale();
  if (arguments.z_scale || factor == 1) return "";
  std::array<char, 32> number;
  std::snprintf(number.data(), number.size(), "%.10g", factor);
  return path +
         ": its coordinate system states another unit for heights than for x and y, so that curvatures are wrong; "
         "give --z-scale " +
         number.data();
}

std::string describe(const Filtered& f) {
  std::string text;
  for (const auto& [name, count] : counts_of(f)) {
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) +
            (std::string(name) == "unplaced" ? " without a position" : std::string(" by ") + name);
  }
  if (!text.empty()) text = std::to_string(f.points) + " points read; taken away: " + text;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : "; ") + std::to_string(count) + what;
  };
  add(size_of(f.no_returns), " points at (0, 0, 0) are taken for no returns");
  add(size_of(f.withheld), " points are flagged as withheld and not measured (--withheld measures them)");
  return text;
}

Json to_json(const Filtered& f) {
  Json json;
  json.add("points_read", f.points).add("no_returns", size_of(f.no_returns)).add("withheld", size_of(f.withheld));
  for (const auto& [name, count] : counts_of(f)) json.add(name, count);
  return json.add("z_scale", f.heights.z_scale());
}

}  // namespace kappa::app
