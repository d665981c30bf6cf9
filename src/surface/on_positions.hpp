// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../search/positions.hpp"
#include "kappa/surface/cloud_scale.hpp"
#include "kappa/surface/umbrella.hpp"

namespace kappa {

/// The public functions of these names over positions that are searched once for all of them.
CloudScale measure_scale(const Positions& positions, const Execution& run);
CloudSurface umbrella_surface(const Vec3& origin, const std::vector<Vec3>& points, const Positions& positions,
                              const Normals& normals, const UmbrellaOptions& options, const Execution& run);

}  // namespace kappa
