// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "kappa/core/measures.hpp"

namespace kappa {

/// The corrected measures of a bilinear patch. Positions and normals are interpolated bilinearly, and the interpolated
/// normals are not made units. Source: Appendix B of the paper that `Measures` names; the formula for mu^(X,Y) that it
/// prints holds on parallelograms alone, and docs/method.md has the one that holds on every patch.
///
/// `x` are the four corners (length) and `u` the unit normals there, both in the order (00, 10, 01, 11): the second
/// and third corner are neighbours of the first. `area` is that of the four triangles of `polygon_measures`.
/// Identities: trace(mu_xy) == -mu1; naming the corners anew without a change of the sense of rotation changes nothing.
Measures bilinear_measures(const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& u);

/// The corrected measures of a surfel, which is a square of side `h` (length) along the unit vectors `axis_x` and
/// `axis_y`. `u` are the unit normals at its corners in the order (00, 10, 01, 11). Source: Appendix C of the paper,
/// with mu^(X,Y) as docs/method.md has it. The result is that of `bilinear_measures` on this square.
Measures surfel_measures(const Vec3& axis_x, const Vec3& axis_y, double h, const std::array<Vec3, 4>& u);

}  // namespace kappa
