// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// Fits the plane of least squares to the finite, distinct points in the closed ball of `radius` around each; the zero
/// vector where they are fewer than `least` or do not span a plane. Of more than kMostInBall candidates around a point
/// every m-th is taken.
/// Points are visited cell by cell of a grid, whose candidates lie side by side in memory: many times faster than a
/// search for as many nearest neighbours.
Normals ball_planes(const std::vector<Vec3>& points, double radius, std::size_t least, const Execution& run);
inline constexpr std::size_t kMostInBall = 8192;

/// Normal of the plane of least squares of `count` points of first moments `sum` and second moments `products` about a
/// place among them; the zero vector if they are collinear or fewer than three.
Vec3 plane_of_moments(double count, const Vec3& sum, const Mat3& products);

}  // namespace kappa
