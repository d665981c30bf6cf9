// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/surface/delaunay.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "clouds.hpp"
#include "kappa/shapes/random.hpp"

namespace kappa {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

DelaunayOptions whole_hull() {
  DelaunayOptions options;
  options.max_edge = kInfinity;
  return options;
}

std::vector<Vec3> random_terrain(std::size_t count, std::uint64_t seed, double size) {
  Random random(seed);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(0, size), y = random.uniform(0, size);
    points.emplace_back(x, y, 0.1 * size * std::sin(5 * x / size) + random.uniform(0, 0.02 * size));
  }
  return points;
}

std::vector<Vec3> square_grid(int n) {
  std::vector<Vec3> points;
  for (int i = 0; i < n * n; ++i) points.emplace_back(i % n, i / n, 0);
  return points;
}

double plan_area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) sum += 0.5 * clouds::area_vector(mesh, f).z();
  return sum;
}

/// Corners of the convex hull in plan, counter-clockwise (Andrew's chain).
std::vector<Vec3> hull(std::vector<Vec3> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec3& a, const Vec3& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Vec3> chain;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = chain.size();
    for (const Vec3& p : points) {
      while (chain.size() >= start + 2 &&
             (chain.back() - chain[chain.size() - 2]).cross(p - chain[chain.size() - 2]).z() <= 0)
        chain.pop_back();
      chain.push_back(p);
    }
    chain.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return chain;
}

TEST(DelaunaySurface, NoPointLiesInACircumcircle) {
  const std::vector<Vec3> points = random_terrain(400, 1, 100);
  const PlanSurface s = delaunay_surface(Vec3::Zero(), points, whole_hull());
  const Mesh& mesh = s.surface.mesh;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    EXPECT_GT(clouds::area_vector(mesh, f).z(), 0) << "faces look up";
    for (const Vec3& p : points) {
      Mat3 m;
      for (int i = 0; i < 3; ++i) {
        const Vec3 d = (points[face[static_cast<std::size_t>(i)]] - p) / 100;
        m.col(i) = Vec3(d.x(), d.y(), d.head<2>().squaredNorm());
      }
      EXPECT_LE(m.determinant(), 1e-8) << "a point lies in the circumcircle of face " << f;
    }
  }
}

TEST(DelaunaySurface, FillsTheConvexHull) {
  for (const std::uint64_t seed : {2u, 3u, 4u}) {
    const std::vector<Vec3> points = random_terrain(2000, seed, 100);
    const PlanSurface s = delaunay_surface(Vec3::Zero(), points, whole_hull());
    const std::vector<Vec3> corners = hull(points);
    double area = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      area += 0.5 * corners[i].cross(corners[(i + 1) % corners.size()]).z();
    EXPECT_NEAR(plan_area(s.surface.mesh), area, 1e-6 * area);
    EXPECT_EQ(s.surface.mesh.faces.size(), 2 * points.size() - 2 - corners.size()) << "Euler's formula";
    EXPECT_EQ(s.surface.starless_points + s.surface.duplicate_points + s.cut_faces, 0u);
  }
}

/// All corners of each cell lie on a circle.
TEST(DelaunaySurface, CoversEveryCellOfAGridOnce) {
  const PlanSurface s = delaunay_surface(Vec3::Zero(), square_grid(30), {});
  EXPECT_EQ(s.surface.mesh.faces.size(), 2u * 29 * 29);
  EXPECT_DOUBLE_EQ(plan_area(s.surface.mesh), 29 * 29);
  EXPECT_DOUBLE_EQ(s.spacing, 1);
  for (std::size_t f = 0; f < s.surface.mesh.faces.size(); ++f)
    EXPECT_DOUBLE_EQ(clouds::area_vector(s.surface.mesh, f).z(), 1);
}

TEST(DelaunaySurface, PointsOnACircleMakeAFan) {
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i) points.emplace_back(5 * std::cos(i * kPi / 6), 5 * std::sin(i * kPi / 6), 0);
  const PlanSurface s = delaunay_surface(Vec3::Zero(), points, whole_hull());
  EXPECT_EQ(s.surface.mesh.faces.size(), 10u);
  EXPECT_NEAR(plan_area(s.surface.mesh), 12 * 0.5 * 25 * std::sin(kPi / 6), 1e-9);
}

TEST(DelaunaySurface, ACellIsSplitAlongTheShorterDiagonalInSpace) {
  for (const Index raised : {0u, 1u}) {
    std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    points[raised].z() = 5;
    const Mesh mesh = delaunay_surface(Vec3::Zero(), points, {}).surface.mesh;
    ASSERT_EQ(mesh.faces.size(), 2u);
    const Index a = raised + 1, b = (raised + 3) % 4;
    for (std::size_t f = 0; f < 2; ++f) {
      const auto face = mesh.faces[f];
      const std::set<Index> corners(face.begin(), face.end());
      EXPECT_EQ(corners.count(a) + corners.count(b), 2u);
    }
  }
}

