// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/search/cloud_normals.hpp"

namespace kappa {

/// Normals of NormalFit::Robust of finite, distinct points; the zero vector where the neighbours span no plane.
Normals robust_normals(const std::vector<Vec3>& points, const NormalFitOptions& options, const Execution& run);

}  // namespace kappa
