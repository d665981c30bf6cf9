// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace kappa {

/// The value that `p` percent, 0 to 100, of `values` do not exceed (nearest rank; 50 is the median), NaN if there is
/// none. May reorder the values, which must not be NaN. Cost: linear.
double percentile(std::vector<double>& values, double p);

/// The same of each of `p`, at little more cost than one.
std::vector<double> percentiles(std::vector<double>& values, const std::vector<double>& p);

}  // namespace kappa
