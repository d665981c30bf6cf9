// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/curvatures.hpp"
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

/// What the measures at radius 0 of a vertex are.
enum class VertexLimit {
  Star,  ///< sum over the whole incident faces
  Limit  ///< limit of area-fraction balls for radius -> 0+: sum over the incident triangles of angle x measure / area
};

/// Who chooses radius and order.
enum class ScaleChoice {
  Given,    ///< one field for each of the radii, at the order given
  PerPoint  ///< the data, for every point on its own: one field; radii and order are not used
};

/// What the curvatures of a point are, whose ball reaches over a border of the surface.
enum class BorderEstimate {
  /// Those of the part in the ball: they belong to its centroid, beside the centre, with an error that is linear in the
  /// radius.
  InBall,
  /// Those at the centre: the gradient of the curvature times the way from the centre to the centroid is taken off. The
  /// gradient is fitted to the estimates of the vertices around, within 1.5 radii of the smallest ball, up to 3 where
  /// there are fewer than 12. As much is taken off as stands out of the error of the fit; with fewer than 6 points, or
  /// across a single row of them, nothing is. Measures, area and coverage stay those of the ball, so that the mean is
  /// no longer mu1 / (2 mu0) there. Where no border is within the ball nothing changes, to the bit. At orders 2 and 3
  /// `std_error` has the error of what was taken off in it. For surfaces whose curvature varies little within a ball,
  /// as smooth terrain and freeform scans: where features are as narrow as the ball, as the ridge of a small roof, the
  /// gradient goes beyond them, and eaves that are flat come out bent.
  AtCentre
};

struct CurvatureOptions {
  ScaleChoice scale = ScaleChoice::Given;
  /// Radii of the measuring balls, in units of the data; 0 is the vertex limit (meshes only).
  std::vector<double> radii = {0.0};
  BallDefinition ball = BallDefinition::ExactDensity;
  QuadMeasures quads = QuadMeasures::Split;
  VertexLimit vertex_limit = VertexLimit::Star;
  /// Order of the bias that is cancelled, 1 (none) to 3, see `extrapolate`. Orders 2 and 3 need balls: no radius 0.
  int order = 1;
  /// Times every face is split in four on a curved patch before it is measured, see `measure_refined`; for calls that
  /// take a mesh.
  int refine = 0;
  /// AtCentre is for balls at the vertices of a surface that is not refined: not for radius 0, scales chosen per point
  /// or other centres.
  BorderEstimate border = BorderEstimate::InBall;
};

/// @throws Error InvalidArgument if faces are to be refined and quads bilinear; if estimates at borders are wanted
/// AtCentre of refined faces, at radius 0 or at scales chosen per point; and unless each point has its own scale, if
/// there is no radius, one is negative or not finite, the order is not 1 to 3, or is above 1 beside a radius 0.
void validate(const CurvatureOptions& options);

/// Curvatures of the balls around `centres`, with the corrected normals `u` there, one field a radius; all balls of a
/// centre, of all radii and orders, are summed at once. A centre or normal that is not finite, or a zero normal, gives
/// PointStatus::Invalid; at orders above 1, so does each status of the balls: see `extrapolate`.
/// @throws Error InvalidArgument if sizes differ, a radius is not positive, the scale is not Given, the order is not
/// 1 to 3, or estimates at borders are wanted AtCentre.
std::vector<CurvatureField> estimate_curvatures(const BallSum& balls, const std::vector<Vec3>& centres,
                                                const Normals& u, const CurvatureOptions& options,
                                                const Execution& run = {});

/// The same at order 1.
std::vector<CurvatureField> estimate_curvatures(const BallSum& balls, const std::vector<Vec3>& centres,
                                                const Normals& u, const std::vector<double>& radii, BallDefinition ball,
                                                const Execution& run = {});

/// The same at the vertices of the mesh that the triangles were made of, where a radius may be 0, or radius and order
/// be chosen for each (`estimate_at_own_scale`).
/// @throws Error InvalidArgument if u.size() is not their number, if estimates at borders are wanted AtCentre of
/// refined triangles, or as `validate` and `estimate_at_own_scale` do.
std::vector<CurvatureField> estimate_curvatures(const BallSum& balls, const Normals& u, const CurvatureOptions& options,
                                                const Execution& run = {});

/// Curvatures at radius 0 at the vertices of the mesh that the triangles were made of; no ball, so no coverage.
/// @throws Error InvalidArgument if u.size() is not the number of its vertices.
CurvatureField estimate_at_vertices(const MeasuredTriangles& triangles, const Normals& u, VertexLimit limit,
                                    const Execution& run = {});

/// Curvatures of `mesh` with corrected normals `u` at its vertices, one field for each of `options.radii`.
/// @throws Error InvalidArgument or InvalidData as `measure_triangles` and `validate` do.
std::vector<CurvatureField> estimate_curvatures(const Mesh& mesh, const Normals& u, const CurvatureOptions& options,
                                                const Execution& run = {});

/// Takes the curvatures of the valid points away, with PointStatus::Border, whose coverage is less than `least`: there
/// the ball reaches over a border or a hole and measures a place beside its centre. Measures, area and coverage stay.
/// @throws Error InvalidArgument if `least` is not between 0 and 1, or the field was not measured in balls.
void mark_borders(CurvatureField& field, double least);

/// Counts of each PointStatus, and percentiles of the curvatures: what a summary shows.
struct FieldSummary {
  std::size_t valid = 0, empty = 0, degenerate = 0, invalid = 0, border = 0;
  /// 1st, 50th and 99th percentile of the valid samples; NaN if there is none.
  struct Percentiles {
    double p1 = kNaN, p50 = kNaN, p99 = kNaN;
  } mean, gaussian, k_min, k_max;
};
FieldSummary summarise(const CurvatureField& field, const Execution& run = {});

/// Of values as kappa::percentile takes them, which it reorders.
FieldSummary::Percentiles percentiles(std::vector<double>& values);

}  // namespace kappa
