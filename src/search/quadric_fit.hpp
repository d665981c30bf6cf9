// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "kappa/core/types.hpp"
#include "plane_fit.hpp"

namespace kappa {

/// Two axes in a plane and its normal, as columns.
using Frame = Mat3;

/// A frame whose third axis is `normal`, of unit length.
Frame frame_around(const Vec3& normal);

/// Least squares of the height c0 x^2/2 + c1 x y + c2 y^2/2 + c3 + c4 x + c5 y over the plane of a frame; all lengths
/// in units of `unit`, of the order of the distance of the points.
class QuadricFit {
 public:
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  using Mat6 = Eigen::Matrix<double, 6, 6>;

  QuadricFit(const Frame& frame, double unit) : frame_(frame), unit_(unit) {}

  /// Adds the point at `d` from the place of the frame.
  void add(const Vec3& d);

  /// Adds many points, of known moments.
  void take(const kernels::FourPoints* points, std::size_t fours, const Moments& moments);

  /// Variance of the residuals, a length squared; NaN for no more points than coefficients.
  double variance() const;

  /// Of the quadric over the place of the frame.
  struct Curvature {
    double mean, gaussian;
    double variance;  ///< of the mean, for noise of variance 1
  };
  Curvature curvature() const;

  /// Unit normal over the place of the frame, on the side of its third axis. The zero vector where the points do not
  /// fix a quadric: fewer than kLeastForQuadric, or its slopes more than kUncertain times as uncertain (by standard
  /// deviation) as those of a plane through the same points.
  Vec3 normal() const { return fitted().normal; }
  Vec3 normal_or(const Vec3& plane) const;  ///< the other where there is none
  /// The normal, and variance() at little more cost.
  struct Fitted {
    Vec3 normal;
    double variance;
  };
  Fitted fitted() const;
  double normal_variance() const;  ///< of both slopes together, for noise of variance 1
  static constexpr std::size_t kLeastForQuadric = 12;
  static constexpr double kUncertain = 10;

 private:
  Frame frame_;
  double unit_;
  Mat6 normal_ = Mat6::Zero();
  Vec6 right_ = Vec6::Zero();
  double square_ = 0;
  std::size_t count_ = 0;
};

/// The larger of two neighbourhoods if its residuals have the same variance (up to a factor of 1.5) and so come of
/// noise, which it calms; else the smaller, from which the surface departs less.
const QuadricFit& better_fit(const QuadricFit& smaller, const QuadricFit& larger);

}  // namespace kappa
