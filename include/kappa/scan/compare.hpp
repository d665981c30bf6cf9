// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

/// Statistics of the errors a - b of a result a with the truth b, over the points at which both are finite. They are
/// NaN if there is no such point.
struct ErrorStatistics {
  std::string field;                          ///< what was compared; empty from `compare_values`
  std::size_t compared = 0;                   ///< points at which both are finite
  std::size_t missing = 0;                    ///< all other points
  double max = kNaN, rms = kNaN;              ///< of |a - b|; rms: root of the mean square
  double mean = kNaN;                         ///< of a - b: the bias
  double p50 = kNaN, p90 = kNaN, p99 = kNaN;  ///< percentiles of |a - b|
  double truth_rms = kNaN;                    ///< root of the mean square of b, to judge the errors by
};

/// Compares two lists of numbers.
/// @throws Error InvalidArgument if their lengths differ; Cancelled.
ErrorStatistics compare_values(const std::vector<double>& result, const std::vector<double>& truth,
                               const Execution& run = {});

/// Compares the curvature fields that both scans have: mean_curvature, gaussian_curvature, k_min and k_max, in this
/// order, and then the principal directions dir_min and dir_max. The error of a direction is the angle between the two
/// lines in degrees; their signs do not count.
///
/// `suffix` stands behind the names of the fields of the result, such as "_r0.5". `position_tolerance` is the distance,
/// in units of the points, by which a point of the result may lie beside the point of the truth; a millionth of the
/// diagonal of the truth is allowed in any case.
/// @throws Error InvalidData if the scans differ in their number of points, a point lies farther away than allowed, or
/// no field is common to both; Cancelled.
std::vector<ErrorStatistics> compare_scans(const Scan& result, const Scan& truth, const std::string& suffix = "",
                                           double position_tolerance = 0, const Execution& run = {});

}  // namespace kappa
