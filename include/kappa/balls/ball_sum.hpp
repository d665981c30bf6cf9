// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "kappa/balls/triangles.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/core/measures.hpp"

namespace kappa {

/// What a face that the sphere cuts adds to its ball.
enum class BallDefinition {
  ExactDensity,  ///< integral of the density over the part inside: subdividing a face changes nothing
  AreaFraction   ///< measures of the face times the share of its area inside (Property 2 of the paper)
};

/// Measures of a ball, with the number of triangles (parts of polygons count singly) it meets.
struct BallMeasures {
  MeasureSum sum;
  Index face_count = 0;
};

/// Measures of triangle `t`'s part in the closed ball; adds nothing and returns false if they do not meet.
bool add_triangle_in_ball(const MeasuredTriangles& triangles, std::size_t t, const Vec3& centre, double radius,
                          BallDefinition ball, BallMeasures& to);

/// Sums the measures of triangles in balls. Engines differ in speed alone: their sums agree to
/// 1e-11 of the sum of absolute values.
class BallSum {
 public:
  virtual ~BallSum() = default;

  /// Receives the measures of the balls around centre `query`, one a radius in the order given.
  /// Called from any thread, once a query.
  using Sink = std::function<void(std::size_t query, const BallMeasures* per_radius)>;

  /// Measures of the closed balls of every radius around every centre (in the local coordinates of
  /// the triangles). A centre that is not finite gets empty balls.
  /// @throws Error InvalidArgument if a radius is not finite and positive.
  void sum(const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
           const Execution& run, const Sink& sink) const;

  virtual const MeasuredTriangles& triangles() const = 0;

 private:
  virtual void do_sum(const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
                      const Execution& run, const Sink& sink) const = 0;
};

/// Every triangle for every ball: the slow reference that the tests compare with.
class BruteForceBallSum final : public BallSum {
 public:
  explicit BruteForceBallSum(MeasuredTriangles triangles) : triangles_(std::move(triangles)) {}
  const MeasuredTriangles& triangles() const override { return triangles_; }

 private:
  void do_sum(const std::vector<Vec3>& centres, const std::vector<double>& radii, BallDefinition ball,
              const Execution& run, const Sink& sink) const override;
  MeasuredTriangles triangles_;
};

}  // namespace kappa
