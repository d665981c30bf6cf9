// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kappa/core/bounds.hpp"
#include "kappa/core/names.hpp"
#include "kappa/scan/scan.hpp"

/// Which points of a scan are measured, and in what unit.
///
/// Every filter selects: points that stay keep their place in the order, their position, normal and fields to the bit,
/// and their LAS record. Points that go are gone from the scan and from whatever is written of it; only in an organised
/// cloud (a grid of rows and columns) they stay as points without a position, so that the grid stays one.
namespace kappa {

/// Which of the returns of one pulse.
enum class Returns {
  All,
  First,  ///< return number 1
  Last    ///< return number = number of returns
};

const std::vector<Named<Returns>>& names_of(Returns);

/// A selection by attributes and place.
struct PointFilter {
  std::vector<int> classes;  ///< those of the field `classification` that stay; empty: all
  Returns returns = Returns::All;
  std::optional<Bounds>
      bounds;  ///< in the coordinates of the file, borders included (to their rounding); may be infinite
};

/// How many points a selection took away; a point counts at the first of these that refuses it.
struct FilterCounts {
  std::size_t unplaced = 0;  ///< without a position; 0 in organised clouds, where they stay
  std::size_t by_class = 0, by_returns = 0, by_bounds = 0;
};

/// Selects points. Fields are found by name whatever the case and underscores: classification, or class; return_number
/// and number_of_returns. A filter that asks for nothing changes nothing and does not count.
/// @throws Error, naming `path`: InvalidData if the scan lacks a field that is asked for, if its return numbers were
/// not recorded (all 0), or if no point is left; InvalidArgument if it has faces, or a bound is NaN or reversed.
FilterCounts select_points(Scan& scan, const PointFilter& filter, const std::string& path);

/// Leaves out every point for which `kept` is 0 (see above for organised clouds); sizes must agree.
/// @throws Error InvalidArgument if they do not, or if the scan has faces.
void leave_out(Scan& scan, const std::vector<char>& kept);

/// Points of a cloud at exactly (0, 0, 0) in the coordinates of the file that stand for no return, as spinning scanners
/// store them: all such points if they are at least 10 and more than 1 in 1000 of the points, else none. A place at
/// which a scan was really measured is met that often only where the scanner itself stands, and the scanner does not
/// see itself; a few points at the origin (both signs of zero) are taken for what they say. Meshes have none.
std::vector<Index> find_no_returns(const Scan& scan);

/// Points that have a position and are flagged as withheld (field `withheld`, found as `select_points` finds fields):
/// a flag of LAS files for a point that "should not be included in processing (synonymous with Deleted)" (LAS 1.4,
/// classification flags). Meshes have none.
std::vector<Index> find_withheld(const Scan& scan);

/// Takes the position (NaN) from some points, so that they are not measured, and gives it back: rows stay as they are.
class SetAside {
 public:
  /// @throws Error InvalidArgument if an index is not below the number of points.
  SetAside(Scan& scan, std::vector<Index> points);
  /// Nothing if points were taken away since: those without a position are the first to go.
  void restore(Scan& scan) const;
  std::size_t size() const { return indices_.size(); }

 private:
  std::size_t points_;
  std::vector<Index> indices_;
  std::vector<Vec3> positions_;  ///< before, to the sign of a zero
};

}  // namespace kappa
