// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "kappa/core/measures.hpp"

namespace kappa {

/// The signed curvatures at a point.
///
/// Sign: with outward (or upward) normals a convex surface has positive curvature. A sphere of radius R has mean = 1/R,
/// gaussian = 1/R^2 and k_min = k_max = 1/R. With opposite normals mean, k_min and k_max change their sign, and
/// gaussian does not. Units: 1/length, for gaussian 1/length^2.
///
/// The paper that `Measures` names has two traps. (a) mu1 is the integral of k_min + k_max, so mean = mu1 / (2 mu0);
/// equation (2) of the paper is twice the mean curvature. (b) The constant K of Definition 2 depends on the unit of the
/// data. The principal curvatures here come from the tensor restricted to the plane orthogonal to u, a 2x2 matrix. It
/// is the limit of large K, and right at every scale.
struct Curvatures {
  double mean = kNaN;
  double gaussian = kNaN;
  double k_min = kNaN, k_max = kNaN;  ///< k_min <= k_max
  /// Unit vectors orthogonal to u. Their sign has no meaning.
  Vec3 dir_min = Vec3::Constant(kNaN), dir_max = Vec3::Constant(kNaN);
  PointStatus status = PointStatus::Invalid;  ///< all values are NaN unless it is Valid
};

/// A ball or face is degenerate if |mu0| <= kDegenerateArea * area.
inline constexpr double kDegenerateArea = 1e-12;

/// The ratios of the measures of a ball, from which its curvatures follow. A linear combination of the ratios of
/// several balls around one point has a meaning; a combination of their eigenvalues has none.
struct CurvatureRatios {
  double mean = kNaN;      ///< mu1 / (2 mu0), 1/length
  double gaussian = kNaN;  ///< mu2 / mu0, 1/length^2
  /// The entries 11, 12 and 22 of the second form -T^T sym(mu_xy) T / mu0, with T = (t1, t2) of `tangent_basis` and
  /// sym(A) = (A + A^T) / 2. 1/length.
  std::array<double, 3> form = {kNaN, kNaN, kNaN};
  PointStatus status = PointStatus::Invalid;  ///< all values are NaN unless it is Valid
};

/// The ratios of the measures `m` of a ball or a face with the corrected normal `u` there. `u` need not be a unit
/// vector. The status is that of `curvatures`.
CurvatureRatios curvature_ratios(const MeasureSum& m, const Vec3& u);

/// The curvatures that have these ratios at a point with the normal `u`.
Curvatures curvatures(const CurvatureRatios& ratios, const Vec3& u);

/// The curvatures that follow from the measures `m` of a ball or a face and the corrected normal `u` there (Definitions
/// 1 and 2 of the paper that `Measures` names, in the limit of large K). `u` need not be a unit vector.
///
/// mean = mu1 / (2 mu0) and gaussian = mu2 / mu0. The principal curvatures and directions are the eigenvalues and
/// eigenvectors of -T^T sym(mu_xy) T / mu0, where T is an orthonormal basis of the plane orthogonal to u.
///
/// The status, and with it whether the values are NaN, is
/// (a) Invalid where a measure is not finite, or u is zero or not finite;
/// (b) Degenerate where |mu0| <= kDegenerateArea * area;
/// (c) Valid otherwise.
Curvatures curvatures(const MeasureSum& m, const Vec3& u);
Curvatures curvatures(const Measures& m, const Vec3& u);

/// Sets `t1` and `t2` to unit vectors that span the plane orthogonal to the unit vector `u`, with (t1, t2, u)
/// right-handed (Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017).
void tangent_basis(const Vec3& u, Vec3& t1, Vec3& t2);

}  // namespace kappa
