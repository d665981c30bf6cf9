// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/curvatures.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/core/percentiles.hpp"

namespace kappa {

/// Curvature at one point, with what it was computed from.
struct CurvatureSample {
  Curvatures k;
  double mu0 = kNaN, mu1 = kNaN, mu2 = kNaN;  ///< measures of the ball; NaN where the point is invalid
  double area = kNaN;                         ///< of the faces in the ball, un-corrected
  double coverage = kNaN;                     ///< area / (pi radius^2), falls at borders and holes; NaN at radius 0
  Index face_count = 0;                       ///< triangles met, parts of polygons counting singly
  double std_error = kNaN;                    ///< spread between orders, 1/length (see `extrapolate`); NaN at order 1
  double radius = kNaN;  ///< of the ball that the measures are of, the largest of the order's; NaN where invalid
  int order = 0;         ///< 0 where invalid
};

/// Curvature at every vertex or point, for one radius.
struct CurvatureField {
  double radius = 0;  ///< NaN if each point has its own
  std::vector<CurvatureSample> samples;
  int order = 1;  ///< 0 if each point has its own

  bool own_scales() const { return order == 0; }
};

/// The radius of the field, or the median of those that its valid points have of their own; NaN if there is none.
double typical_radius(const CurvatureField& field);

/// Takes the curvatures of the valid points away, with PointStatus::Border, whose coverage is less than `least`: there
/// the ball reaches over a border or a hole and measures a place beside its centre. Measures, area and coverage stay.
/// @throws Error InvalidArgument if `least` is not between 0 and 1, or the field was not measured in balls.
void mark_borders(CurvatureField& field, double least, const Execution& run = {});

/// Counts of each PointStatus, and percentiles of the curvatures: what a summary shows.
struct FieldSummary {
  std::size_t valid = 0, empty = 0, degenerate = 0, invalid = 0, border = 0;
  /// 1st, 50th and 99th percentile of the valid samples; NaN if there is none.
  struct Percentiles {
    double p1 = kNaN, p50 = kNaN, p99 = kNaN;
  } mean, gaussian, k_min, k_max;
};
/// @throws Cancelled
FieldSummary summarise(const CurvatureField& field, const Execution& run = {});

/// Of values as kappa::percentile takes them, which it reorders.
FieldSummary::Percentiles percentiles(std::vector<double>& values);

}  // namespace kappa
