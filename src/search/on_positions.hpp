// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/search/noise.hpp"
#include "positions.hpp"

namespace kappa {

/// The public function of this name over positions that are searched once for all who need them.
CloudScale measure_scale(const Positions& positions, const Execution& run);

}  // namespace kappa
