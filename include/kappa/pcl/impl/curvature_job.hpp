// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "kappa/core/error.hpp"
#include "kappa/core/execution.hpp"
#include "kappa/curvature/estimate.hpp"
#include "kappa/mesh/mesh.hpp"
#include "kappa/surface/umbrella.hpp"

namespace kappa::detail {

/// A call of CorrectedCurvatureEstimation in kappa's terms.
struct CurvatureJob {
  Mesh surface;               ///< what is measured; without faces, its points get their umbrella surface
  Normals normals;            ///< at the vertices of the surface, unit or zero
  std::vector<Vec3> centres;  ///< relative to surface.origin
  Normals centre_normals;     ///< one a centre
  double radius = 0;          ///< of all balls, if radii is empty
  std::vector<double> radii;  ///< of the ball around each centre, 0 for none
  BallDefinition ball = BallDefinition::ExactDensity;
  int order = 1;
  QuadMeasures quads = QuadMeasures::Split;
  UmbrellaOptions umbrella;
};

/// One sample a centre. A ball of radius 0 around a valid centre is Empty.
/// @throws Error as the stages do.
std::vector<CurvatureSample> run(const CurvatureJob& job, const Execution& execution);

/// @throws Error InvalidArgument unless one of the two is in range (radius > 0 and finite, k >= 2) and the other 0.
void check_search(double radius, int k);

/// @throws Error InvalidData unless all indices are in [0, size).
void check_indices(const std::vector<int>& indices, std::size_t size);

/// Calls `call` and turns what it throws into a status.
Status status_of(const std::function<void()>& call);

}  // namespace kappa::detail
