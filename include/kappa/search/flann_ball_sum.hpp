// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/balls/ball_sum.hpp"

namespace kappa {

/// Ball sums by a FLANN radius search over the centroids of the triangles, the reference engine.
///
/// Triangles are sorted in classes by the octave of their bounding radius around the centroid, one
/// index a class, so that one huge triangle does not widen every search. A triangle that the search
/// places inside the ball is added whole, those at the rim by exact intersection, many at a time
/// with the kernels of MeasureTree. Equal to BruteForceBallSum to 1e-12 of the sum of absolute
/// values in the ball.
/// Cost: about linear in the number of triangles in the ball.
class FlannBallSum final : public BallSum {
 public:
  /// @throws Cancelled
  explicit FlannBallSum(Triangles triangles, const Execution& run = {});
  ~FlannBallSum() override;
  const Triangles& triangles() const override;
  MeasureSum measures_of(std::size_t triangle) const override;

 private:
  void do_sum(const std::vector<Vec3>& centres, const BallRadii& radii, BallDefinition ball, const Execution& run,
              const Sink& sink) const override;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace kappa
