// SPDX-License-Identifier: BSD-3-Clause
// Theorem 1 of the SGP 2020 paper: for a connected union B of N triangles of a closed mesh M near a closed surface S,
//   |mu(B) - mu_S(pi(B))| <= 16 max(1, kmax^2) (1 + L^4) [ (eta + eps) (Area(B) + Length(dB)) + delta^4 N ],
// with eta the error of the normals, eps the Hausdorff distance of M and S, delta the longest edge of M and L the
// Lipschitz constant of u. The bound falls with the square of the edges: at the sizes below it is well under the
// measures themselves, so that a wrong factor in a measure breaks it.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "kappa/balls/ball_sum.hpp"
#include "support/oracles.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;

struct Totals {
  double mu0 = 0, mu1 = 0, mu2 = 0;
};

/// A closed surface: its normal at the projection of a point, the distance to it, and the curvature measures of the
/// projection of a small triangle.
struct Surface {
  double k_max = 0;
  std::function<Vec3(const Vec3&)> normal;
  std::function<double(const Vec3&)> distance;
  std::function<Totals(const std::array<Vec3, 3>&)> projected;
};

/// The projection of a triangle on a sphere is a spherical triangle.
Surface sphere_surface(double R) {
  Surface s;
  s.k_max = 1 / R;
  s.normal = [](const Vec3& p) { return Vec3(p.normalized()); };
  s.distance = [R](const Vec3& p) { return std::abs(p.norm() - R); };
  s.projected = [R](const std::array<Vec3, 3>& x) {
    const Vec3 a = x[0].normalized(), b = x[1].normalized(), c = x[2].normalized();
    const double angle = 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
    return Totals{R * R * angle, 2 * R * angle, angle};
  };
  return s;
}

/// Pull-back of the area form of the torus by the projection, by Gauss quadrature over the flat triangle: with the
/// angles a around the axis and b around the tube, dA = (R + r cos b) r da db.
Totals torus_projected(double R, double r, const std::array<Vec3, 3>& x) {
  static const oracle::GaussRule rule = oracle::gauss_rule(6);
  Totals sum;
  const Vec3 e1 = x[1] - x[0], e2 = x[2] - x[0];
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    for (std::size_t j = 0; j < rule.node.size(); ++j) {
      const double s = static_cast<double>(rule.node[i]), t = static_cast<double>(rule.node[j]) * (1 - s);
      const double w = static_cast<double>(rule.weight[i] * rule.weight[j]) * (1 - s);
      const Vec3 p = x[0] + s * e1 + t * e2;
      const double rho = std::hypot(p.x(), p.y()), m = rho - R, q = m * m + p.z() * p.z();
      const Vec3 grad_a = Vec3(-p.y(), p.x(), 0) / (rho * rho);
      const Vec3 grad_rho = Vec3(p.x(), p.y(), 0) / rho;
      const Vec3 grad_b = (m * Vec3::UnitZ() - p.z() * grad_rho) / q;
      const double form = w * (grad_a.dot(e1) * grad_b.dot(e2) - grad_a.dot(e2) * grad_b.dot(e1));
      const double cos_b = m / std::sqrt(q);
      sum.mu0 += form * (R + r * cos_b) * r;
      sum.mu1 += form * (R + 2 * r * cos_b);
      sum.mu2 += form * cos_b;
    }
  }
  return sum;
}

Surface torus_surface(double R, double r) {
  Surface s;
  s.k_max = std::max(1 / r, 1 / (R - r));
  const auto from_core = [R](const Vec3& p) {
    const double rho = std::hypot(p.x(), p.y());
    return Vec3(p - R * Vec3(p.x(), p.y(), 0) / rho);
  };
  s.normal = [from_core](const Vec3& p) { return Vec3(from_core(p).normalized()); };
  s.distance = [from_core, r](const Vec3& p) { return std::abs(from_core(p).norm() - r); };
  s.projected = [R, r](const std::array<Vec3, 3>& x) { return torus_projected(R, r, x); };
  return s;
}

/// What the theorem asks of a mesh with its normals, sampled at 28 points a triangle.
struct Quality {
  double eta = 0, eps = 0, delta = 0, lipschitz = 0;
};

std::array<Vec3, 3> corners(const std::vector<Vec3>& v, const Faces::View& f) {
  return {v[f[0]], v[f[1]], v[f[2]]};
}

