// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "border.hpp"
#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/curvature/field.hpp"

namespace kappa {

/// Takes the estimates of balls that reach over a border back to their centres, see BorderEstimate::AtCentre.
///
/// The ratios of a ball are those of the surface at the centroid of its part in the ball, to first order. An order is a
/// linear combination of balls, so that its estimate belongs to the same combination c of their centroids. Around a
/// point the estimates of the points near it, each taken at its own x + c, are fitted by a linear function; the value
/// at the point is moved by the gradient times -c. What is moved by is noise in part: it counts by its square over
/// itself and the square of the error that the residual of the fit gives it. Where windows hold more points than that
/// needs, it is made to some of them.
class BorderCorrection {
 public:
  /// `centres`, with normals `u`, are those that are measured, at `radii` (the largest of each order); both are kept by
  /// reference.
  BorderCorrection(const Triangles& triangles, const std::vector<Vec3>& centres, const Normals& u,
                   const std::vector<double>& radii, int order, const Execution& run);

  /// False if no ball reaches over a border.
  bool is_needed() const { return !near_.empty(); }

  /// The balls of centre `q` at radius number `r`, the largest first. From any thread, once a centre and radius.
  void record(std::size_t r, std::size_t q, const BallMeasures* const* balls);

  /// Changes the samples of the centres whose balls reach over a border, when all are recorded.
  void apply(std::vector<CurvatureField>& fields, const Execution& run) const;

 private:
  /// The estimate of a centre.
  struct Estimate {
    CurvatureRatios ratios;
    Vec3 centroid = Vec3::Zero();  ///< seen from the centre, combined as the ratios are
    /// Of the forms of this order and the one below, and of their centroids.
    std::array<double, 3> difference = {0, 0, 0};
    Vec3 centroid_difference = Vec3::Zero();
  };
  struct Fit;
  /// The tangent plane, in which centroids and gradients are.
  struct Tangent {
    Vec3 u, t1, t2;

    explicit Tangent(const Vec3& normal);
    Vec2 of(const Vec3& v) const { return {t1.dot(v), t2.dot(v)}; }
    /// A vector of this plane in the basis of `other`, turned by the least rotation between the planes.
    Vec2 turned(const Vec3& v, const Tangent& other) const {
      return other.of(v - v.dot(other.u) / (1 + u.dot(other.u)) * (u + other.u));
    }
  };
  using Values = Eigen::Matrix<double, 5, 1>;  ///< mean, gaussian, form 11, 12, 22

  static Values values_at(const CurvatureRatios& ratios, const Tangent& there, const Tangent& here);
  /// Some of `near_`, evenly spread, to which gradients are fitted.
  struct Nodes {
    std::vector<Index> places;
    BoxTree tree{{}};
  };
  void find_near(double reach, const Execution& run);
  Nodes nodes_for(double window, const BoxTree& all, const Execution& run) const;
  Fit fit(std::size_t r, std::size_t place) const;
  double window_around(std::size_t r, std::size_t place) const;
  void correct(std::size_t r, std::size_t place, CurvatureSample& sample) const;

  const std::vector<Vec3>& centres_;
  const Normals& u_;
  std::vector<std::vector<double>> radii_;  ///< of the balls of each radius asked for
  int order_;
  Border border_;
  std::vector<Index> near_;   ///< centres within reach of a border
  std::vector<Index> place_;  ///< of each centre in `near_`
  std::vector<Tangent> tangents_;
  std::vector<Nodes> nodes_;                      ///< of each radius
  std::vector<std::vector<Estimate>> estimates_;  ///< of each radius at `near_`
};

}  // namespace kappa
