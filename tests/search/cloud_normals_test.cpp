// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/cloud_normals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>

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

TEST(PcaNormals, AreThoseOfAPlaneAnywhere) {
  const Vec3 normal = Vec3(1, -2, 3).normalized();
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(500, -300, 800)}) {
    const std::vector<Vec3> points = tilted_plane(300, normal, offset);
    for (const Vec3& u : pca_normals(points, {12})) EXPECT_NEAR(std::abs(u.dot(normal)), 1.0, 1e-12);
  }
}

TEST(PcaNormals, CountDuplicatesOnce) {
  std::vector<Vec3> points;
  for (int i = 0; i < 25; ++i) points.emplace_back(i % 5, i / 5, 0.1 * (i % 3));
  const Normals alone = pca_normals(points, {9});
  std::vector<Vec3> twice = points;
  for (int copy = 0; copy < 12; ++copy) twice.insert(twice.end(), points.begin(), points.end());
  const Normals doubled = pca_normals(twice, {9});
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(doubled[i], alone[i]);
  for (std::size_t i = 0; i < twice.size(); ++i) EXPECT_EQ(doubled[i], doubled[i % points.size()]);
}

TEST(PcaNormals, AreZeroWhereThereIsNoPlane) {
  const std::vector<Vec3> line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {kNaN, 0, 0}};
  for (const Vec3& u : pca_normals(line, {4})) EXPECT_TRUE(u.isZero(0));
  for (const Vec3& u : pca_normals({{0, 0, 0}, {1, 0, 0}}, {4})) EXPECT_TRUE(u.isZero(0));
  EXPECT_THROW(pca_normals(line, {2}), Error);
}

TEST(PcaNormals, DoNotDependOnThreads) {
  const std::vector<Vec3> points = tilted_plane(2000, Vec3(0, 0.6, 0.8), Vec3::Zero());
  Execution one, three;
  three.threads = 3;
  EXPECT_EQ(pca_normals(points, {10}, one), pca_normals(points, {10}, three));
}

/// The plane of the points in a ball, from all of them.
Vec3 ball_normal(const std::vector<Vec3>& points, const Vec3& centre, double radius, std::size_t& count) {
  std::vector<Vec3> in;
  for (const Vec3& x : points) {
    if ((x - centre).squaredNorm() <= radius * radius) in.push_back(x);
  }
  count = in.size();
  Vec3 mean = Vec3::Zero();
  for (const Vec3& x : in) mean += x / static_cast<double>(in.size());
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& x : in) covariance += (x - mean) * (x - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Mat3>(covariance).eigenvectors().col(0);
}

TEST(PcaNormals, WithinARadiusAreThoseOfAllItsPoints) {
  std::mt19937_64 random(9);
  std::normal_distribution<double> place;
  std::vector<Vec3> points;
  for (int i = 0; i < 1500; ++i) {
    const double x = 20 * place(random), y = 20 * place(random);
    points.emplace_back(x - 300, y + 200, 0.02 * x * y + 0.1 * place(random));
  }
  const double radius = 6;
  const Normals wide = pca_normals(points, {24, radius}), near = pca_normals(points, {24});
  std::size_t many = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t count = 0;
    const Vec3 expected = ball_normal(points, points[i], radius, count);
    many += count >= 24;
    EXPECT_NEAR(std::abs(wide[i].dot(count >= 24 ? expected : near[i])), 1, 1e-12) << i;
  }
  EXPECT_GT(many, 200u);
  EXPECT_LT(many, points.size() - 200);
  Execution three;
  three.threads = 3;
  EXPECT_EQ(pca_normals(points, {24, radius}, three), wide);
  EXPECT_THROW(pca_normals(points, {24, -1}), Error);
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
