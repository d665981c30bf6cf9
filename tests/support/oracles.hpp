// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "kappa/balls/ball_sum.hpp"
#include "kappa/mesh/mesh.hpp"

/// Slow computations that share no formula with the library, for the tests to compare it with.
namespace kappa::oracle {

using LongVec3 = Eigen::Matrix<long double, 3, 1>;
using LongMat3 = Eigen::Matrix<long double, 3, 3>;

/// Part of a triangle in a ball: fraction of its area and centroid x0 + b1 e1 + b2 e2.
struct Share {
  long double share = 0, b1 = 0, b2 = 0;
};

/// Share of the triangle `x` (not degenerate) in the closed ball of `radius` around the origin.
///
/// The boundary of triangle n disc is walked in 113-bit arithmetic: the polygon of the points where the edges enter
/// and leave the disc, plus a circular segment over each chord that is not part of an edge. All parts are positive,
/// so nothing cancels: the error is below 1e-17 for triangles 1e8 times larger or smaller than the ball with a height
/// over longest edge down to 1e-11.
Share share_by_clipping(const std::array<Vec3, 3>& x, double radius);

/// The same by adaptive Simpson quadrature of the chords parallel to the edge x0 x1, to a tolerance of 1e-12; slow.
Share share_by_quadrature(const std::array<Vec3, 3>& x, double radius);

/// Share of the parameter simplex for corners on one line or in one point: the simplex clipped by the two half-planes
/// in which a point of that line is in the ball. `x` must be collinear to rounding in long double.
Share share_of_collinear(const std::array<Vec3, 3>& x, double radius);

/// (squared distance from the origin to the closed triangle - radius^2) / radius^2 in 113-bit arithmetic. Exact
/// inputs that touch give exactly 0 wherever the foot of the perpendicular is a corner.
long double distance_excess(const std::array<Vec3, 3>& x, double radius);

/// Integrals of the invariant 2-forms over a patch.
struct Forms {
  long double mu0 = 0, mu1 = 0, mu2 = 0;
  LongMat3 mu_xy = LongMat3::Zero();  ///< row X, column Y

  Forms& operator+=(const Forms& other);
};

/// The forms of a triangle by Gauss quadrature, with position and normal interpolated linearly.
Forms triangle_forms(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u);

/// The forms of the bilinear patch with corners in the order (00, 10, 01, 11).
Forms bilinear_forms(const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& u);

/// The density of the forms of a triangle at x0 + b1 e1 + b2 e2, times the area of the parameter simplex.
Forms triangle_forms_at(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u, long double b1, long double b2);

/// Measures of a ball with the sums of absolute values that rounding errors are measured in.
struct BallForms {
  Forms sum;
  Forms scale;  ///< sum of the absolute values of what each triangle adds
  long double area = 0;
  std::size_t face_count = 0;
};

/// Measures of the closed ball, from the shares of this file and the forms of whole triangles, over all faces of the
/// mesh split at their barycentres. Faces with a corner that is not finite are left out.
BallForms ball_forms(const Mesh& mesh, const Normals& normals, const Vec3& centre, double radius, BallDefinition ball);

/// Largest error of `got` in units of the sums of absolute values of `expected` (area, mu0, mu1, mu2, sym mu_xy).
double relative_error(const MeasureSum& got, const BallForms& expected);

/// Nodes and weights of Gauss-Legendre quadrature of `n` points on [0, 1].
struct GaussRule {
  std::vector<long double> node, weight;
};
GaussRule gauss_rule(int n);

}  // namespace kappa::oracle
