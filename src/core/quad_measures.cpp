// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/quad_measures.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace kappa {
namespace {

/// Values at the corners 00, 10, 01, 11 of the unit square, interpolated bilinearly.
struct Bilinear {
  const std::array<Vec3, 4>& v;

  Vec3 at(double s, double t) const {
    return (1 - s) * (1 - t) * v[0] + s * (1 - t) * v[1] + (1 - s) * t * v[2] + s * t * v[3];
  }
  Vec3 along_s(double t) const { return (1 - t) * (v[1] - v[0]) + t * (v[3] - v[2]); }
  Vec3 along_t(double s) const { return (1 - s) * (v[2] - v[0]) + s * (v[3] - v[1]); }
};

/// Integral over the unit square of the pull-back of the invariant forms. With bilinear positions
/// and normals the integrands are of degree 2 in s and in t, so that Gauss's rule of 2 x 2 points
/// is exact: it is the closed form of Appendices B and C, without their 64 coefficients.
Measures integrate(const Bilinear& x, const Bilinear& u) {
  const double node = 0.5 / std::sqrt(3.0);
  Measures sum;
  for (const double s : {0.5 - node, 0.5 + node}) {
    for (const double t : {0.5 - node, 0.5 + node}) {
      // A triangle is half of the square its edges span: four weights of 1/4 times 2.
      Measures m = triangle_density(x.along_s(t), x.along_t(s), u.along_s(t), u.along_t(s), u.at(s, t));
      sum.mu0 += 0.5 * m.mu0;
      sum.mu1 += 0.5 * m.mu1;
      sum.mu2 += 0.5 * m.mu2;
      sum.mu_xy += 0.5 * m.mu_xy;
    }
  }
  return sum;
}

double split_area(const std::array<Vec3, 4>& x) {
  const std::array<Vec3, 4> ring = {x[0], x[1], x[3], x[2]};
  const Vec3 b = polygon_barycentre(ring.data(), ring.size());
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) area += 0.5 * (ring[i] - b).cross(ring[(i + 1) % 4] - b).norm();
  return area;
}

}  // namespace

Measures bilinear_measures(const std::array<Vec3, 4>& x, const std::array<Vec3, 4>& u) {
  Measures m = integrate({x}, {u});
  m.area = split_area(x);
  return m;
}

Measures surfel_measures(const Vec3& axis_x, const Vec3& axis_y, double h, const std::array<Vec3, 4>& u) {
  const Vec3 e1 = h * axis_x, e2 = h * axis_y;
  const std::array<Vec3, 4> x = {Vec3::Zero(), e1, e2, e1 + e2};
  Measures m = integrate({x}, {u});
  m.area = h * h;
  return m;
}

}  // namespace kappa
