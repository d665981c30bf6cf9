// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "positions.hpp"

namespace kappa {

/// What the quadric in a ball around a point says of the surface there.
struct BallFit {
  Vec3 normal = Vec3::Zero();     ///< zero where the points do not fix a quadric, or a smaller ball's did not
  double normal_variance = kNaN;  ///< of the normal, both components, for noise of variance 1
  double mean = kNaN;             ///< mean curvature, on the side of the normal
  double mean_variance = kNaN;    ///< likewise
  bool lopsided = false;          ///< the ball reaches over a border or a gap
};

/// Balls whose radii grow by sqrt(2).
inline constexpr int kRungs = 8;
using GrowingBalls = std::array<BallFit, kRungs>;
inline constexpr double kSmallestBall = 2.5;  ///< radius in spacings
double radius_of_rung(int rung, double spacing);

/// Quadrics in balls around the point `at`, each over the plane of its own points: that of a few noisy points is too
/// steep for a wide ball.
GrowingBalls fit_growing_balls(const Positions& positions, Index at, double spacing);

}  // namespace kappa
