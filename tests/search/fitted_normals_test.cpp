// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/fitted_normals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include "kappa/core/error.hpp"

namespace kappa {
namespace {

std::vector<Vec3> tilted_plane(std::size_t n, const Vec3& normal, const Vec3& offset) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p(uniform(random), uniform(random), uniform(random));
    points.push_back(p - normal * normal.dot(p) + offset);
  }
  return points;
}

TEST(FindDuplicates, NamesTheFirstPointOfEachPosition) {
  const std::vector<Vec3> points = {{1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {kNaN, 0, 0}, {0, 0, 0}, {-0.0, 0, 0}};
  EXPECT_EQ(find_duplicates(points), (std::vector<Index>{0, 1, 0, kNoIndex, 1, 1}));
}

TEST(FittedNormals, AreThoseOfAPlaneAnywhere) {
  const Vec3 normal = Vec3(1, -2, 3).normalized();
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(500, -300, 800)}) {
    const std::vector<Vec3> points = tilted_plane(300, normal, offset);
    for (const Vec3& u : fitted_normals(points, {12})) EXPECT_NEAR(std::abs(u.dot(normal)), 1.0, 1e-12);
  }
}

TEST(FittedNormals, CountDuplicatesOnce) {
  std::vector<Vec3> points;
  for (int i = 0; i < 25; ++i) points.emplace_back(i % 5, i / 5, 0.1 * (i % 3));
  const Normals alone = fitted_normals(points, {9});
  std::vector<Vec3> twice = points;
  for (int copy = 0; copy < 12; ++copy) twice.insert(twice.end(), points.begin(), points.end());
  const Normals doubled = fitted_normals(twice, {9});
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(doubled[i], alone[i]);
  for (std::size_t i = 0; i < twice.size(); ++i) EXPECT_EQ(doubled[i], doubled[i % points.size()]);
}

TEST(FittedNormals, AreZeroWhereThereIsNoPlane) {
  const std::vector<Vec3> line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {kNaN, 0, 0}};
  for (const Vec3& u : fitted_normals(line, {4})) EXPECT_TRUE(u.isZero(0));
  for (const Vec3& u : fitted_normals({{0, 0, 0}, {1, 0, 0}}, {4})) EXPECT_TRUE(u.isZero(0));
  EXPECT_THROW(fitted_normals(line, {2}), Error);
}

TEST(FittedNormals, DoNotDependOnThreads) {
  const std::vector<Vec3> points = tilted_plane(2000, Vec3(0, 0.6, 0.8), Vec3::Zero());
  Execution one, three;
  three.threads = 3;
  EXPECT_EQ(fitted_normals(points, {10}, one), fitted_normals(points, {10}, three));
}

/// The `count` points nearest to `centre`, from all of them, or those within `radius` if they are at least as many.
std::vector<Vec3> neighbourhood(std::vector<Vec3> points, const Vec3& centre, std::size_t count, double radius) {
  std::sort(points.begin(), points.end(),
            [&](const Vec3& a, const Vec3& b) { return (a - centre).squaredNorm() < (b - centre).squaredNorm(); });
  std::size_t in = 0;
  while (in < points.size() && (points[in] - centre).norm() <= radius) ++in;
  points.resize(std::max(count, in));
  return points;
}

/// The same where it grows, up to twice as wide, for points to one side of its centre.
std::vector<Vec3> grown_neighbourhood(const std::vector<Vec3>& points, const Vec3& centre, std::size_t count,
                                      double radius) {
  const std::vector<Vec3> near = neighbourhood(points, centre, count, radius);
  const double farthest = (near.back() - centre).norm();
  const bool ball = farthest <= radius;
  Vec3 offset = -centre;
  for (const Vec3& x : near) offset += x / static_cast<double>(near.size());
  const double share = offset.norm() / (ball ? radius : farthest);  // 0.4244132 for half a disc
  const double even = std::max(0.1, 1 / std::sqrt(static_cast<double>(near.size())));
  const double growth = std::min(2.0, std::max(1.0, 1 + (share - even) / (0.4244131815783876 - even)));
  if (ball) return neighbourhood(points, centre, count, radius * growth);
  return neighbourhood(points, centre, static_cast<std::size_t>(growth * growth * static_cast<double>(count)), 0);
}

Vec3 plane_of(const std::vector<Vec3>& points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& x : points) mean += x / static_cast<double>(points.size());
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& x : points) covariance += (x - mean) * (x - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Mat3>(covariance).eigenvectors().col(0);
}

struct Quadric {
  Vec3 normal;
  double variance;  ///< of the residuals
};

