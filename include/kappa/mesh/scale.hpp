// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/mesh/estimate.hpp"

namespace kappa {

/// Curvature at every vertex of the mesh that the triangles were made of, at the radius and order that suit each, with
/// no parameter: the scale grows until bias overtakes noise (after Lepski's principle).
///
/// Radii form a ladder of ratio 2^(1/4) from the spacing of the vertices on; every order at every rung is a candidate.
/// The mean square error of a candidate is taken from the square of its change from its radius to sqrt(2) times that,
/// averaged over the vertices around. Where noise prevails the change is as large as the error itself: balls of two
/// rungs share no rim, and it is on the rim that noise enters. Where bias prevails the change is larger than the bias,
/// by 2^order - 1. So the error falls up the ladder as radius^(-3/2) with the noise until bias turns it, and the
/// candidate of least error is taken. Rungs past a clear rise, or past a disagreement with lower ones beyond the noise
/// of both, are not looked at: balls that reach other parts of the surface change little for no good reason.
///
/// The sample's `radius` and `order` tell what was chosen, `std_error` is the root of the error found, which is about
/// that of the mean and the principal curvatures. Where the trace of the extrapolated form changes less than the ratio
/// mu1 / mu0, as it does under noise of the normals, `mean` and `gaussian` are (k_min + k_max) / 2 and k_min k_max.
///
/// The field has radius NaN and order 0. A vertex in no ball is Empty, one that is not finite or has no normal Invalid.
/// Cost: one walk of all vertices for all rungs that patches of about 2000 of them call for, and one for the balls
/// chosen; about 50 bytes a vertex and rung.
/// @throws Error InvalidArgument if u.size() is not the number of vertices; InvalidData if no triangle has an area.
CurvatureField estimate_at_own_scale(const BallSum& balls, const Normals& u, BallDefinition ball,
                                     const Execution& run = {});

}  // namespace kappa
