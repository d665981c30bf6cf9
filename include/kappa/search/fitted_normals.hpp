// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/core/execution.hpp"
#include "kappa/core/names.hpp"
#include "kappa/mesh/mesh.hpp"
#include "kappa/search/neighbours.hpp"

namespace kappa {

/// Indices of the first point at each position: representative[i] == i for a point that stands for
/// itself, kNoIndex for one that is not finite.
std::vector<Index> find_duplicates(const std::vector<Vec3>& points);

/// What is fitted to the neighbours of a point.
enum class NormalFit {
  /// The plane of least squares (principal component analysis). Its normal is that over the centroid of the neighbours:
  /// at a point that lies d beside it, at a border or where sampling is uneven, it is wrong by d times the curvature.
  Plane,
  /// The quadric of least squares over that plane, taken at the point itself (a jet of degree 2: Cazals and Pouget,
  /// "Estimating differential quantities using polynomial fitting of osculating jets", CAGD 2005). In the middle of
  /// evenly spread neighbours noise disturbs it no more than the plane. At a border it would four times as much: there
  /// the neighbourhood grows, up to twice the radius or four times the neighbours, unless the variance of the residuals
  /// grows by half with it. Where the neighbours do not fix a quadric, fewer than 12 or in a line, the plane takes its
  /// place.
  Quadric,
  /// Resists edges and outliers. Planes are fitted by Tukey's weights; every point takes its own, or that of a
  /// neighbour which fits its points and passes by the point more than twice as well, so that beside an edge it is that
  /// of the side the point lies on (after the filter of Kuwahara et al., 1976), and refits it to its own neighbours
  /// near
  /// it. The normal is that of their quadric where they are nearly all, else of their plane. Takes two to three times
  /// as
  /// long.
  Robust
};
const std::vector<Named<NormalFit>>& names_of(NormalFit);

struct NormalFitOptions {
  int neighbours = 24;  ///< points of different position, the point included; at least 3
  /// If positive: all points within this radius, where they are at least `neighbours`; the more, the less noise.
  double radius = 0;
  NormalFit fit = NormalFit::Quadric;
  /// If positive: the noise of the points across the surface. A quadric within `radius` whose residuals are more than
  /// twice that reaches over an edge, or across a shape that it cannot follow: there the nearest neighbours take the
  /// place of the ball.
  double noise = 0;
};

/// Unit normals of the surfaces that are fitted to the neighbours of each point, sign arbitrary. The zero vector where
/// the point is not finite or its neighbours are collinear or fewer than three.
/// Exact duplicates count once. Of more than 8192 points within the radius (and a little farther) every m-th is taken.
/// @throws Error InvalidArgument if there are fewer than 3 neighbours, or the radius or noise is negative or not
/// finite.
Normals fitted_normals(const std::vector<Vec3>& points, const NormalFitOptions& options, const Execution& run = {});

/// Turns each normal so that it points to the side of `viewpoint`.
void orient_towards(const std::vector<Vec3>& points, const Vec3& viewpoint, Normals& normals);

/// Turns each normal so that its scalar product with `direction` is not negative, (0, 0, 1) for terrain.
void orient_along(const Vec3& direction, Normals& normals);

}  // namespace kappa