/// Normal at `centre` of the quadric of least squares over the plane of normal w, by orthogonal transformations.
Quadric quadric_of(const std::vector<Vec3>& points, const Vec3& centre, const Vec3& w) {
  const Vec3 u = w.cross(Vec3(0.3, 0.5, 0.8)).normalized(), v = w.cross(u);
  Eigen::MatrixXd a(points.size(), 6);
  Eigen::VectorXd height(points.size());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const Vec3 d = points[static_cast<std::size_t>(i)] - centre;
    const double x = d.dot(u), y = d.dot(v);
    a.row(i) << 1, x, y, x * x, x * y, y * y;
    height[i] = d.dot(w);
  }
  const Eigen::VectorXd c = a.colPivHouseholderQr().solve(height);
  return {(w - c[1] * u - c[2] * v).normalized(),
          (height - a * c).squaredNorm() / static_cast<double>(points.size() - 6)};
}

/// Dense in the middle and thin outside: some balls hold enough points, others do not.
std::vector<Vec3> noisy_saddle() {
  std::mt19937_64 random(9);
  std::normal_distribution<double> place;
  std::vector<Vec3> points;
  for (int i = 0; i < 1500; ++i) {
    const double x = 20 * place(random), y = 20 * place(random);
    points.emplace_back(x - 300, y + 200, 0.02 * x * y + 0.1 * place(random));
  }
  return points;
}

TEST(FittedNormals, AreThoseOfLeastSquaresOverAllNeighbours) {
  const std::vector<Vec3> points = noisy_saddle();
  for (const double radius : {0.0, 6.0}) {
    const Normals planes = fitted_normals(points, {24, radius, NormalFit::Plane});
    const Normals quadrics = fitted_normals(points, {24, radius, NormalFit::Quadric});
    std::size_t many = 0, alike = 0, different = 0;
    for (std::size_t i = 0; i < points.size(); i += 3) {
      const std::vector<Vec3> near = neighbourhood(points, points[i], 24, radius);
      many += near.size() > 24;
      const Vec3 plane = plane_of(near);
      const Quadric small = quadric_of(near, points[i], plane);
      const Quadric grown = quadric_of(grown_neighbourhood(points, points[i], 24, radius), points[i], plane);
      const Vec3 quadric = (grown.variance <= 1.5 * small.variance ? grown : small).normal;
      alike += grown.variance > small.variance && grown.variance <= 1.5 * small.variance;
      different += grown.variance > 1.5 * small.variance;
      EXPECT_NEAR(std::abs(planes[i].dot(plane)), 1, 1e-12) << i;
      EXPECT_NEAR(std::abs(quadrics[i].dot(quadric)), 1, 1e-12) << i;
    }
    EXPECT_GT(alike, 10u);
    EXPECT_GT(different, 5u);
    EXPECT_EQ(many > 100, radius > 0);
    EXPECT_LT(many, 400u);
    Execution three;
    three.threads = 3;
    EXPECT_EQ(fitted_normals(points, {24, radius}, three), quadrics);
  }
  EXPECT_THROW(fitted_normals(points, {24, -1}), Error);
}

/// Largest error of the normals on the border of a cap of the unit sphere, cut by x >= 0, fitted within `radius`.
double error_on_border(double radius, NormalFit fit) {
  std::vector<Vec3> points;
  const double step = radius / 6;
  for (int i = 0; i <= 20; ++i) {
    for (int j = -20; j <= 20; ++j) points.push_back(Vec3(i * step, j * step, 1).normalized());
  }
  const Normals normals = fitted_normals(points, {24, radius, fit});
  double error = 0;
  for (std::size_t i = 10; i <= 30; ++i) error = std::max(error, std::sqrt(1 - std::pow(normals[i].dot(points[i]), 2)));
  return error;
}

TEST(FittedNormals, OfQuadricsConvergeFasterThanOfPlanesOnABorder) {
  const double plane = error_on_border(0.1, NormalFit::Plane), half_plane = error_on_border(0.05, NormalFit::Plane);
  const double quadric = error_on_border(0.1, NormalFit::Quadric);
  const double half_quadric = error_on_border(0.05, NormalFit::Quadric);
  EXPECT_NEAR(std::log2(plane / half_plane), 1, 0.1);
  EXPECT_GT(std::log2(quadric / half_quadric), 1.9);
  EXPECT_LT(quadric, plane / 20);
}

TEST(FittedNormals, AreThoseOfPlanesWhereQuadricsAreNotFixed) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec3> strip, few;
  for (int i = 0; i < 40; ++i) strip.emplace_back(0.1 * i, i % 2 * 0.01, 0.001 * uniform(random));
  for (int i = 0; i < 11; ++i) few.emplace_back(uniform(random), uniform(random), 0.1 * uniform(random));
  for (const auto& points : {strip, few}) {
    EXPECT_EQ(fitted_normals(points, {24, 0, NormalFit::Quadric}), fitted_normals(points, {24, 0, NormalFit::Plane}));
  }
}

