// SPDX-License-Identifier: BSD-3-Clause
#include "quadric_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace kappa {
namespace {

/// The coefficients in their order.
enum Coefficient { kXX, kXY, kYY, kOne, kX, kY };

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
  a << 0.5 * q.x() * q.x(), q.x() * q.y(), 0.5 * q.y() * q.y(), 1, q.x(), q.y();
  normal_ += a * a.transpose();
  right_ += a * q.z();
  square_ += q.z() * q.z();
  ++count_;
}

/// What is of first and second order follows from the moments, but for the squares of heights: these would cancel.
void QuadricFit::take(const kernels::FourPoints* points, std::size_t fours, const Moments& moments) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> to_frame = frame_.transpose() / unit_;
  std::array<double, kernels::kQuadricSums> s;
  kernels::best_point_table().quadric_sums(points, fours, to_frame.data(), s.data());
  const double square = s[0], *height = s.data() + 1, *cubic = height + 3, *quartic = cubic + 4;
  const Vec3 sum = to_frame * moments.sum;
  const Mat3 m = to_frame * moments.products * to_frame.transpose();
  const double xx = m(0, 0), xy = m(0, 1), yy = m(1, 1);
  Mat6 products;
  products << quartic[0] / 4, quartic[1] / 2, quartic[2] / 4, xx / 2, cubic[0] / 2, cubic[1] / 2,  //
      quartic[1] / 2, quartic[2], quartic[3] / 2, xy, cubic[1], cubic[2],                          //
      quartic[2] / 4, quartic[3] / 2, quartic[4] / 4, yy / 2, cubic[2] / 2, cubic[3] / 2,          //
      xx / 2, xy, yy / 2, static_cast<double>(moments.count), sum[0], sum[1],                      //
      cubic[0] / 2, cubic[1], cubic[2] / 2, sum[0], xx, xy,                                        //
      cubic[1] / 2, cubic[2], cubic[3] / 2, sum[1], xy, yy;
  normal_ += products;
  Vec6 right;
  right << height[0] / 2, height[1], height[2] / 2, sum[2], m(2, 0), m(2, 1);
  right_ += right;
  square_ += square;
  count_ += moments.count;
}

double QuadricFit::variance() const {
  if (count_ <= 6) return kNaN;
  const Vec6 c = Eigen::LDLT<Mat6>(normal_).solve(right_);
  return std::max(0.0, square_ - c.dot(right_)) / static_cast<double>(count_ - 6) * unit_ * unit_;
}

QuadricFit::Curvature QuadricFit::curvature() const {
  const Eigen::LDLT<Mat6> solver(normal_);
  const Vec6 c = solver.solve(right_);
  const double p = c[kX], q = c[kY], w = 1 + p * p + q * q;
  Vec6 by = Vec6::Zero();  // the curvature is linear in the second derivatives
  by[kXX] = (1 + q * q) / (2 * w * std::sqrt(w));
  by[kXY] = -2 * p * q / (2 * w * std::sqrt(w));
  by[kYY] = (1 + p * p) / (2 * w * std::sqrt(w));
  const double gaussian = (c[kXX] * c[kYY] - c[kXY] * c[kXY]) / (w * w);
  return {by.dot(c) / unit_, gaussian / (unit_ * unit_), by.dot(solver.solve(by)) / std::pow(unit_, 4)};
}

Vec3 QuadricFit::normal_or(const Vec3& plane) const {
  const Vec3 u = normal();
  return u.isZero(0) ? plane : u;
}

double QuadricFit::normal_variance() const {
  const Eigen::LDLT<Mat6> solver(normal_);
  return (solver.solve(Vec6::Unit(kX))[kX] + solver.solve(Vec6::Unit(kY))[kY]) / (unit_ * unit_);
}

const QuadricFit& better_fit(const QuadricFit& smaller, const QuadricFit& larger) {
  constexpr double kSame = 1.5;
  return larger.variance() <= kSame * smaller.variance() ? larger : smaller;
}

namespace {

/// The normal equations of a quadric after elimination: of row r of the upper triangle what comes after the diagonal,
/// then the right side, over the pivot. The slopes are last: they and their variances follow without the others.
class Eliminated {
 public:
  Eliminated(const QuadricFit::Mat6& normal, const QuadricFit::Vec6& right) {
    for (int r = 0; r < kSize; ++r) {
      for (int c = 0; c < kSize; ++c) rows_[r][c] = normal(c, r);
      rows_[r][kSize] = right[r];
    }
    eliminate<0>();
  }

  bool positive() const { return positive_; }
  double reduction() const { return reduction_; }  ///< of the sum of squares of heights
  double x_slope() const { return rows_[4][6] - rows_[4][5] * rows_[5][6]; }
  double y_slope() const { return rows_[5][6]; }
  double slope_variance() const { return 1 / rows_[4][4] + (1 + rows_[4][5] * rows_[4][5]) / rows_[5][5]; }

 private:
  static constexpr int kSize = 6;

  // With the numbers of the rows known to the compiler it takes a third of the time.
  template <int kPivot>
  void eliminate() {
    double* const pivot = rows_[kPivot];
    positive_ &= pivot[kPivot] > 0;
    const double inverse = 1 / pivot[kPivot];
    subtract<kPivot, kPivot + 1>(inverse);
    reduction_ += pivot[kSize] * pivot[kSize] * inverse;
    for (int c = kPivot + 1; c <= kSize; ++c) pivot[c] *= inverse;
    if constexpr (kPivot + 1 < kSize) eliminate<kPivot + 1>();
  }

  template <int kPivot, int kRow>
  void subtract(double inverse) {
    if constexpr (kRow < kSize) {
      const double factor = rows_[kPivot][kRow] * inverse;
      for (int c = kRow; c <= kSize; ++c) rows_[kRow][c] -= factor * rows_[kPivot][c];
      subtract<kPivot, kRow + 1>(inverse);
    }
  }

  double rows_[kSize][kSize + 1];
  bool positive_ = true;
  double reduction_ = 0;
};

/// Of both slopes of a plane together, for noise of variance 1, by its normal equations for the height and them.
double slope_variance_of_plane(const Mat3& normal) {
  const double x = normal(0, 1), y = normal(0, 2), over_count = 1 / normal(0, 0);
  const double xx = normal(1, 1) - x * x * over_count, yy = normal(2, 2) - y * y * over_count;
  const double xy = normal(1, 2) - x * y * over_count;
  return (xx + yy) / (xx * yy - xy * xy);
}

}  // namespace

QuadricFit::Fitted QuadricFit::fitted() const {
  if (count_ < kLeastForQuadric) return {Vec3::Zero(), variance()};
  const Eliminated solved(normal_, right_);
  if (!solved.positive()) return {Vec3::Zero(), variance()};
  const double residuals = std::max(0.0, square_ - solved.reduction()) / static_cast<double>(count_ - 6);
  Fitted result = {Vec3::Zero(), residuals * unit_ * unit_};
  const double of_quadric = solved.slope_variance();
  const double of_plane = slope_variance_of_plane(normal_.bottomRightCorner<3, 3>());
  if (!(of_quadric > 0 && of_quadric <= kUncertain * kUncertain * of_plane)) return result;
  result.normal = (frame_ * Vec3(-solved.x_slope(), -solved.y_slope(), 1)).normalized();
  return result;
}

}  // namespace kappa
