// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "kappa/balls/measure_options.hpp"
#include "kappa/curvature/field.hpp"
#include "kappa/curvature/in_balls.hpp"

namespace kappa {

/// Who chooses radius and order.
enum class ScaleChoice {
  Given,      ///< the caller: one field for each of the radii, at the order given
  Automatic,  ///< the data, one radius for the whole scan (`automatic_radius` of a Surface), at the order given
  PerPoint    ///< the data, radius and order for every point on its own: one field (`estimate_at_own_scale`)
};
/// The words for the choices of the data.
const std::vector<Named<ScaleChoice>>& names_of(ScaleChoice);

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
const std::vector<Named<BorderEstimate>>& names_of(BorderEstimate);

/// How a ball sum is read.
struct CurvatureOptions {
  ScaleChoice scale = ScaleChoice::Given;
  /// Radii of the measuring balls, in units of the data, where they are given; 0 is the vertex limit (meshes only).
  std::vector<double> radii = {0.0};
  /// Order of the bias that is cancelled, 1 (none, the default) to 3, see `extrapolate`. Orders 2 and 3 need balls: no
  /// radius 0. Not to be given where every point has its own scale.
  std::optional<int> order;
  BallDefinition ball = BallDefinition::ExactDensity;
  /// AtCentre is for balls at the vertices of a surface that is not refined: not for radius 0, scales chosen per point
  /// or other centres.
  BorderEstimate border = BorderEstimate::InBall;
  VertexLimit vertex_limit = VertexLimit::Star;
  /// Least share of the ball that faces must cover, 0 to 1: where there is less, a point has no curvature
  /// (`mark_borders`). 0 keeps all. Needs balls: no radius 0.
  double min_coverage = 0;
};

/// @throws OptionError that names the member: `min_coverage` that is not 0 to 1, or above 0 at radius 0; `border` at
/// the centre at radius 0 or at scales chosen per point; `order` that is not 1 to 3, above 1 at radius 0, or given
/// where every point has its own scale; `radii` where they are given and one is negative or not finite, or there is
/// none.
void validate(const CurvatureOptions& options);

/// The same for both: `border` at the centre does not go with refined faces.
void validate(const CurvatureOptions& options, const MeasureOptions& measure);

/// Curvatures at the vertices of the mesh that the triangles were made of, one field a radius, or one where each has
/// its own scale. `u` are the corrected normals there.
/// @throws OptionError as `validate` does, if the scale is Automatic, which needs a Surface, or if estimates at borders
/// are wanted at the centre of refined triangles; Error InvalidArgument if u.size() is not the number of vertices, or
/// as `estimate_at_own_scale` does; Cancelled.
std::vector<CurvatureField> estimate_curvatures(const BallSum& balls, const Normals& u, const CurvatureOptions& options,
                                                const Execution& run = {});

/// The same for a mesh with corrected normals `u` at its vertices, whose ball sum is built as `measure` asks.
/// @throws the same, Error InvalidArgument or InvalidData as `triangles_of` does, and Unavailable for the engine Flann,
/// which `make_ball_sum` of the room pipeline builds.
std::vector<CurvatureField> estimate_curvatures(const Mesh& mesh, const Normals& u, const CurvatureOptions& options,
                                                const MeasureOptions& measure, const Execution& run = {});
std::vector<CurvatureField> estimate_curvatures(const Mesh& mesh, const Normals& u, const CurvatureOptions& options,
                                                const Execution& run = {});

}  // namespace kappa
