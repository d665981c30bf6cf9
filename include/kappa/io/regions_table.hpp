// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"
#include "kappa/segment/regions.hpp"

namespace kappa {

/// Table of the regions as CSV: region label points area border mean_curvature gaussian_curvature
/// centroid_x centroid_y centroid_z (in the coordinates of the file).
void write_regions(const std::string& path, const Segmentation& segmentation, const Vec3& origin,
                   const Execution& run = {});

}  // namespace kappa
