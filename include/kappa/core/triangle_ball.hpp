// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "kappa/core/types.hpp"

namespace kappa {

/// What a closed ball holds of a triangle.
struct TriangleShare {
  /// Area of the intersection over the area of the triangle, in [0, 1].
  double share = 0;
  /// Centroid of the intersection: x0 + b1 (x1 - x0) + b2 (x2 - x0). Undefined if share is 0.
  double b1 = 0, b2 = 0;
  /// Whether they meet at all, perhaps in a point or a line of no area.
  bool met = false;
};

/// A triangle is treated as a line or a point if |e1 x e2| <= kDegenerateRatio * longest edge^2.
inline constexpr double kDegenerateRatio = 1e-12;

/// Squared distance from the origin to the closed triangle `x`.
double distance_sq_to_triangle(const std::array<Vec3, 3>& x);

/// Whether the closed ball around the origin meets the closed triangle `x`. Decided by the
/// distance, never by the area, which rounding keeps from vanishing exactly.
bool triangle_meets_ball(const std::array<Vec3, 3>& x, double radius);

/// Share of the triangle `x`, given relative to the centre of the ball, that the closed ball of
/// `radius` > 0 holds, with the centroid of the intersection.
///
/// The ball cuts the plane of the triangle in a disc. Area and first moments of triangle n disc are
/// sums over the edges of a chord part and a sector part. Triangles small beside the ball, or flatter than
/// 1e-3 (height over longest edge), go through a second form that sums nothing larger than the
/// triangle itself. Degenerate triangles: share and centroid of the parameter simplex.
///
/// Error: share and share * (b1, b2) below kShareError for triangles from 1e-4 to 1e4 times the
/// ball with height over longest edge down to 1e-6. Only where the plane of the triangle all but touches the
/// ball is the share itself that sensitive to the last digit of the corners that the bound cannot hold; there the
/// error is that of a change of the radius by a few roundings.
/// Cost: one atan2 an edge.
TriangleShare triangle_ball_share(const std::array<Vec3, 3>& x, double radius);

/// Bound of the error of `triangle_ball_share`, tested against 113-bit arithmetic.
inline constexpr double kShareError = 1e-10;

/// The forms, for tests and benchmarks. All but the last need a triangle that is not degenerate.
namespace detail {
TriangleShare share_by_sectors(const std::array<Vec3, 3>& x, double radius);
TriangleShare share_by_boundary(const std::array<Vec3, 3>& x, double radius);
TriangleShare share_by_long_boundary(const std::array<Vec3, 3>& x, double radius);
TriangleShare share_of_simplex(const std::array<Vec3, 3>& x, double radius);
}  // namespace detail

}  // namespace kappa