void add_quality(const Surface& s, const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u, Quality& q) {
  constexpr int kSteps = 6;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const double a = static_cast<double>(i) / kSteps, b = static_cast<double>(j) / kSteps;
      const Vec3 p = x[0] + a * (x[1] - x[0]) + b * (x[2] - x[0]);
      q.eta = std::max(q.eta, (u[0] + a * (u[1] - u[0]) + b * (u[2] - u[0]) - s.normal(p)).norm());
      q.eps = std::max(q.eps, s.distance(p));
    }
  }
  for (int i = 0; i < 3; ++i) q.delta = std::max(q.delta, (x[(i + 1) % 3] - x[i]).norm());
  Eigen::Matrix<double, 3, 2> e, d;
  e << x[1] - x[0], x[2] - x[0];
  d << u[1] - u[0], u[2] - u[0];
  const Eigen::Matrix<double, 2, 2> gram = e.transpose() * e;
  const Eigen::Matrix<double, 3, 3> linear = d * gram.inverse() * e.transpose();
  q.lipschitz = std::max(q.lipschitz, Eigen::JacobiSVD<Mat3>(linear).singularValues()[0]);
}

/// From the first `faces` faces, of which all others are copies by symmetry.
Quality quality_of(const Shape& s, const Surface& surface, std::size_t faces) {
  Quality q;
  for (std::size_t f = 0; f < faces; ++f) {
    add_quality(surface, corners(s.mesh.vertices, s.mesh.faces[f]), corners(s.normals, s.mesh.faces[f]), q);
  }
  return q;
}

/// A union of triangles: all whose corners are within `radius` of a point, with the length of its border.
struct Union {
  std::vector<std::size_t> faces;
  double area = 0, border = 0;
};

Union union_around(const Mesh& mesh, const Vec3& centre, double radius) {
  Union b;
  std::map<std::pair<Index, Index>, int> seen;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Faces::View v = mesh.faces[f];
    const std::array<Vec3, 3> x = corners(mesh.vertices, v);
    if (std::any_of(x.begin(), x.end(), [&](const Vec3& p) { return (p - centre).norm() > radius; })) continue;
    b.faces.push_back(f);
    b.area += (x[1] - x[0]).cross(x[2] - x[0]).norm() / 2;
    for (std::size_t c = 0; c < 3; ++c) ++seen[std::minmax(v[c], v[(c + 1) % 3])];
  }
  for (const auto& [edge, count] : seen) {
    if (count == 1) b.border += (mesh.vertices[edge.first] - mesh.vertices[edge.second]).norm();
  }
  return b;
}

void expect_bound(const Shape& s, const Surface& surface, std::size_t faces, const std::vector<double>& radii) {
  const Quality q = quality_of(s, surface, faces);
  const std::vector<MeasureSum> measures = measure_triangles(triangles_of(s.mesh, s.normals));
  double sharpest = 1e300;
  for (std::size_t v = 0; v < s.mesh.vertices.size(); v += s.mesh.vertices.size() / 7) {
    for (const double radius : radii) {
      const Union b = union_around(s.mesh, s.mesh.vertices[v], radius);
      Totals got, truth;
      for (const std::size_t f : b.faces) {
        const Totals part = surface.projected(corners(s.mesh.vertices, s.mesh.faces[f]));
        truth.mu0 += part.mu0;
        truth.mu1 += part.mu1;
        truth.mu2 += part.mu2;
        got.mu0 += measures[f].mu0;
        got.mu1 += measures[f].mu1();
        got.mu2 += measures[f].mu2;
      }
      const double bound =
          16 * std::max(1.0, surface.k_max * surface.k_max) * (1 + std::pow(q.lipschitz, 4)) *
          ((q.eta + q.eps) * (b.area + b.border) + std::pow(q.delta, 4) * static_cast<double>(b.faces.size()));
      EXPECT_LE(std::abs(got.mu0 - truth.mu0), bound) << "vertex " << v << " radius " << radius;
      EXPECT_LE(std::abs(got.mu1 - truth.mu1), bound) << "vertex " << v << " radius " << radius;
      EXPECT_LE(std::abs(got.mu2 - truth.mu2), bound) << "vertex " << v << " radius " << radius;
      sharpest = std::min(sharpest, bound / std::abs(truth.mu1));
    }
  }
  EXPECT_LT(sharpest, 0.5) << "the bound is too weak to fail: use a finer mesh";
}

TEST(Theorem1, Sphere) {
  const Shape s = shapes::sphere(1, 6);
  const std::size_t octant = s.mesh.faces.size() / 8;
  expect_bound(s, sphere_surface(1), octant, {0.4, 1.2, 3});
}

TEST(Theorem1, Torus) {
  const int rings = 270, slices = 540;
  expect_bound(shapes::torus(3, 1, slices, rings), torus_surface(3, 1), 2 * rings, {0.7, 2});
}

}  // namespace
}  // namespace kappa
