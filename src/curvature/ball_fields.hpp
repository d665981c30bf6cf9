// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "kappa/curvature/in_balls.hpp"

namespace kappa {

/// Is told of the balls of centre `q` at radius number `r`, the largest first. From any thread, once a centre and
/// radius.
using BallObserver = std::function<void(std::size_t r, std::size_t q, const BallMeasures* const* balls)>;

/// `curvatures_in_balls`, telling `observe`, if it is not empty, of all balls.
std::vector<CurvatureField> ball_fields(const BallSum& balls, const std::vector<Vec3>& centres, const Normals& u,
                                        const BallPlan& plan, const BallObserver& observe, const Execution& run);

}  // namespace kappa
