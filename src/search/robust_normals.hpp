// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/search/fitted_normals.hpp"
#include "positions.hpp"

namespace kappa {

/// Normals of NormalFit::Robust; the zero vector where the neighbours span no plane.
Normals robust_normals(const Positions& positions, const NormalFitOptions& options, const Execution& run);

}  // namespace kappa
