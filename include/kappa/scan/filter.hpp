// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kappa/core/bounds.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/core/names.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

// Which points of a scan are measured.
//
// Every filter selects. A point that stays keeps its place in the order and its record of the file, and keeps position,
// normal and fields to the bit. A point that goes is gone from the scan, and so from every file that is written of it.
// In an organised cloud, a grid of rows and columns, it stays as a point without a position, so that the grid stays
// one.

/// Which of the returns of a pulse are selected.
enum class Returns {
  All,
  First,  ///< those whose return number is 1
  Last    ///< those whose return number is the number of returns
};

/// The words for the returns: all, first, last.
const std::vector<Named<Returns>>& names_of(Returns);

/// A selection by attributes and place.
struct PointFilter {
  std::vector<int> classes;  ///< values of the field `classification` that are selected; empty: all
  Returns returns = Returns::All;
  /// A box in the coordinates of the file; none: everywhere. Its sides belong to it, and are moved outward by the
  /// rounding of coordinates. They may lie at infinity.
  std::optional<Bounds> bounds;
};

/// How many points a selection took away. A point counts once, at the first of these reasons that holds.
struct FilterCounts {
  std::size_t unplaced = 0;    ///< it has no position; 0 for organised clouds, in which such points stay
  std::size_t by_class = 0;    ///< its class is not selected
  std::size_t by_returns = 0;  ///< its return is not selected
  std::size_t by_bounds = 0;   ///< it lies outside the box
};

/// Selects points of a cloud. Fields are found whatever their case and underscores are: `classification` or `class`,
/// `return_number`, and `number_of_returns`. A filter that asks for nothing changes nothing, and its counts are 0.
/// `path` is the file that messages name.
/// @throws Error InvalidData if the scan lacks a field that is asked for, if all return numbers are 0 and so were not
/// recorded, or if no point is left; InvalidArgument if the scan has faces, or if a side of the box is NaN or lies
/// beyond its opposite side; Cancelled.
FilterCounts select_points(Scan& scan, const PointFilter& filter, const std::string& path, const Execution& run = {});

/// Takes away the points for which `kept` is 0. `kept` has one mark for each point.
/// @throws Error InvalidArgument if it has not, or if the scan has faces; Cancelled.
void leave_out(Scan& scan, const std::vector<char>& kept, const Execution& run = {});

/// The points of a cloud at exactly (0, 0, 0) in the coordinates of the file that stand for pulses without a return, as
/// spinning scanners store them. These are all points there, of either sign of zero, if they are at least 10 and more
/// than 1 in 1000 of the points; else there are none. So often a scan meets only the place of the scanner itself, which
/// the scanner does not see; a few points at the origin are taken for what they say. A mesh has none.
std::vector<Index> find_no_returns(const Scan& scan);

/// The points of a cloud that have a position and are flagged as withheld: the value 1 of a field `withheld`, found as
/// `select_points` finds fields. It is a flag of LAS files for points that "should not be included in processing
/// (synonymous with Deleted)" (LAS 1.4, classification flags). A mesh has none.
std::vector<Index> find_withheld(const Scan& scan);

/// Takes the position of some points away (NaN), so that they are not measured, and gives it back later. All points
/// keep their places in the scan.
class SetAside {
 public:
  /// Sets the points with the indices `points` aside.
  /// @throws Error InvalidArgument if an index is not below the number of points; the scan is then untouched.
  SetAside(Scan& scan, std::vector<Index> points);
  /// Gives the positions back, to the sign of a zero. If points were taken away since, nothing happens: points without
  /// a position are the first to go.
  void restore(Scan& scan) const;
  /// The number of points that were set aside.
  std::size_t size() const { return indices_.size(); }

 private:
  std::size_t points_;
  std::vector<Index> indices_;
  std::vector<Vec3> positions_;
};

}  // namespace kappa