TEST(DelaunaySurface, OneHeightAtEachPlace) {
  std::vector<Vec3> points = square_grid(5);
  points.emplace_back(2, 2, 7);
  points.emplace_back(2, 2, -7);
  points.emplace_back(2, 2, 7);
  DelaunayOptions options;
  const CloudSurface top = delaunay_surface(Vec3::Zero(), points, options).surface;
  EXPECT_EQ(top.duplicate_points, 3u);
  EXPECT_EQ(top.starless_points, 0u);
  for (const Index i : {12u, 25u, 26u, 27u}) EXPECT_EQ(top.representative[i], 25u);
  EXPECT_EQ(top.representative[3], 3u);
  options.duplicates = PlanDuplicates::Lowest;
  const CloudSurface bottom = delaunay_surface(Vec3::Zero(), points, options).surface;
  for (const Index i : {12u, 25u, 26u, 27u}) EXPECT_EQ(bottom.representative[i], 26u);
  const auto& corners = bottom.mesh.faces.corners();
  EXPECT_GE(std::count(corners.begin(), corners.end(), 26u), 4);
  EXPECT_EQ(std::count(corners.begin(), corners.end(), 12u), 0);
}

TEST(DelaunaySurface, DoesNotReachAcrossAGap) {
  std::vector<Vec3> points = random_terrain(1000, 6, 10);
  for (Vec3& p : points) {
    if (p.x() > 5) p.x() += 20;
  }
  const PlanSurface s = delaunay_surface(Vec3::Zero(), points, {});
  EXPECT_GT(s.cut_faces, 20u);
  for (std::size_t f = 0; f < s.surface.mesh.faces.size(); ++f) {
    const auto face = s.surface.mesh.faces[f];
    EXPECT_EQ(points[face[0]].x() > 15, points[face[1]].x() > 15);
    EXPECT_EQ(points[face[0]].x() > 15, points[face[2]].x() > 15);
  }
  EXPECT_NEAR(plan_area(s.surface.mesh), 100, 5);
}

/// Heights do not count: a cliff is no gap.
TEST(DelaunaySurface, KeepsACliff) {
  std::vector<Vec3> points = square_grid(10);
  for (Vec3& p : points) p.z() = p.x() > 4.5 ? 100 : 0;
  EXPECT_EQ(delaunay_surface(Vec3::Zero(), points, {}).surface.mesh.faces.size(), 2u * 81);
}

TEST(DelaunaySurface, DegenerateCloudsHaveNoFace) {
  std::vector<Vec3> line;
  for (int i = 0; i < 50; ++i) line.emplace_back(0.1 * i, 0.3 * i, i % 7);
  const std::vector<std::vector<Vec3>> clouds = {
      {}, {{1, 2, 3}}, {{1, 2, 3}, {4, 5, 6}}, line, {{1, 1, 1}, {1, 1, 2}, {1, 1, 3}}};
  for (const std::vector<Vec3>& points : clouds) {
    const CloudSurface s = delaunay_surface(Vec3::Zero(), points, {}).surface;
    EXPECT_EQ(s.mesh.faces.size(), 0u);
    EXPECT_EQ(s.starless_points + s.duplicate_points, points.size());
  }
  std::vector<Vec3> dirty = square_grid(4);
  dirty.push_back(Vec3(1.5, kNaN, 0));
  dirty.push_back(Vec3(0.5, 0.5, kInfinity));
  const CloudSurface s = delaunay_surface(Vec3::Zero(), dirty, {}).surface;
  EXPECT_EQ(s.mesh.faces.size(), 18u);
  EXPECT_EQ(s.invalid_points, 2u);
  EXPECT_EQ(s.representative[16], kNoIndex);
}

TEST(DelaunaySurface, ScaleDoesNotMatter) {
  const std::vector<Vec3> points = random_terrain(500, 8, 1);
  const Mesh unit = delaunay_surface(Vec3::Zero(), points, {}).surface.mesh;
  for (const double scale : {0x1p-30, 0x1p30}) {
    std::vector<Vec3> scaled = points;
    for (Vec3& p : scaled) p *= scale;
    EXPECT_TRUE(clouds::same_faces(unit, delaunay_surface(Vec3::Zero(), scaled, {}).surface.mesh));
  }
}

TEST(DelaunaySurface, RefusesByName) {
  DelaunayOptions options;
  options.max_edge = 0;
  const auto refusal = clouds::refusal([&] { delaunay_surface(Vec3::Zero(), square_grid(3), options); });
  EXPECT_EQ(refusal.code, ErrorCode::InvalidArgument);
  EXPECT_NE(refusal.message.find("max_edge = 0"), std::string::npos);
}

}  // namespace
}  // namespace kappa
