// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/search/cloud_normals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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
