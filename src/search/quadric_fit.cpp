// SPDX-License-Identifier: BSD-3-Clause
#include "quadric_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace kappa {
namespace {

/// Sums of x^i y^j for i + j <= 4 and of z x^i y^j for i + j <= 2, in lanes that a compiler can make vectors of.
struct Moments {
  static constexpr std::size_t kLanes = 4, kPlane = 15, kHeight = 6;
  std::array<std::array<double, kLanes>, kPlane> plane{};    // 1 x y xx xy yy xxx xxy xyy yyy xxxx xxxy xxyy xyyy yyyy
  std::array<std::array<double, kLanes>, kHeight> height{};  // z zx zy zxx zxy zyy
  std::array<double, kLanes> square{};

  void add(std::size_t lane, double x, double y, double z) {
    const double xx = x * x, xy = x * y, yy = y * y;
    const std::array<double, kPlane> p{1,      x,      y,       xx,      xy,      yy,      xx * x, xx * y,
                                       x * yy, yy * y, xx * xx, xx * xy, xx * yy, xy * yy, yy * yy};
    for (std::size_t i = 0; i < kPlane; ++i) plane[i][lane] += p[i];
    for (std::size_t i = 0; i < kHeight; ++i) height[i][lane] += z * p[i];
    square[lane] += z * z;
  }
};

double total(const std::array<double, Moments::kLanes>& lanes) {
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

}  // namespace

Frame frame_around(const Vec3& normal) {
  Frame frame;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  return frame;
}

void QuadricFit::add(const Vec3& d) {
  const Vec3 q = frame_.transpose() * d / unit_;
  Vec6 a;
  a << 1, q.x(), q.y(), 0.5 * q.x() * q.x(), q.x() * q.y(), 0.5 * q.y() * q.y();
  normal_ += a * a.transpose();
  right_ += a * q.z();
  square_ += q.z() * q.z();
  ++count_;
}

void QuadricFit::add(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z) {
  const Mat3 to_frame = frame_.transpose() / unit_;
  Moments m;
  const auto add_point = [&](std::size_t lane, std::size_t i) {
    const auto row = [&](int r) { return to_frame(r, 0) * x[i] + to_frame(r, 1) * y[i] + to_frame(r, 2) * z[i]; };
    m.add(lane, row(0), row(1), row(2));
  };
  const std::size_t whole = x.size() - x.size() % Moments::kLanes;
  for (std::size_t i = 0; i < whole; i += Moments::kLanes) {
    for (std::size_t lane = 0; lane < Moments::kLanes; ++lane) add_point(lane, i + lane);
  }
  for (std::size_t i = whole; i < x.size(); ++i) add_point(i - whole, i);
  std::array<double, Moments::kPlane> s{};
  for (std::size_t i = 0; i < s.size(); ++i) s[i] = total(m.plane[i]);
  Mat6 products;
  products << s[0], s[1], s[2], s[3] / 2, s[4], s[5] / 2,             //
      s[1], s[3], s[4], s[6] / 2, s[7], s[8] / 2,                     //
      s[2], s[4], s[5], s[7] / 2, s[8], s[9] / 2,                     //
      s[3] / 2, s[6] / 2, s[7] / 2, s[10] / 4, s[11] / 2, s[12] / 4,  //
      s[4], s[7], s[8], s[11] / 2, s[12], s[13] / 2,                  //
      s[5] / 2, s[8] / 2, s[9] / 2, s[12] / 4, s[13] / 2, s[14] / 4;
  normal_ += products;
  for (int i = 0; i < 6; ++i) right_[i] += total(m.height[static_cast<std::size_t>(i)]) * (i == 3 || i == 5 ? 0.5 : 1);
  square_ += total(m.square);
  count_ += x.size();
}

double QuadricFit::variance() const {
  if (count_ <= 6) return kNaN;
  const Vec6 c = Eigen::LDLT<Mat6>(normal_).solve(right_);
  return std::max(0.0, square_ - c.dot(right_)) / static_cast<double>(count_ - 6) * unit_ * unit_;
}

std::pair<double, double> QuadricFit::mean_curvature() const {
  const Eigen::LDLT<Mat6> solver(normal_);
  const Vec6 c = solver.solve(right_);
  const double p = c[1], q = c[2], w = 1 + p * p + q * q;
  Vec6 by = Vec6::Zero();  // the curvature is linear in the second derivatives
  by[3] = (1 + q * q) / (2 * w * std::sqrt(w));
  by[4] = -2 * p * q / (2 * w * std::sqrt(w));
  by[5] = (1 + p * p) / (2 * w * std::sqrt(w));
  return {by.dot(c) / unit_, by.dot(solver.solve(by)) / std::pow(unit_, 4)};
}

Vec3 QuadricFit::normal_or(const Vec3& plane) const {
  const Vec3 u = normal();
  return u.isZero(0) ? plane : u;
}

const QuadricFit& better_fit(const QuadricFit& smaller, const QuadricFit& larger) {
  constexpr double kSame = 1.5;
  return larger.variance() <= kSame * smaller.variance() ? larger : smaller;
}

Vec3 QuadricFit::normal() const {
  if (count_ < kLeastForQuadric) return Vec3::Zero();
  const Eigen::LDLT<Mat6> solver(normal_);
  if (solver.info() != Eigen::Success || !solver.isPositive()) return Vec3::Zero();
  const auto variance_of = [&](int i) { return solver.solve(Vec6::Unit(i))[i]; };
  const double of_quadric = variance_of(1) + variance_of(2);
  const Mat3 plane = normal_.topLeftCorner<3, 3>().inverse();
  const double of_plane = plane(1, 1) + plane(2, 2);
  if (!(of_quadric > 0 && of_quadric <= kUncertain * kUncertain * of_plane)) return Vec3::Zero();
  const Vec6 c = solver.solve(right_);
  return (frame_ * Vec3(-c[1], -c[2], 1)).normalized();
}

}  // namespace kappa
