// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "kappa/core/measures.hpp"

namespace kappa {

/// Signed curvatures at a point.
///
/// Sign: with outward (or upward) normals a convex surface has positive curvature; a sphere of
/// radius R has mean = 1/R, gaussian = 1/R^2, k_min = k_max = 1/R. Flipping the normals flips mean,
/// k_min and k_max and keeps gaussian. Units: 1/length, gaussian 1/length^2.
///
/// Two traps. mu1 integrates k_min + k_max, so mean = mu1 / (2 mu0): the paper's equation (2) is
/// twice the mean curvature. And the constant K of the paper's Definition 2 depends on the units of
/// the data: the principal curvatures come from the 2x2 restriction of the tensor to the plane
/// orthogonal to u, its limit as K grows, which is right at every scale.
struct Curvatures {
  double mean = kNaN;
  double gaussian = kNaN;
  double k_min = kNaN, k_max = kNaN;                                    ///< k_min <= k_max
  Vec3 dir_min = Vec3::Constant(kNaN), dir_max = Vec3::Constant(kNaN);  ///< unit, orthogonal to u, sign arbitrary
  PointStatus status = PointStatus::Invalid;
};

/// Ratio of |mu0| to the area below which a ball is degenerate.
inline constexpr double kDegenerateArea = 1e-12;

/// Ratios of the measures of a ball, of which its curvatures are functions. Linear combinations of those of several
/// balls around one point have a meaning, those of eigenvalues have not.
struct CurvatureRatios {
  double mean = kNaN;      ///< mu1 / (2 mu0)
  double gaussian = kNaN;  ///< mu2 / mu0
  /// Second form -T^T sym(mu_xy) T / mu0 in the basis (t1, t2) of `tangent_basis`: 11, 12, 22.
  std::array<double, 3> form = {kNaN, kNaN, kNaN};
  PointStatus status = PointStatus::Invalid;  ///< all values are NaN unless Valid
};

/// Ratios of the measures of a ball or a face with the corrected normal `u` there; statuses as of `curvatures`.
CurvatureRatios curvature_ratios(const MeasureSum& m, const Vec3& u);

/// Curvatures that have these ratios at a point of normal `u`.
Curvatures curvatures(const CurvatureRatios& ratios, const Vec3& u);

/// Curvatures from the measures of a ball or a face and the corrected unit normal `u` there:
/// mean = mu1 / (2 mu0), gaussian = mu2 / mu0, (k, dir) = eigenpairs of -T^T sym(mu_xy) T / mu0 with
/// T an orthonormal basis of the plane orthogonal to u (Definitions 1 and 2, limit K -> infinity).
/// All values are NaN unless status is Valid: Degenerate where |mu0| <= 1e-12 area, Invalid where a
/// measure is not finite or u is zero or not finite. `u` need not be of unit length.
Curvatures curvatures(const MeasureSum& m, const Vec3& u);
Curvatures curvatures(const Measures& m, const Vec3& u);

/// Two unit vectors that span the plane orthogonal to the unit vector `u`, (t1, t2, u) right-handed.
void tangent_basis(const Vec3& u, Vec3& t1, Vec3& t2);

}  // namespace kappa
