// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "kappa/core/types.hpp"

namespace kappa {

/// What a closed ball holds of a triangle.
struct TriangleShare {
  /// Area of the intersection over the area of the triangle, in [0, 1].
  double share = 0;
  /// The centroid of the intersection is x0 + b1 (x1 - x0) + b2 (x2 - x0). Undefined where `share` is 0.
  double b1 = 0, b2 = 0;
  /// Whether triangle and ball have a point in common. They may meet in a point or a line, with a share of 0.
  bool met = false;
};

/// A triangle is degenerate, and is treated as a line or a point, if |e1 x e2| <= kDegenerateRatio * longest edge^2.
inline constexpr double kDegenerateRatio = 1e-12;

/// The squared distance from the origin to the closed triangle with the corners `x`.
double distance_sq_to_triangle(const std::array<Vec3, 3>& x);

/// Whether the closed ball of `radius` around the origin and the closed triangle `x` have a point in common. The
/// distance decides this, never the area: rounding keeps the area of a missed triangle from vanishing exactly.
bool triangle_meets_ball(const std::array<Vec3, 3>& x, double radius);

/// The share of the triangle that a closed ball holds, and the centroid of that part.
///
/// `x` are the corners relative to the centre of the ball; `radius` is positive and has the same unit.
///
/// The ball cuts the plane of the triangle in a disc. Three forms compute the part of the triangle in the disc:
/// (a) a sum over the edges of chord parts and circular sectors, for most triangles;
/// (b) chords and arcs along the boundary of the intersection, for triangles small beside the ball, and in extended
///     precision for the smallest and for slivers;
/// (c) the part of the parameter simplex, for degenerate triangles.
///
/// Error: share and share * (b1, b2) are within kShareError of the exact ones, for triangles of 1e-4 to 1e4 times the
/// size of the ball whose height is at least 1e-6 of their longest edge. Where the plane of the triangle almost touches
/// the ball, the share depends so much on the last digit of the corners that no result can hold this bound. The error
/// is then as large as that of a change of the radius by a few roundings.
/// Cost: one atan2 an edge.
TriangleShare triangle_ball_share(const std::array<Vec3, 3>& x, double radius);

/// The bound of the error of `triangle_ball_share`. The tests compare with 113-bit arithmetic.
inline constexpr double kShareError = 1e-10;

}  // namespace kappa
