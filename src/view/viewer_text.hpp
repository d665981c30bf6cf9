// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "kappa/scan/scan.hpp"
#include "kappa/view/viewer.hpp"

namespace kappa::view_detail {

/// "file.ply | 1 000 points, 2 000 faces | radius 2 | mean curvature -0.1 ... 0.1 1/m". Of `file` the name is shown,
/// without its folders. Data that a file holds are called so: "radius 2 of the file", "values of the file".
std::string status_text(const Scan& scan, const std::string& file, const ViewerState& state, const std::string& unit,
                        double progress);

/// Index of a point, its coordinates in the system of the file, its status, its label, and its value in each field.
std::string pick_text(const Scan& scan, const ViewData& data, Index point);

/// `value` with six significant digits.
std::string number_text(double value);

}  // namespace kappa::view_detail
