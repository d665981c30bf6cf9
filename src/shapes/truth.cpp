// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/truth.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

/// Two unit vectors that complete the unit vector `n` to a right-handed basis (t1, t2, n).
void complete_basis(const Vec3& n, Vec3& t1, Vec3& t2) {
  int least = 0;
  n.cwiseAbs().minCoeff(&least);
  t1 = n.cross(Vec3::Unit(least)).normalized();
  t2 = n.cross(t1);
}

}  // namespace

HeightJet& HeightJet::operator+=(const HeightJet& other) {
  z += other.z;
  zx += other.zx;
  zy += other.zy;
  zxx += other.zxx;
  zxy += other.zxy;
  zyy += other.zyy;
  return *this;
}

TrueCurvature principal_curvatures(double a, double b, double c, const Vec3& t1, const Vec3& t2) {
  TrueCurvature k;
  k.mean = 0.5 * (a + c) + 0.0;  // a plane has 0, not -0
  k.gaussian = a * c - b * b;
  const double half_gap = std::hypot(0.5 * (a - c), b);
  k.k_min = k.mean - half_gap;
  k.k_max = k.mean + half_gap;
  if (2 * half_gap > kUmbilicGap * std::max(std::abs(k.k_min), std::abs(k.k_max))) {
    const double angle = 0.5 * std::atan2(2 * b, a - c);
    k.dir_max = std::cos(angle) * t1 + std::sin(angle) * t2;
    k.dir_min = std::cos(angle) * t2 - std::sin(angle) * t1;
  }
  return k;
}

SurfacePoint surface_point(const ParametricJet& jet) {
  SurfacePoint point;
  point.x = jet.x;
  point.normal = jet.du.cross(jet.dv);
  const double area = point.normal.norm();
  if (!(area > 0)) {
    point.normal = Vec3::Constant(kNaN);
    return point;
  }
  point.normal /= area;
  const double length = jet.du.norm();
  const Vec3 t1 = jet.du / length;
  const Vec3 t2 = point.normal.cross(t1);
  // (du, dv) = (t1, t2) J with J upper triangular; the form below is J^-T II J^-1.
  const double shear = t1.dot(jet.dv) / length, width = t2.dot(jet.dv);
  const double l = -jet.duu.dot(point.normal), m = -jet.duv.dot(point.normal), n = -jet.dvv.dot(point.normal);
  const double a = l / (length * length);
  const double b = (m - l * shear) / (length * width);
  const double c = (n - 2 * m * shear + l * shear * shear) / (width * width);
  point.curvature = principal_curvatures(a, b, c, t1, t2);
  return point;
}

SurfacePoint surface_point(const Vec3& x, const ImplicitJet& jet) {
  SurfacePoint point;
  point.x = x;
  const double slope = jet.gradient.norm();
  if (!(slope > 0)) {
    point.normal = Vec3::Constant(kNaN);
    return point;
  }
  point.normal = jet.gradient / slope;
  Vec3 t1, t2;
  complete_basis(point.normal, t1, t2);
  const Vec3 h1 = jet.hessian * t1 / slope, h2 = jet.hessian * t2 / slope;
  point.curvature = principal_curvatures(t1.dot(h1), t1.dot(h2), t2.dot(h2), t1, t2);
  return point;
}

SurfacePoint surface_point(double x, double y, const HeightJet& jet) {
  ParametricJet parametric;
  parametric.x = {x, y, jet.z};
  parametric.du = {1, 0, jet.zx};
  parametric.dv = {0, 1, jet.zy};
  parametric.duu = {0, 0, jet.zxx};
  parametric.duv = {0, 0, jet.zxy};
  parametric.dvv = {0, 0, jet.zyy};
  return surface_point(parametric);
}

void add_truth_fields(Scan& scan, const std::vector<TrueCurvature>& truth) {
  const auto add = [&](const char* name, auto value) {
    Field field;
    field.name = name;
    field.values.reserve(truth.size());
    for (const auto& k : truth) field.values.push_back(value(k));
    scan.fields.push_back(std::move(field));
  };
  using Truth = const TrueCurvature&;
  add("mean_curvature", [](Truth k) { return k.mean; });
  add("gaussian_curvature", [](Truth k) { return k.gaussian; });
  add("k_min", [](Truth k) { return k.k_min; });
  add("k_max", [](Truth k) { return k.k_max; });
  add("dir_min_x", [](Truth k) { return k.dir_min.x(); });
  add("dir_min_y", [](Truth k) { return k.dir_min.y(); });
  add("dir_min_z", [](Truth k) { return k.dir_min.z(); });
  add("dir_max_x", [](Truth k) { return k.dir_max.x(); });
  add("dir_max_y", [](Truth k) { return k.dir_max.y(); });
  add("dir_max_z", [](Truth k) { return k.dir_max.z(); });
}

Scan scan_of(const std::vector<SurfacePoint>& points) {
  Scan scan;
  std::vector<TrueCurvature> truth;
  scan.points.reserve(points.size());
  scan.normals.reserve(points.size());
  truth.reserve(points.size());
  for (const auto& point : points) {
    scan.points.push_back(point.x);
    scan.normals.push_back(point.normal);
    truth.push_back(point.curvature);
  }
  scan.width = points.size();
  add_truth_fields(scan, truth);
  return scan;
}

}  // namespace kappa
