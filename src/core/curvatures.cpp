// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/curvatures.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace kappa {
namespace {

/// Eigenpairs of the symmetric matrix [a b; b c], increasing, directions in its plane.
struct Eigen2 {
  double low, high;
  Vec2 dir_low, dir_high;
};

Eigen2 eigen_symmetric(double a, double b, double c) {
  const double centre = 0.5 * (a + c), half = 0.5 * (a - c);
  const double radius = std::hypot(half, b);
  if (radius == 0) return {centre, centre, Vec2(0, 1), Vec2(1, 0)};
  // Half of the angle of (half, b), from the sum that does not cancel.
  const double larger = std::sqrt(0.5 + 0.5 * std::abs(half) / radius), smaller = 0.5 * b / (radius * larger);
  const Vec2 high = half >= 0 ? Vec2(larger, smaller) : Vec2(std::abs(smaller), std::copysign(larger, b));
  return {centre - radius, centre + radius, Vec2(-high.y(), high.x()), high};
}

bool all_finite(const MeasureSum& m) {
  double sum = m.area + m.mu0 + m.mu2;
  for (const double value : m.mu_sym) sum += value;
  return std::isfinite(sum);
}

}  // namespace

void tangent_basis(const Vec3& u, Vec3& t1, Vec3& t2) {
  // Duff et al. 2017, "Building an orthonormal basis, revisited": no branch, no loss near the poles.
  const double sign = std::copysign(1.0, u.z());
  const double a = -1.0 / (sign + u.z());
  const double b = u.x() * u.y() * a;
  t1 = Vec3(1.0 + sign * u.x() * u.x() * a, sign * b, -sign * u.x());
  t2 = Vec3(b, sign + u.y() * u.y() * a, -u.y());
}

CurvatureRatios curvature_ratios(const MeasureSum& m, const Vec3& u) {
  CurvatureRatios ratios;
  const double length = u.norm();
  if (!all_finite(m) || !std::isfinite(length) || length == 0) return ratios;
  if (std::abs(m.mu0) <= kDegenerateArea * m.area) {
    ratios.status = PointStatus::Degenerate;
    return ratios;
  }
  Vec3 t1, t2;
  tangent_basis(u / length, t1, t2);
  const Mat3 second_form = m.tensor() / -m.mu0;
  const Vec3 s1 = second_form * t1, s2 = second_form * t2;
  ratios.mean = 0.5 * m.mu1() / m.mu0;
  ratios.gaussian = m.mu2 / m.mu0;
  ratios.form = {t1.dot(s1), t1.dot(s2), t2.dot(s2)};
  ratios.status = PointStatus::Valid;
  return ratios;
}

Curvatures curvatures(const CurvatureRatios& ratios, const Vec3& u) {
  Curvatures k;
  k.status = ratios.status;
  if (ratios.status != PointStatus::Valid) return k;
  Vec3 t1, t2;
  tangent_basis(u / u.norm(), t1, t2);
  const Eigen2 e = eigen_symmetric(ratios.form[0], ratios.form[1], ratios.form[2]);
  k.mean = ratios.mean;
  k.gaussian = ratios.gaussian;
  k.k_min = e.low;
  k.k_max = e.high;
  k.dir_min = (e.dir_low.x() * t1 + e.dir_low.y() * t2).normalized();
  k.dir_max = (e.dir_high.x() * t1 + e.dir_high.y() * t2).normalized();
  return k;
}

Curvatures curvatures(const MeasureSum& m, const Vec3& u) {
  return curvatures(curvature_ratios(m, u), u);
}

Curvatures curvatures(const Measures& m, const Vec3& u) {
  return curvatures(compact(m), u);
}

}  // namespace kappa
