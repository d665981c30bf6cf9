// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/pcl/greedy.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

#include "kappa/core/error.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/surface/surface.hpp"

namespace kappa::test {
namespace {

/// Points on the unit sphere, evenly spread (golden spiral), with its normals.
std::vector<Vec3> spiral(int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, turn = i * kPi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    points.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return points;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto c = mesh.faces[f];
    const Vec3& a = mesh.vertices[c[0]];
    area += 0.5 * (mesh.vertices[c[1]] - a).cross(mesh.vertices[c[2]] - a).norm();
  }
  return area;
}

TEST(Greedy, CoversASphereOutwards) {
  const std::vector<Vec3> points = spiral(2000);
  const CloudSurface s = greedy_surface(Vec3(5e5, 0, 0), points, points);
  EXPECT_EQ(s.mesh.origin, Vec3(5e5, 0, 0));
  EXPECT_EQ(s.mesh.vertices, points);
  EXPECT_NEAR(area_of(s.mesh), 4 * kPi, 0.02 * 4 * kPi);
  EXPECT_EQ(s.invalid_points + s.duplicate_points + s.starless_points, 0U);
  for (std::size_t f = 0; f < s.mesh.faces.size(); ++f) {
    const auto c = s.mesh.faces[f];
    const Vec3& a = points[c[0]];
    EXPECT_GT((points[c[1]] - a).cross(points[c[2]] - a).dot(a), 0) << f;
  }
}

TEST(Greedy, CountsPointsThatAreNoPartOfIt) {
  std::vector<Vec3> points = spiral(500), normals = points;
  points.push_back(points[7]);
  normals.push_back(normals[7]);
  points.emplace_back(kNaN, 0, 0);
  normals.emplace_back(0, 0, 1);
  points.push_back(Vec3(0, 0, 1.5));
  normals.push_back(Vec3::Zero());
  points.emplace_back(9, 9, 9);  // far from all
  normals.emplace_back(0, 0, 1);
  const CloudSurface s = greedy_surface(Vec3::Zero(), points, normals);
  EXPECT_EQ(s.duplicate_points, 1U);
  EXPECT_EQ(s.invalid_points, 2U);
  EXPECT_EQ(s.starless_points, 1U);
  EXPECT_EQ(s.representative[500], 7U);
}

TEST(Greedy, RefusesWhatCannotBe) {
  const std::vector<Vec3> points = spiral(50);
  EXPECT_THROW(greedy_surface(Vec3::Zero(), points, Normals(3)), Error);
  EXPECT_THROW(greedy_surface(Vec3::Zero(), points, Normals(50, Vec3::Zero())), Error);
  EXPECT_THROW(greedy_surface(Vec3::Zero(), points, points, {-1}), Error);
  EXPECT_THROW(greedy_surface(Vec3::Zero(), points, points, {0, 0}), Error);
  EXPECT_THROW(greedy_surface(Vec3::Zero(), points, points, {0, 2.5, 2}), Error);
  Scan scan;
  scan.points = points;
  SurfaceOptions options;
  options.surface = SurfaceKind::Greedy;
  EXPECT_THROW(make_surface(scan, options), Error);
  options.greedy = [](const Vec3& o, const std::vector<Vec3>& x, const Normals& u) { return greedy_surface(o, x, u); };
  EXPECT_EQ(make_surface(scan, options).kind, SurfaceKind::Greedy);
}

}  // namespace
}  // namespace kappa::test
