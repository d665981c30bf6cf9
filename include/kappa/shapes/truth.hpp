// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kappa/mesh/mesh.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {

/// Curvature of a smooth surface at a point, in the signs and units of `Curvatures`.
///
/// At an umbilic (sphere, plane, and the points where k_max - k_min <= kUmbilicGap * max |k|) every
/// tangent direction is principal: dir_min and dir_max are NaN there, and nowhere else.
struct TrueCurvature {
  double mean = kNaN;      ///< (k_min + k_max) / 2
  double gaussian = kNaN;  ///< k_min k_max
  double k_min = kNaN, k_max = kNaN;
  Vec3 dir_min = Vec3::Constant(kNaN), dir_max = Vec3::Constant(kNaN);  ///< unit, orthogonal to the normal
};

/// Relative gap of the principal curvatures at or below which a point counts as an umbilic; rounding
/// alone makes a gap of about 1e-15.
inline constexpr double kUmbilicGap = 1e-9;

/// A point of a smooth surface with all that is known of it.
struct SurfacePoint {
  Vec3 x = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< unit, outward or upward
  TrueCurvature curvature;
};

/// A parametrisation x(u, v) and its derivatives up to order two at one (u, v).
struct ParametricJet {
  Vec3 x = Vec3::Zero();
  Vec3 du = Vec3::Zero(), dv = Vec3::Zero();
  Vec3 duu = Vec3::Zero(), duv = Vec3::Zero(), dvv = Vec3::Zero();
};

/// A function f(x) and its derivatives at one x; the surface is f = 0, its outside f > 0.
struct ImplicitJet {
  double value = 0;
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();
};

/// A height z(x, y) and its derivatives at one (x, y).
struct HeightJet {
  double z = 0;
  double zx = 0, zy = 0;
  double zxx = 0, zxy = 0, zyy = 0;

  HeightJet& operator+=(const HeightJet& other);
};

/// The point of a parametrised surface, normal along du x dv. All values but x are NaN where du and dv
/// are parallel (a pole).
SurfacePoint surface_point(const ParametricJet& jet);

/// The point of an implicit surface at `x`, normal along the gradient. `jet.value` is not used: at a
/// point off f = 0 this is the level set through it. NaN where the gradient vanishes.
SurfacePoint surface_point(const Vec3& x, const ImplicitJet& jet);

/// The point (x, y, z) of a height field, normal upward.
SurfacePoint surface_point(double x, double y, const HeightJet& jet);

/// Eigenpairs of the symmetric second form ((a, b), (b, c)) in the orthonormal tangent basis (t1, t2).
TrueCurvature principal_curvatures(double a, double b, double c, const Vec3& t1, const Vec3& t2);

/// Appends the fields mean_curvature gaussian_curvature k_min k_max dir_min_x dir_min_y dir_min_z
/// dir_max_x dir_max_y dir_max_z, in this order, one value a point.
void add_truth_fields(Scan& scan, const std::vector<TrueCurvature>& truth);

/// A scan without faces of these points relative to `origin`, with their normals and truth fields.
Scan scan_of(const std::vector<SurfacePoint>& points);

}  // namespace kappa
