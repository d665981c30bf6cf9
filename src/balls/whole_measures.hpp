// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/balls/triangles.hpp"
#include "kernels/views.hpp"

namespace kappa {

static_assert(sizeof(MeasureSum) == kernels::kSums * sizeof(double), "kernels add a MeasureSum as 9 doubles");
static_assert(sizeof(std::array<Index, 3>) == 3 * sizeof(std::uint32_t) && sizeof(Vec3) == 3 * sizeof(double),
              "kernels read corners and vectors as plain arrays");

/// The arrays that kernels see; `measures` are those of the triangles, or empty if they are not kept. To be made once:
/// it looks at all weights.
kernels::TriangleView view_of(const Triangles& triangles, const std::vector<MeasureSum>& measures);

/// The public function of this name with the kernels of one instruction set; all give the same bits.
std::vector<MeasureSum> measure_triangles(const Triangles& triangles, const kernels::Table& table,
                                          const Execution& run);

}  // namespace kappa
