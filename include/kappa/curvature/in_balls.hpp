// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/core/names.hpp"
#include "kappa/curvature/field.hpp"

namespace kappa {

/// The balls that are measured around every centre.
struct BallPlan {
  std::vector<double> radii;  ///< of one field each; positive, finite, length
  int order = 1;              ///< of the bias that is cancelled, 1 (none) to 3, see `extrapolate`
  BallDefinition ball = BallDefinition::ExactDensity;
};

/// Curvatures of the balls around `centres`, with the corrected normals `u` there, one field a radius; all balls of a
/// centre, of all radii and orders, are summed at once. A centre or normal that is not finite, or a zero normal, gives
/// PointStatus::Invalid; at orders above 1, so does each status of the balls: see `extrapolate`.
/// @throws Error InvalidArgument if sizes differ, a radius is not positive and finite, or the order is not 1 to 3;
/// Cancelled.
std::vector<CurvatureField> curvatures_in_balls(const BallSum& balls, const std::vector<Vec3>& centres,
                                                const Normals& u, const BallPlan& plan, const Execution& run = {});

/// The same in a ball of its own around each centre, of radius radii[i]; 0 stands for no ball, whose sample is Empty.
/// One sample a centre, equal to the bit to that of `curvatures_in_balls` at this radius.
std::vector<CurvatureSample> curvatures_in_own_balls(const BallSum& balls, const std::vector<Vec3>& centres,
                                                     const Normals& u, const std::vector<double>& radii, int order,
                                                     BallDefinition ball, const Execution& run = {});

/// What the measures at radius 0 of a vertex are.
enum class VertexLimit {
  Star,  ///< sum over the whole incident faces
  Limit  ///< limit of area-fraction balls for radius -> 0+: sum over the incident triangles of angle x measure / area
};
const std::vector<Named<VertexLimit>>& names_of(VertexLimit);

/// Curvatures at radius 0 at the vertices of the mesh that the triangles were made of; no ball, so no coverage.
/// @throws Error InvalidArgument if u.size() is not the number of its vertices; Cancelled.
CurvatureField curvatures_at_vertices(const BallSum& balls, const Normals& u, VertexLimit limit,
                                      const Execution& run = {});

/// The vertices of the mesh that triangles were made of.
std::vector<Vec3> vertices_of(const Triangles& triangles);

}  // namespace kappa
