// SPDX-License-Identifier: BSD-3-Clause
#include "quadric_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

namespace kappa {
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

void QuadricFit::take(const kernels::PointColumns& points, std::size_t count) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> to_frame = frame_.transpose() / unit_;
  std::array<double, kernels::kQuadricSums> s;
  kernels::best_point_table().quadric_sums(points, count, to_frame.data(), s.data());
  const double *low = s.data(), *height = low + 5, square = s[11], *cubic = low + 12, *quartic = low + 16;
  Mat6 products;
  products << static_cast<double>(count), low[0], low[1], low[2] / 2, low[3], low[4] / 2,      //
      low[0], low[2], low[3], cubic[0] / 2, cubic[1], cubic[2] / 2,                            //
      low[1], low[3], low[4], cubic[1] / 2, cubic[2], cubic[3] / 2,                            //
      low[2] / 2, cubic[0] / 2, cubic[1] / 2, quartic[0] / 4, quartic[1] / 2, quartic[2] / 4,  //
      low[3], cubic[1], cubic[2], quartic[1] / 2, quartic[2], quartic[3] / 2,                  //
      low[4] / 2, cubic[2] / 2, cubic[3] / 2, quartic[2] / 4, quartic[3] / 2, quartic[4] / 4;
  normal_ += products;
  for (int i = 0; i < 6; ++i) right_[i] += height[i] * (i == 3 || i == 5 ? 0.5 : 1);
  square_ += square;
  count_ += count;
}

double QuadricFit::variance() const {
  if (count_ <= 6) return kNaN;
  const Vec6 c = Eigen::LDLT<Mat6>(normal_).solve(right_);
  return std::max(0.0, square_ - c.dot(right_)) / static_cast<double>(count_ - 6) * unit_ * unit_;
}

QuadricFit::Curvature QuadricFit::curvature() const {
  const Eigen::LDLT<Mat6> solver(normal_);
  const Vec6 c = solver.solve(right_);
  const double p = c[1], q = c[2], w = 1 + p * p + q * q;
  Vec6 by = Vec6::Zero();  // the curvature is linear in the second derivatives
  by[3] = (1 + q * q) / (2 * w * std::sqrt(w));
  by[4] = -2 * p * q / (2 * w * std::sqrt(w));
  by[5] = (1 + p * p) / (2 * w * std::sqrt(w));
  const double gaussian = (c[3] * c[5] - c[4] * c[4]) / (w * w);
  return {by.dot(c) / unit_, gaussian / (unit_ * unit_), by.dot(solver.solve(by)) / std::pow(unit_, 4)};
}

Vec3 QuadricFit::normal_or(const Vec3& plane) const {
  const Vec3 u = normal();
  return u.isZero(0) ? plane : u;
}

double QuadricFit::normal_variance() const {
  const Eigen::LDLT<Mat6> solver(normal_);
  return (solver.solve(Vec6::Unit(1))[1] + solver.solve(Vec6::Unit(2))[2]) / (unit_ * unit_);
}

const QuadricFit& better_fit(const QuadricFit& smaller, const QuadricFit& larger) {
  constexpr double kSame = 1.5;
  return larger.variance() <= kSame * smaller.variance() ? larger : smaller;
}

QuadricFit::Fitted QuadricFit::fitted() const {
  if (count_ < kLeastForQuadric) return {Vec3::Zero(), variance()};
  const Eigen::LLT<Mat6> solver(normal_);
  if (solver.info() != Eigen::Success) return {Vec3::Zero(), variance()};
  const Vec6 half_way = solver.matrixL().solve(right_);
  const double residuals = std::max(0.0, square_ - half_way.squaredNorm()) / static_cast<double>(count_ - 6);
  Fitted result = {Vec3::Zero(), residuals * unit_ * unit_};
  const auto variance_of = [&](int i) { return solver.matrixL().solve(Vec6::Unit(i)).squaredNorm(); };
  const double of_quadric = variance_of(1) + variance_of(2);
  const Mat3 plane = normal_.topLeftCorner<3, 3>().inverse();
  const double of_plane = plane(1, 1) + plane(2, 2);
  if (!(of_quadric > 0 && of_quadric <= kUncertain * kUncertain * of_plane)) return result;
  const Vec6 c = solver.matrixU().solve(half_way);
  result.normal = (frame_ * Vec3(-c[1], -c[2], 1)).normalized();
  return result;
}

}  // namespace kappa
