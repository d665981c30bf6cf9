// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "kappa/core/execution.hpp"
#include "kappa/core/names.hpp"
#include "kappa/curvature/estimate.hpp"

namespace kappa {

/// How the triangles of a point are chosen among its neighbours (Lachaud, Coeurjolly, Labart, Romon, Thibert,
/// "Lightweight curvature estimation on point clouds with randomized corrected curvature measures", CGF 42(5), 2023).
enum class TriangleScheme {
  Uniform,          ///< three different neighbours drawn anew each time; a draw that repeats one is lost
  Independent,      ///< neighbours in random order, three by three: no two triangles share a corner
  Hexagram,         ///< two: the neighbours nearest to the corners of two interleaved equilateral triangles
  AveragedHexagram  ///< two: the mean positions and mean normals of the neighbours in six sectors
};
const std::vector<Named<TriangleScheme>>& names_of(TriangleScheme);

struct RandomTriangleOptions {
  TriangleScheme scheme = TriangleScheme::AveragedHexagram;
  int neighbours = 20;  ///< nearest points of different position, the point included; 3 to 255
  /// Triangles drawn for each point by Uniform, at most so many by Independent; 1 to 1000000.
  int triangles = 100;
  std::uint64_t seed = 0;  ///< of the numbers that Uniform and Independent draw
};

/// Curvatures of a cloud, each point's from the sum of the measures of its own triangles: no ball and no surface.
///
/// Each triangle is turned so that its corrected area mu0 is positive; one whose mu0 vanishes adds nothing.
/// `radius` of the field is 0 and `coverage` NaN, as at a vertex; `face_count` counts the triangles that add
/// something, `area` is their sum. A point that is not finite or has no normal is Invalid, one without a triangle
/// Empty. A duplicate has the sample of the first point at its position.
///
/// Uniform and Independent draw from `options.seed` and the index of the point alone: equal input gives equal bits, for
/// any number of threads. The hexagrams draw nothing.
/// Cost per point: the search for its neighbours, and the triangles.
/// @throws Error InvalidArgument if sizes differ or an option is out of range; InvalidData if no point is valid.
CurvatureField random_triangle_curvatures(const std::vector<Vec3>& points, const Normals& normals,
                                          const RandomTriangleOptions& options, const Execution& run = {});

}  // namespace kappa