/// Two planes that meet at a right angle on the y axis, with noise across them, and some points 0.3 to 2 above them.
struct Roof {
  std::vector<Vec3> points;
  Normals truth;
};

Roof noisy_roof(double noise, double outliers) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> place(-20, 20), unit(0, 1);
  std::normal_distribution<double> deviate(0, noise);
  Roof roof;
  for (int i = 0; i < 4000; ++i) {
    const double along = place(random), down = place(random);
    const Vec3 side(down < 0 ? -1 : 1, 0, 1), slope(std::copysign(1.0, down), 0, -1);
    const double off = unit(random) < outliers ? 0.3 + 1.7 * unit(random) : deviate(random);
    roof.truth.push_back(side.normalized());
    roof.points.push_back(Vec3(0, along, 0) + std::abs(down) * slope.normalized() + off * roof.truth.back());
  }
  return roof;
}

/// Share of the points between `from` and `to` from the ridge whose normals are within 5 degrees of the truth.
double share_right(const Roof& roof, const Normals& normals, double from, double to) {
  double all = 0, right = 0;
  for (std::size_t i = 0; i < roof.truth.size(); ++i) {
    const double distance = std::abs(roof.points[i].x()) * std::sqrt(2.0);
    if (distance < from || distance > to || std::abs(roof.points[i].y()) > 18) continue;
    ++all;
    right += std::abs(normals[i].dot(roof.truth[i])) > std::cos(5 * kPi / 180);
  }
  return right / all;
}

TEST(FittedNormals, RobustOnesResistAnEdge) {
  const Roof roof = noisy_roof(0.02, 0);
  const Normals robust = fitted_normals(roof.points, {24, 0, NormalFit::Robust});
  const Normals planes = fitted_normals(roof.points, {24, 0, NormalFit::Plane});
  const Normals quadrics = fitted_normals(roof.points, {24, 0, NormalFit::Quadric});
  // The points are 0.63 apart, 24 of them reach 1.75 far.
  EXPECT_GT(share_right(roof, robust, 0.1, 1.5), 0.97);
  EXPECT_LT(share_right(roof, planes, 0.1, 1.5), 0.5);
  EXPECT_LT(share_right(roof, quadrics, 0.1, 1.5), 0.5);
  EXPECT_GT(share_right(roof, robust, 3, 18), 0.999);
}

TEST(FittedNormals, RobustOnesResistOutliers) {
  const Roof roof = noisy_roof(0.02, 0.1);
  const Normals robust = fitted_normals(roof.points, {24, 0, NormalFit::Robust});
  const Normals planes = fitted_normals(roof.points, {24, 0, NormalFit::Plane});
  const double wrong = 1 - share_right(roof, robust, 0.1, 18), of_planes = 1 - share_right(roof, planes, 0.1, 18);
  EXPECT_LT(wrong, 0.03);
  EXPECT_LT(wrong, 0.1 * of_planes);
  Execution three;
  three.threads = 3;
  EXPECT_EQ(fitted_normals(roof.points, {24, 0, NormalFit::Robust}, three), robust);
}

TEST(FittedNormals, RobustOnesOfASmoothSurfaceAreThoseOfQuadrics) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> deviate;
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i) points.push_back(Vec3(deviate(random), deviate(random), deviate(random)).normalized());
  const Normals robust = fitted_normals(points, {24, 0, NormalFit::Robust});
  const Normals planes = fitted_normals(points, {24, 0, NormalFit::Plane});
  const double quadric_error = 2e-3, plane_error = 1e-2;  // 24 neighbours reach 0.18 far
  std::size_t as_quadrics = 0, as_planes = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    as_quadrics += points[i].cross(robust[i]).norm() < quadric_error;
    as_planes += points[i].cross(planes[i]).norm() > plane_error;
  }
  EXPECT_GT(as_quadrics, 0.99 * points.size());
  EXPECT_GT(as_planes, 0.5 * points.size());
}

TEST(Orientation, TurnsNormalsToTheSideAsked) {
  const std::vector<Vec3> points = {{0, 0, 0}, {0, 0, 0}, {5, 0, 0}};
  Normals normals = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}};
  orient_towards(points, {1, 0, 3}, normals);
  EXPECT_EQ(normals, (Normals{{0, 0, 1}, {0, 0, 1}, {-1, 0, 0}}));
  orient_along({1, 0, -1}, normals);
  EXPECT_EQ(normals, (Normals{{0, 0, -1}, {0, 0, -1}, {1, 0, 0}}));
}

}  // namespace
}  // namespace kappa
