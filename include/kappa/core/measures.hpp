// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "kappa/core/types.hpp"

namespace kappa {

/// Integrals of the interpolated corrected normal current over a face or a ball.
///
/// Source: Lachaud, Romon, Thibert, Coeurjolly, "Interpolated corrected curvature measures for
/// polygonal surfaces", CGF 39(5), 2020, Property 1, in the form that uses differences of
/// positions alone, so that no accuracy is lost far from the origin.
///
/// Identities: trace(mu_xy) == -mu1; u_bar^T mu_xy == 0 for a triangle of mean normal u_bar.
/// Scaling by s multiplies area and mu0 by s^2, mu1 and mu_xy by s, mu2 by 1.
struct Measures {
  double area = 0;            ///< area of the face itself, whatever the normals; length^2
  double mu0 = 0;             ///< corrected area; length^2
  double mu1 = 0;             ///< integral of k_min + k_max (twice the mean curvature); length
  double mu2 = 0;             ///< integral of the Gaussian curvature
  Mat3 mu_xy = Mat3::Zero();  ///< mu^(X,Y), row = X, column = Y: minus the second form; length

  Measures& operator+=(const Measures& other);
};

/// The nine scalars that a ball needs: mu1 is minus the trace of the tensor, and only the
/// symmetric part of the tensor counts.
struct MeasureSum {
  double area = 0;
  double mu0 = 0;
  double mu2 = 0;
  /// Symmetric part of mu^(X,Y): xx, yy, zz, xy, xz, yz.
  std::array<double, 6> mu_sym{};

  double mu1() const { return -(mu_sym[0] + mu_sym[1] + mu_sym[2]); }
  Mat3 tensor() const;
  MeasureSum& operator+=(const MeasureSum& other);
  MeasureSum& operator*=(double factor);
};

/// The part of `m` that a ball sum keeps.
MeasureSum compact(const Measures& m);

/// Corrected measures of a triangle, exact for normals interpolated linearly and not renormalised
/// (Property 1). `x` are the corners, `u` the corrected unit normals there.
Measures triangle_measures(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u);

/// The same from edge vectors e = x_i - x_0, d = u_i - u_0 and a normal `u` in place of the mean
/// normal. The measures are linear in `u`: with the normal at a point of the triangle this is the
/// density there times the area of the triangle.
Measures triangle_density(const Vec3& e1, const Vec3& e2, const Vec3& d1, const Vec3& d2, const Vec3& u);

/// Compact form of `triangle_density`, cheaper.
MeasureSum triangle_density_sum(const Vec3& e1, const Vec3& e2, const Vec3& d1, const Vec3& d2, const Vec3& u);

/// Corrected measures of the bilinear patch with corners and normals in the order
/// (00, 10, 01, 11) (Appendix B, with mu^(X,Y) corrected). `area` is that of the four triangles
/// of `split_polygon`.
Measures bilinear_measures(const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& u);

/// Corrected measures of a square of side `h` spanned by the unit vectors `axis_x`, `axis_y`, with
/// normals in the order (00, 10, 01, 11) (Appendix C, with mu^(X,Y) corrected).
Measures surfel_measures(const Vec3& axis_x, const Vec3& axis_y, double h, const std::array<Vec3, 4>& u);

/// Barycentre of a polygon, the mean of its n vertices.
Vec3 polygon_barycentre(const Vec3* x, std::size_t n);

/// Normal that a polygon gets at its barycentre: the normalised mean of the n vertex normals, the
/// zero vector if that mean is shorter than 1e-12.
Vec3 barycentre_normal(const Vec3* u, std::size_t n);

/// Corrected measures of a polygon of n >= 3 vertices: a triangle as it is, any other split in n
/// triangles at its barycentre (Section 2 of the paper).
Measures polygon_measures(const Vec3* x, const Vec3* u, std::size_t n);

}  // namespace kappa
