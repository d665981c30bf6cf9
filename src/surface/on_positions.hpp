// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/surface/umbrella.hpp"
#include "search/on_positions.hpp"
#include "search/positions.hpp"

namespace kappa {

/// The public function of this name over positions that are searched once for all who need them.
CloudSurface umbrella_surface(const Vec3& origin, const std::vector<Vec3>& points, const Positions& positions,
                              const Normals& normals, const UmbrellaOptions& options, const Execution& run);

}  // namespace kappa
