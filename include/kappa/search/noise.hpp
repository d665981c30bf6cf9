// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kappa/core/execution.hpp"
#include "kappa/core/types.hpp"

namespace kappa {

/// What a cloud says about the scale at which its curvature can be measured: lengths in its units, NaN if it has too
/// few points to tell.
struct CloudScale {
  double spacing = kNaN;  ///< 1 / sqrt(points per area), median
  /// Standard deviation of the points across the surface. From the residuals of quadrics fitted to 12 and to 32
  /// nearest neighbours (medians of their variances): noise leaves them equal, while what a quadric cannot follow grows
  /// with the sixth power of the radius and is taken off. Where it is more than a fifth of the radius of the 32, whose
  /// nearest points lie in a ball rather than in a disc, from more neighbours, up to 605. Without noise close to 0.
  double noise = kNaN;
  /// How fast the mean curvature varies: root mean square of its surface Laplacian, 1/length^3. From the differences
  /// of the mean curvatures of quadrics fitted in balls of radii 5, 5 sqrt(2), 10 ... 28 spacings, less their share of
  /// the quartic part that any curved surface has beside its quadric (exact for spheres and cylinders, to lowest order
  /// of radius times curvature) and less what noise explains, at the first pair of radii where what is left is certain
  /// (three standard errors); 0 if it never is. Balls that reach over a border are left out unless most do. Edges count
  /// as variation, which keeps radii small; so do balls as wide as the surface is round, which they need be only where
  /// noise hides the variation in smaller ones.
  double variation = kNaN;
  /// Root mean square of the surface gradient of the mean curvature, 1/length^2: what makes fitted normals wrong. From
  /// the differences of the normals of quadrics in balls of radii 2.5, 2.5 sqrt(2), 5 ... 28 spacings, less what noise
  /// explains, at the first pair of radii where what is left is certain and more than a quarter of that, the balls
  /// being at least 4.5 times as wide as the noise; up to 8 times, only if the next pair finds half of it or more. 0 if
  /// none is. Spheres and cylinders have none in balls of whatever width, since only odd terms move a normal, so that
  /// much smaller values are found than those of `variation` under the same noise. Edges count as gradient.
  double gradient = kNaN;
};

/// Measures a cloud at no more than 1000 of its points, evenly spaced by index. Duplicates count once.
/// Deterministic. Cost: a search tree over all points, and 1000 balls of 28 spacings, twice their points in fits.
CloudScale measure_scale(const std::vector<Vec3>& points, const Execution& run = {});

/// Standard deviation of the mean curvature in a ball of `radius` that comes from noise, with normals from planes
/// fitted to the points within `normal_radius`: 0.55 noise spacing / (radius normal_radius)^1.5. A plane's slope is
/// uncertain by 2 noise / (normal_radius sqrt(points)), the mean curvature is the flow of the normals through the rim
/// of the disc over its area, and about radius / normal_radius places of the rim are independent; the factor is fitted
/// to trials on noisy terrain with planes of 20 to 150 points and balls of 5 to 20 spacings.
double curvature_noise(const CloudScale& scale, double radius, double normal_radius);

/// Bias of the mean curvature there, root mean square: variation (radius^2 / 8 + normal_radius^2 / 12), half the second
/// moment along an axis of the disc, and of the kernel by which a fitted plane averages the true normals, times the
/// Laplacian.
double curvature_bias(const CloudScale& scale, double radius, double normal_radius);

/// Standard deviation of a unit normal that comes from noise, where quadrics are fitted to the points within
/// `normal_radius`, radians: sqrt(8 / pi) noise spacing / normal_radius^2, both slopes of a linear fit in a disc
/// together.
double normal_noise(const CloudScale& scale, double normal_radius);

/// Bias of such a normal, root mean square, radians: gradient normal_radius^2 / 6, the slope that the cubic part of a
/// surface has in a disc.
double normal_bias(const CloudScale& scale, double normal_radius);

/// Radius of the fits at which noise and bias of the normals are equal; between `from` and `to`.
double balanced_normal_radius(const CloudScale& scale, double from, double to);

/// Radius of the ball at which noise and bias of the mean curvature are equal, by these formulas within 4 % that of the
/// least error; between `from` and `to`.
double balanced_radius(const CloudScale& scale, double normal_radius, double from, double to);

}  // namespace kappa
