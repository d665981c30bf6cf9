// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/balls/ball_sum.hpp"
#include "kappa/curvature/field.hpp"

namespace kappa {

/// A point that curvature can be asked for at.
bool usable(const Vec3& x, const Vec3& u);

/// Ratios of a ball at a point of normal `u`; Empty if it meets no face.
CurvatureRatios ratios_of(const BallMeasures& ball, const Vec3& u);

/// The sample of a point from the measures of the balls of its order, the first of `radius`, 0 at a vertex limit.
CurvatureSample make_sample(const BallMeasures* const* balls, int order, double radius, const Vec3& u);

}  // namespace kappa
