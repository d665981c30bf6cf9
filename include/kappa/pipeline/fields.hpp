// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/segment/regions.hpp"

namespace kappa {

/// The fields of a result, one value a sample, each name followed by `suffix`. In this order:
/// (a) mean_curvature gaussian_curvature k_min k_max dir_min_x dir_min_y dir_min_z dir_max_x dir_max_y dir_max_z mu0
///     mu1 mu2 area coverage face_count status;
/// (b) std_error, where bias was cancelled (the order of `field` is not 1);
/// (c) radius order, where every sample has its own scale.
/// Value i is the value of sample order[i]; of sample i if `order` is empty.
/// @throws Error InvalidArgument if `order` is neither empty nor one place for each sample; Cancelled.
std::vector<Field> curvature_fields(const CurvatureField& field, const std::string& suffix = "",
                                    const std::vector<Index>& order = {}, const Execution& run = {});

/// The fields `label` and `region`, one value a sample.
std::vector<Field> segment_fields(const Segmentation& segmentation);

/// "_r<radius>" with the shortest decimal that gives back the radius: the suffix of the fields of that radius.
std::string radius_suffix(double radius);

}  // namespace kappa
