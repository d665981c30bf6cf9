// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"
#include "kappa/search/fitted_normals.hpp"

namespace kappa {

class PointBlocks;

/// Fits to the distinct points in the closed ball of `radius` around each; the zero vector where they are fewer than
/// `least`, do not span a plane, or leave a quadric residuals of more than `most_variance`. Of more than kMostInBall
/// candidates around a point every m-th is taken. Points that follow each other share their candidates: many times
/// faster than a search for as many nearest neighbours.
Normals ball_normals(const PointBlocks& points, double radius, std::size_t least, NormalFit fit, double most_variance,
                     const Execution& run);
inline constexpr std::size_t kMostInBall = 8192;

/// By how much the ball of a quadric grows where the centroid of its `count` points lies `offset` radii from its
/// centre: 1 up to what uneven sampling explains, a tenth and 1 / sqrt(count), 2 from the offset of half a disc on. At
/// the end of an interval the slope of a parabola of least squares has 16 times the variance that it has in the middle,
/// and the fourth power of the length of the interval lowers it.
double growth_of_ball(double offset, std::size_t count);

}  // namespace kappa
