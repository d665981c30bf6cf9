// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace kappa {

/// The value of rank p/100 (n - 1) among the n `values` in increasing order; the rank is rounded to the nearest whole
/// number. So 0 gives the least value and 100 the greatest.
///
/// `p` is in [0, 100], and no value is NaN; neither is checked. The values may change their places. The result is NaN
/// if there are none. Cost: linear.
double percentile(std::vector<double>& values, double p);

/// The percentiles of each of `p`, at little more cost than one of them.
std::vector<double> percentiles(std::vector<double>& values, const std::vector<double>& p);

/// The median: percentile 50. Of an even number of values it is the greater of the two in the middle.
double median(std::vector<double>& values);

}  // namespace kappa
