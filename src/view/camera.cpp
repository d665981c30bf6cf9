// SPDX-License-Identifier: BSD-3-Clause
#include "camera.hpp"

#include <vtkCamera.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include "kappa/core/bounds.hpp"
#include "kappa/scan/scan.hpp"

namespace kappa {
namespace {

constexpr double kLowTerrain = 0.35;  // height / extent in plan below which a scan is taken for terrain
constexpr double kSteep = 0.26;       // cosine of 75 degrees: a surface of heights over the plan is seldom steeper
constexpr double kViewAngle = 22;     // degrees; mild perspective

/// Extent of the middle 99 % along an axis: a few stray returns do not make a terrain tall.
double extent(const std::vector<Vec3>& points, int axis) {
  std::vector<double> values;
  for (const Vec3& x : points) {
    if (is_finite(x)) values.push_back(x[axis]);
  }
  if (values.empty()) return 0;
  const auto at = [&](double p) {
    const auto i = static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + i, values.end());
    return values[static_cast<std::size_t>(i)];
  };
  const double low = at(0.005);
  return at(0.995) - low;
}

/// Whether the cloud is a surface of heights over the plan, of any relief: nine of ten normals lean up.
bool is_seen_from_above(const Scan& scan) {
  if (scan.is_mesh() || scan.normals.size() != scan.points.size()) return false;
  std::size_t up = 0, all = 0;
  for (const Vec3& u : scan.normals) {
    if (!is_finite(u) || u.isZero(0)) continue;
    ++all;
    up += u.z() > kSteep * u.norm();
  }
  return 10 * up > 9 * all;
}

/// Whether the points lie in the frame of a depth camera: all within 45 degrees of its z axis, seen from its origin.
bool in_camera_frame(const Scan& scan) {
  if (scan.is_mesh() || scan.normals.size() != scan.points.size()) return false;
  std::size_t towards = 0, away = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Vec3 x = scan.points[i] + scan.origin;
    if (!is_finite(x)) continue;
    if (!(x.z() > 0 && std::abs(x.x()) <= x.z() && std::abs(x.y()) <= x.z())) return false;
    const double side = x.dot(scan.normals[i]);
    towards += side < 0;
    away += side > 0;
  }
  return towards > 9 * away;
}

}  // namespace

Camera automatic_camera(const Scan& scan) {
  const double x = extent(scan.points, 0), y = extent(scan.points, 1), z = extent(scan.points, 2);
  if (z < kLowTerrain * std::sqrt(x * y)) return {-18, 48, 1, UpAxis::Z};
  if (in_camera_frame(scan)) return {15, 20, 1, UpAxis::NegativeY};
  if (is_seen_from_above(scan)) return {-18, 48, 1, UpAxis::Z};
  if (!scan.is_mesh()) return {-35, 22, 1, UpAxis::Z};
  if (y < kLowTerrain * std::sqrt(x * z)) return {-18, 48, 1, UpAxis::Y};
  return {-35, 22, 1, UpAxis::Y};
}

namespace view_detail {

namespace {

/// `v` of a world whose z is up, in that of the camera.
Vec3 turned(const Vec3& v, UpAxis up) {
  switch (up) {
    case UpAxis::Y:
      return {v.x(), v.z(), -v.y()};
    case UpAxis::NegativeY:
      return {v.x(), -v.z(), v.y()};
    case UpAxis::Z:
      break;
  }
  return v;
}

}  // namespace

Vec3 towards_eye(const Camera& camera) {
  const double a = camera.azimuth * kPi / 180, e = camera.elevation * kPi / 180;
  return turned({std::cos(e) * std::sin(a), -std::cos(e) * std::cos(a), std::sin(e)}, camera.up);
}

void place_camera(vtkCamera* placed, const std::vector<Vec3>& points, const Camera& camera, double aspect,
                  const Frame& frame) {
  const Vec3 towards = towards_eye(camera);
  const double a = camera.azimuth * kPi / 180;
  const Vec3 right = turned({std::cos(a), std::sin(a), 0}, camera.up);
  const Vec3 up = towards.cross(right);
  // A point (r, u, d) in the axes right, up, towards is seen at ((r - cr) / ((cd - d) t aspect), (u - cu) / ((cd - d)
  // t)) from an eye at (cr, cu, cd). Each side of the frame is a plane through the eye: all points are to be on its
  // inner side, which bounds linear functions of the eye by their maxima over the points.
  const double t = std::tan(0.5 * kViewAngle * kPi / 180);
  const double half_x = (frame.right - frame.left) * t * aspect, half_y = (frame.top - frame.bottom) * t;
  const double shift_x = (frame.right + frame.left - 1) * t * aspect, shift_y = (frame.top + frame.bottom - 1) * t;
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  std::array<double, 4> sides = {kNone, kNone, kNone, kNone};
  for (const Vec3& x : points) {
    if (!is_finite(x)) continue;
    const double d = x.dot(towards), r = x.dot(right) + shift_x * d, u = x.dot(up) + shift_y * d;
    sides = {std::max(sides[0], r + half_x * d), std::max(sides[1], -r + half_x * d),
             std::max(sides[2], u + half_y * d), std::max(sides[3], -u + half_y * d)};
  }
  double distance = std::max((sides[0] + sides[1]) / (2 * half_x), (sides[2] + sides[3]) / (2 * half_y));
  const Bounds box = bounds(points);
  const Vec3 middle = 0.5 * (box.min + box.max);
  const double depth = middle.dot(towards);
  distance = std::max(distance, depth + 1e-6 * (1 + box.diagonal()));  // a single point
  const double cr = 0.5 * (sides[0] - sides[1]) - shift_x * distance;
  const double cu = 0.5 * (sides[2] - sides[3]) - shift_y * distance;
  const Vec3 eye = cr * right + cu * up + distance * towards;
  const Vec3 focus = eye - (distance - depth) * towards;
  placed->SetPosition(eye.data());
  placed->SetFocalPoint(focus.data());
  placed->SetViewUp(up.data());
  placed->SetViewAngle(kViewAngle / camera.zoom);
}

}  // namespace view_detail
}  // namespace kappa
