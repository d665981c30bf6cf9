// SPDX-License-Identifier: BSD-3-Clause
#include "plane_fit.hpp"

#include <Eigen/Eigenvalues>

namespace kappa {
namespace {

/// A symmetric matrix.
struct Symmetric {
  double xx, xy, xz, yy, yz, zz;

  explicit Symmetric(const Mat3& m) : xx(m(0, 0)), xy(m(0, 1)), xz(m(0, 2)), yy(m(1, 1)), yz(m(1, 2)), zz(m(2, 2)) {}
  Symmetric(double xx_, double xy_, double xz_, double yy_, double yz_, double zz_)
      : xx(xx_), xy(xy_), xz(xz_), yy(yy_), yz(yz_), zz(zz_) {}

  double trace() const { return xx + yy + zz; }
  Symmetric adjugate() const {
    return {yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy,
            xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy};
  }
  Symmetric square() const {
    return {xx * xx + xy * xy + xz * xz, xx * xy + xy * yy + xz * yz, xx * xz + xy * yz + xz * zz,
            xy * xy + yy * yy + yz * yz, xy * xz + yy * yz + yz * zz, xz * xz + yz * yz + zz * zz};
  }
  Symmetric scaled(double s) const { return {s * xx, s * xy, s * xz, s * yy, s * yz, s * zz}; }
  /// Of the columns that with the largest diagonal element.
  Vec3 main_column() const {
    if (xx >= yy && xx >= zz) return {xx, xy, xz};
    return yy >= zz ? Vec3(xy, yy, yz) : Vec3(xz, yz, zz);
  }
};

/// Sets `direction` to that of the least eigenvalue of a covariance of trace 1; false if it is not clear enough for
/// this. The adjugate has the same eigenvectors, its largest eigenvalue there, and its powers tend to the projection on
/// it.
bool find_least_direction(const Mat3& covariance, Vec3& direction) {
  constexpr double kClear = 1e-3, kAlone = 1e-9;
  constexpr int kSquarings = 7;
  Symmetric power = Symmetric(covariance).adjugate();
  double trace = power.trace();
  if (!(trace > kClear)) return false;
  for (int i = 0; i < kSquarings; ++i) {
    power = power.scaled(1 / trace).square();
    trace = power.trace();
    if (trace < 1 - kAlone) continue;
    direction = power.main_column().normalized();
    return true;
  }
  return false;
}

}  // namespace

Moments moments_of(std::size_t count, const PlaneSums& s) {
  Moments m = {count, Vec3(s[0], s[1], s[2]), {}};
  m.products << s[3], s[4], s[5], s[4], s[6], s[7], s[5], s[7], s[8];
  return m;
}

Plane plane_of_moments(const Moments& m) {
  const auto count = static_cast<double>(m.count);
  Plane plane{Vec3::Zero(), m.sum.norm() / count};
  if (m.count < 3) return plane;
  const Mat3 covariance = m.products - m.sum * (m.sum / count).transpose();
  const double size = covariance.trace();
  if (!(size > 0)) return plane;
  if (find_least_direction(covariance / size, plane.normal)) return plane;
  Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance / size);
  constexpr double kCollinear = 1e-12;
  if (solver.eigenvalues()[1] > kCollinear) plane.normal = solver.eigenvectors().col(0).normalized();
  return plane;
}

}  // namespace kappa
