// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "kappa/scan/scan.hpp"
#include "kappa/view/viewer.hpp"

namespace kappa::view_detail {

/// "file | 1 000 points, 2 000 faces | radius 2 | mean curvature -0.1 ... 0.1 1/m".
std::string status_text(const Scan& scan, const std::string& file, const ViewerState& state, const std::string& unit,
                        double progress);

/// Index, coordinates in those of the file, status, label and all values of a point.
std::string pick_text(const Scan& scan, const ViewData& data, Index point);

/// The keys, a line each.
std::string help_text();

/// Six significant digits.
std::string number_text(double value);

}  // namespace kappa::view_detail
