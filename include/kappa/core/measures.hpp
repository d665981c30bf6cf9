// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// The corrected measures of a face or of a ball: integrals of the interpolated corrected normal current.
///
/// Source: Lachaud, Romon, Thibert, Coeurjolly, "Interpolated corrected curvature measures for polygonal surfaces", CGF
/// 39(5), 2020 ("the paper"), Property 1. The formulas are in docs/method.md, in a form that uses differences of
/// positions alone, so that no accuracy is lost far from the origin.
///
/// Identities: trace(mu_xy) == -mu1. A triangle with the mean normal ub has ub^T mu_xy == 0. If all lengths are
/// multiplied by s, area and mu0 are multiplied by s^2, mu1 and mu_xy by s, and mu2 by 1.
struct Measures {
  double area = 0;            ///< area of the face itself, whatever the normals are; length^2
  double mu0 = 0;             ///< corrected area, the measure mu^(0); length^2
  double mu1 = 0;             ///< integral of k_min + k_max, the measure mu^(1); length
  double mu2 = 0;             ///< integral of the Gaussian curvature, the measure mu^(2); no unit
  Mat3 mu_xy = Mat3::Zero();  ///< X^T mu_xy Y is the measure mu^(X,Y), minus the second fundamental form; length

  Measures& operator+=(const Measures& other);
};

/// The nine numbers of `Measures` that the curvatures of a ball need: mu1 is minus the trace of the tensor, and only
/// the symmetric part of the tensor counts.
struct MeasureSum {
  double area = 0;  ///< length^2
  double mu0 = 0;   ///< length^2
  double mu2 = 0;   ///< no unit
  /// The symmetric part of mu_xy, (mu_xy + mu_xy^T) / 2: xx, yy, zz, xy, xz, yz; length.
  std::array<double, 6> mu_sym{};

  double mu1() const { return -(mu_sym[0] + mu_sym[1] + mu_sym[2]); }
  /// The symmetric part of mu_xy as a matrix.
  Mat3 tensor() const;
  MeasureSum& operator+=(const MeasureSum& other);
  MeasureSum& operator*=(double factor);
};

/// The part of `m` that a MeasureSum holds.
MeasureSum compact(const Measures& m);

/// The corrected measures of a triangle with the corners `x` and the corrected unit normals `u` there (Property 1 of
/// the paper). They are exact for normals that are interpolated linearly and are not made units inside.
Measures triangle_measures(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u);

/// The measures of a triangle with the edge vectors e1 = x1 - x0, e2 = x2 - x0 and the differences of normals
/// d1 = u1 - u0, d2 = u2 - u0, with any vector `u` in the place of the mean normal. The measures are linear in `u`.
/// With the interpolated normal at a place of the triangle they are the density at this place times the area of the
/// triangle.
Measures triangle_density(const Vec3& e1, const Vec3& e2, const Vec3& d1, const Vec3& d2, const Vec3& u);

/// The part of `triangle_density` that a MeasureSum holds, at less cost.
MeasureSum triangle_density_sum(const Vec3& e1, const Vec3& e2, const Vec3& d1, const Vec3& d2, const Vec3& u);

/// The barycentre of a polygon: the mean of its n >= 1 corners `x`.
Vec3 polygon_barycentre(const Vec3* x, std::size_t n);

/// The normal that a polygon has at its barycentre: the mean of the n >= 1 normals `u` of its corners, made a unit
/// vector. It is the zero vector if the mean is shorter than 1e-12.
Vec3 barycentre_normal(const Vec3* u, std::size_t n);

/// The corrected measures of a polygon with n >= 3 corners `x` and the normals `u` there (Section 2 of the paper). A
/// polygon that is no triangle is split into n triangles at its barycentre.
Measures polygon_measures(const Vec3* x, const Vec3* u, std::size_t n);

}  // namespace kappa
