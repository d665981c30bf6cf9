// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "kappa/shapes/truth.hpp"

/// Points of the analytic shapes, from which their meshes and clouds are made.
namespace kappa::detail {

inline SurfacePoint sphere_point(double radius, const Vec3& direction) {
  const double k = 1 / radius;
  SurfacePoint point;
  point.x = radius * direction;
  point.normal = direction;
  point.curvature.mean = point.curvature.k_min = point.curvature.k_max = k;
  point.curvature.gaussian = k * k;
  return point;
}

/// `a` around the axis, `b` around the tube.
inline SurfacePoint torus_point(double major_radius, double minor_radius, double a, double b) {
  const Vec3 outward(std::cos(a), std::sin(a), 0), around(-std::sin(a), std::cos(a), 0);
  const double arm = major_radius + minor_radius * std::cos(b);
  const Vec3 radial = std::cos(b) * outward + std::sin(b) * Vec3::UnitZ();
  const Vec3 turned = std::cos(b) * Vec3::UnitZ() - std::sin(b) * outward;
  ParametricJet jet;
  jet.x = major_radius * outward + minor_radius * radial;
  jet.du = arm * around;
  jet.dv = minor_radius * turned;
  jet.duu = -arm * outward;
  jet.duv = -minor_radius * std::sin(b) * around;
  jet.dvv = -minor_radius * radial;
  return surface_point(jet);
}

inline SurfacePoint cylinder_point(double radius, double angle, double z) {
  SurfacePoint point;
  point.normal = {std::cos(angle), std::sin(angle), 0};
  point.x = radius * point.normal + z * Vec3::UnitZ();
  point.curvature.k_min = point.curvature.gaussian = 0;
  point.curvature.k_max = 1 / radius;
  point.curvature.mean = 0.5 / radius;
  point.curvature.dir_min = Vec3::UnitZ();
  point.curvature.dir_max = {-point.normal.y(), point.normal.x(), 0};
  return point;
}

/// z = (a x^2 + b y^2) / 2.
inline SurfacePoint quadric_point(double a, double b, double x, double y) {
  HeightJet jet;
  jet.z = 0.5 * (a * x * x + b * y * y);
  jet.zx = a * x;
  jet.zy = b * y;
  jet.zxx = a;
  jet.zyy = b;
  return surface_point(x, y, jet);
}

}  // namespace kappa::detail
