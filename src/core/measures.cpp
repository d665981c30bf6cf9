// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/core/measures.hpp"

#include <Eigen/Geometry>

namespace kappa {

Measures& Measures::operator+=(const Measures& other) {
  area += other.area;
  mu0 += other.mu0;
  mu1 += other.mu1;
  mu2 += other.mu2;
  mu_xy += other.mu_xy;
  return *this;
}

Mat3 MeasureSum::tensor() const {
  Mat3 t;
  t << mu_sym[0], mu_sym[3], mu_sym[4],  //
      mu_sym[3], mu_sym[1], mu_sym[5],   //
      mu_sym[4], mu_sym[5], mu_sym[2];
  return t;
}

MeasureSum& MeasureSum::operator+=(const MeasureSum& other) {
  area += other.area;
  mu0 += other.mu0;
  mu2 += other.mu2;
  for (std::size_t i = 0; i < mu_sym.size(); ++i) mu_sym[i] += other.mu_sym[i];
  return *this;
}

MeasureSum& MeasureSum::operator*=(double factor) {
  area *= factor;
  mu0 *= factor;
  mu2 *= factor;
  for (double& value : mu_sym) value *= factor;
  return *this;
}

MeasureSum compact(const Measures& m) {
  const Mat3& t = m.mu_xy;
  return {m.area,
          m.mu0,
          m.mu2,
          {t(0, 0), t(1, 1), t(2, 2), 0.5 * (t(0, 1) + t(1, 0)), 0.5 * (t(0, 2) + t(2, 0)), 0.5 * (t(1, 2) + t(2, 1))}};
}

Measures triangle_density(const Vec3& e1, const Vec3& e2, const Vec3& d1, const Vec3& d2, const Vec3& u) {
  const Vec3 normal = e1.cross(e2);
  Measures m;
  m.area = 0.5 * normal.norm();
  m.mu0 = 0.5 * u.dot(normal);
  m.mu1 = 0.5 * u.dot(e1.cross(d2) + d1.cross(e2));
  m.mu2 = 0.5 * u.dot(d1.cross(d2));
  m.mu_xy = 0.5 * (e1.cross(u) * d2.transpose() - e2.cross(u) * d1.transpose());
  return m;
}

MeasureSum triangle_density_sum(const Vec3& e1, const Vec3& e2, const Vec3& d1, const Vec3& d2, const Vec3& u) {
  const Vec3 normal = e1.cross(e2);
  const Vec3 p = 0.5 * e1.cross(u), q = 0.5 * e2.cross(u);
  MeasureSum m;
  m.area = 0.5 * normal.norm();
  m.mu0 = 0.5 * u.dot(normal);
  m.mu2 = 0.5 * u.dot(d1.cross(d2));
  const auto entry = [&](int row, int column) { return p[row] * d2[column] - q[row] * d1[column]; };
  for (int i = 0; i < 3; ++i) m.mu_sym[static_cast<std::size_t>(i)] = entry(i, i);
  m.mu_sym[3] = 0.5 * (entry(0, 1) + entry(1, 0));
  m.mu_sym[4] = 0.5 * (entry(0, 2) + entry(2, 0));
  m.mu_sym[5] = 0.5 * (entry(1, 2) + entry(2, 1));
  return m;
}

Measures triangle_measures(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u) {
  const Vec3 u_bar = (u[0] + u[1] + u[2]) / 3.0;
  return triangle_density(x[1] - x[0], x[2] - x[0], u[1] - u[0], u[2] - u[0], u_bar);
}

Vec3 polygon_barycentre(const Vec3* x, std::size_t n) {
  // Relative to the first vertex, so that no accuracy is lost far from the origin.
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i < n; ++i) sum += x[i] - x[0];
  return x[0] + sum / static_cast<double>(n);
}

Vec3 barycentre_normal(const Vec3* u, std::size_t n) {
  constexpr double kShortestMean = 1e-12;
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i) mean += u[i];
  mean /= static_cast<double>(n);
  const double length = mean.norm();
  return length < kShortestMean ? Vec3(Vec3::Zero()) : Vec3(mean / length);
}

Measures polygon_measures(const Vec3* x, const Vec3* u, std::size_t n) {
  if (n == 3) return triangle_measures({x[0], x[1], x[2]}, {u[0], u[1], u[2]});
  const Vec3 b = polygon_barycentre(x, n), u_b = barycentre_normal(u, n);
  Measures sum;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    sum += triangle_measures({x[i], x[next], b}, {u[i], u[next], u_b});
  }
  return sum;
}

}  // namespace kappa
