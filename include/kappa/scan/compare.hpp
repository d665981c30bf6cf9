// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/scan/scan.hpp"

namespace kappa {

/// Statistics of the differences between two lists of numbers, over the entries where both are finite.
struct ErrorStatistics {
  std::string field;
  std::size_t compared = 0, missing = 0;       ///< missing: NaN or infinite in one of the two, or in both
  double max = kNaN, rms = kNaN, mean = kNaN;  ///< of |a - b|; mean: of a - b, the bias
  double p50 = kNaN, p90 = kNaN, p99 = kNaN;   ///< percentiles of |a - b|
  double truth_rms = kNaN;                     ///< rms of b, to judge the rest by
};

/// @throws Error InvalidArgument if sizes differ.
ErrorStatistics compare_values(const std::vector<double>& result, const std::vector<double>& truth);

/// Statistics of every curvature field that both scans have (mean_curvature, gaussian_curvature, k_min, k_max), and of
/// the angles, in degrees, between their principal directions, whose sign does not count (dir_min, dir_max).
/// `suffix` is that of the fields of the result ("_r0.5").
/// @throws Error InvalidData if the points are not equally many, if no field is common, or if a point lies farther from
/// that of the truth than `position_tolerance` (a length, for noisy results) or 1e-6 of the extent.
std::vector<ErrorStatistics> compare_scans(const Scan& result, const Scan& truth, const std::string& suffix = "",
                                           double position_tolerance = 0);

}  // namespace kappa
