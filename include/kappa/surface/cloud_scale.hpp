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
  /// with the sixth power of the radius and is taken off. Without noise close to 0.
  double noise = kNaN;
  /// How fast the mean curvature varies: root mean square of its surface Laplacian, 1/length^3. From the differences
  /// of the mean curvatures of quadrics fitted in balls of radii 5, 5 sqrt(2), 10 ... 28 spacings, less their share of
  /// the quartic part that any curved surface has beside its quadric (exact for spheres and cylinders, to lowest order
  /// of radius times curvature) and less what noise explains, at the first pair of radii where what is left is certain
  /// (three standard errors); 0 if it never is. Balls that reach over a border are left out unless most do. Edges count
  /// as variation, which keeps radii small.
  double variation = kNaN;
};

/// Measures a cloud at no more than 1000 of its points, evenly spaced by index. Duplicates count once.
/// Deterministic. Cost: a search tree over all points, and 1000 balls of 28 spacings.
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

/// The radius at which noise and bias are equal, by these formulas within 4 % that of the least error; between `from`
/// and `to`.
double balanced_radius(const CloudScale& scale, double normal_radius, double from, double to);

/// The same where the normals are fitted within kNormalShare of that radius.
double balanced_radius(const CloudScale& scale, double from, double to);

/// Radius of the fitted planes over that of the ball: larger normals are better still for the error, but cost more.
inline constexpr double kNormalShare = 0.7;

}  // namespace kappa
