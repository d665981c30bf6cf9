// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/balls/ball_sum.hpp"
#include "kappa/curvature/field.hpp"

namespace kappa {

/// Curvature at every vertex of the mesh that the triangles were made of, at the radius and order that suit each, with
/// no parameter: the scale grows until bias overtakes noise (after Lepski's principle).
///
/// Radii form a ladder of ratio 2^(1/4) from 1.4 spacings of the vertices on; every order at every rung is a candidate.
/// The mean square error of a candidate is taken from the square of its change from its radius to sqrt(2) times that.
/// Where noise prevails the change is as large as the error itself: balls of two rungs share no rim, and it is on the
/// rim that noise enters. Where bias prevails the change is larger than the bias, by 2^order - 1. So the error falls up
/// the ladder as radius^(-3/2) with the noise until bias turns it, and the candidate of least error is taken. Changes
/// are averaged over a neighbourhood as wide as the ball: a scale that varied faster than it is large would follow
/// chance. Rungs past a clear rise, or past a disagreement with lower ones beyond the noise of both, are not looked at:
/// balls that reach other parts of the surface change little for no good reason.
///
/// The sample's `radius` and `order` tell what was chosen for the principal curvatures. `gaussian` is k_min k_max. The
/// mean, which has less bias, may be of a lower order, made of some of the same balls, where that has the least error.
/// `std_error` is the root of the mean square error found for the principal curvatures. Noise that is as large as the
/// shape itself is not told from it: then the radius comes out too wide and the error told too small.
///
/// The field has radius NaN and order 0. A vertex in no ball is Empty, one that is not finite or has no normal Invalid.
/// Cost: a rung is measured at points that lie half its radius apart, so that the finest ones, below 4 spacings, cost
/// most; then the balls chosen. About 600 bytes a vertex while the scales are chosen, by their sizes.
/// @throws Error InvalidArgument if u.size() is not the number of vertices; InvalidData if no triangle has an area.
CurvatureField estimate_at_own_scale(const BallSum& balls, const Normals& u, BallDefinition ball,
                                     const Execution& run = {});

}  // namespace kappa
