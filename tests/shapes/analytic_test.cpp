// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/shapes/analytic.hpp"
#include "kappa/scan/scan.hpp"

#include <algorithm>
#include <cmath>

#include "checks.hpp"

namespace kappa {
namespace {

using test::expect_complete;
using test::expect_faces_follow_normals;
using test::expect_truth;
using test::mesh_facts;
using test::MeshFacts;
using test::normal_field;
using test::values;

constexpr double kTolerance = 1e-9;  // of the differences, far above that of the shapes

test::NormalField sphere_normals() {
  return normal_field([](const Vec3& x) { return x; });
}

test::NormalField torus_normals(double major_radius) {
  return normal_field([major_radius](const Vec3& x) {
    const Vec3 flat(x.x(), x.y(), 0);
    return Vec3(x - major_radius * flat.normalized());
  });
}

test::NormalField cylinder_normals() {
  return normal_field([](const Vec3& x) { return Vec3(x.x(), x.y(), 0); });
}

test::NormalField quadric_normals(double a, double b) {
  return normal_field([a, b](const Vec3& x) { return Vec3(-a * x.x(), -b * x.y(), 1); });
}

void expect_closed(const Scan& scan, long euler) {
  const MeshFacts facts = mesh_facts(scan);
  EXPECT_EQ(facts.border_edges, 0U);
  EXPECT_EQ(facts.repeated_edges, 0U);
  EXPECT_EQ(facts.euler, euler);
  EXPECT_LT(facts.area_vector.norm(), 1e-12 * facts.area);
  EXPECT_GT(facts.volume, 0);
}

class EveryGrid : public testing::TestWithParam<GridFaces> {};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryGrid,
                         testing::Values(GridFaces::Triangles, GridFaces::OtherDiagonal, GridFaces::Quads));

TEST_P(EveryGrid, SphereIsClosedAndTrue) {
  const Scan scan = sphere({2.5, 24, 12, GetParam()});
  expect_complete(scan);
  EXPECT_EQ(scan.points.size(), 24U * 11 + 2);
  EXPECT_EQ(scan.faces.size(), GetParam() == GridFaces::Quads ? 24U * 10 + 48 : 48U * 10 + 48);
  for (const auto& x : scan.points) ASSERT_NEAR(x.norm(), 2.5, 1e-15 * 4);
  expect_truth(scan, sphere_normals(), 1e-3, 0.4, kTolerance);
  for (const double k : values(scan, "k_min")) ASSERT_DOUBLE_EQ(k, 0.4);
  expect_closed(scan, 2);
  expect_faces_follow_normals(scan);
}

TEST_P(EveryGrid, TorusIsClosedAndTrue) {
  for (const int twist : {0, 4, -1}) {
    const Scan scan = torus({3, 1, 40, 30, twist, GetParam()});
    expect_complete(scan);
    EXPECT_EQ(scan.points.size(), 1200U);
    for (const auto& x : scan.points) ASSERT_NEAR(std::hypot(std::hypot(x.x(), x.y()) - 3, x.z()), 1, 1e-14);
    expect_truth(scan, torus_normals(3), 1e-3, 1, kTolerance);
    expect_closed(scan, 0);
    expect_faces_follow_normals(scan);
  }
}

TEST(Torus, SignsOfItsHalves) {
  const Scan scan = torus({});
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const double arm = scan.points[i].head<2>().norm();
    ASSERT_NEAR(values(scan, "k_max")[i], 1, 1e-12);
    ASSERT_NEAR(values(scan, "k_min")[i], (arm - 3) / arm, 1e-12);  // convex outside, saddle inside
    ASSERT_NEAR(std::abs(test::vector_value(scan, "dir_min", i).z()), 0, 1e-12);
  }
}

TEST(Torus, TwistShearsTheEdges) {
  const Scan straight = torus({3, 1, 40, 40, 0, GridFaces::Quads}),
             twisted = torus({3, 1, 40, 40, 4, GridFaces::Quads});
  const auto slant = [](const Scan& scan) {  // of the first edge of each face against the parallels
    double largest = 0;
    for (std::size_t f = 0; f < scan.faces.size(); ++f) {
      const Vec3 edge = (scan.points[scan.faces[f][1]] - scan.points[scan.faces[f][0]]).normalized();
      largest = std::max(largest, std::abs(edge.dot(test::vector_value(scan, "dir_max", scan.faces[f][0]))));
    }
    return largest;
  };
  EXPECT_LT(slant(straight), 1.001 * std::sin(kPi / 40));  // a chord against its tangent
  EXPECT_GT(slant(twisted), 0.5);
}

TEST_P(EveryGrid, CylinderIsTrueWithAndWithoutCaps) {
  const Scan open = cylinder({2, 5, 20, 7, CylinderCaps::None, GetParam()});
  expect_complete(open);
  expect_truth(open, cylinder_normals(), 1e-3, 0.5, kTolerance);
  expect_faces_follow_normals(open);
  const MeshFacts tube = mesh_facts(open);
  EXPECT_EQ(tube.border_edges, 40U);
  EXPECT_EQ(tube.repeated_edges, 0U);
  EXPECT_EQ(tube.euler, 0);

  const Scan capped = cylinder({2, 5, 20, 7, CylinderCaps::Flat, GetParam()});
  expect_complete(capped);
  expect_faces_follow_normals(capped);
  const MeshFacts solid = mesh_facts(capped);
  EXPECT_LT(solid.area_vector.norm(), 1e-12 * solid.area);
  EXPECT_NEAR(solid.volume, 5 * 0.5 * 20 * 4 * std::sin(2 * kPi / 20), 1e-11);  // the prism
  for (std::size_t i = open.points.size(); i < capped.points.size(); ++i) {
    ASSERT_EQ(std::abs(capped.normals[i].z()), 1);
    ASSERT_EQ(values(capped, "k_max")[i], 0);
  }
}

TEST_P(EveryGrid, QuadricsAreTrue) {
  for (const auto& [a, b] : {std::pair(1.0, -1.0), std::pair(-0.5, -0.5), std::pair(0.0, 0.0), std::pair(0.7, 0.2)}) {
    const Scan scan = quadric({a, b, 3, 20, GetParam()});
    expect_complete(scan);
    EXPECT_EQ(scan.points.size(), 441U);
    for (const auto& x : scan.points) {
      ASSERT_NEAR(x.z(), (a * x.x() * x.x() + b * x.y() * x.y()) / 2, 1e-15);
      ASSERT_LE(x.head<2>().cwiseAbs().maxCoeff(), 1.5);
    }
    expect_truth(scan, quadric_normals(a, b), 1e-3, std::max(0.1, std::max(std::abs(a), std::abs(b))), kTolerance);
    expect_faces_follow_normals(scan);
    EXPECT_EQ(mesh_facts(scan).euler, 1);
    EXPECT_EQ(mesh_facts(scan).border_edges, 80U);
  }
}

TEST(Quadric, DomeIsConvexAndBowlIsConcave) {
  const Scan dome = quadric({-0.25, -0.25, 2, 2, GridFaces::Triangles});
  EXPECT_DOUBLE_EQ(values(dome, "k_min")[4], 0.25);
  const Scan bowl = quadric({0.25, 0.25, 2, 2, GridFaces::Triangles});
  EXPECT_DOUBLE_EQ(values(bowl, "k_max")[4], -0.25);
}

TEST(Saddle, HasItsCurvaturesAtZero) {
  const Scan scan = saddle({4, 2, 2, GridFaces::Triangles});
  EXPECT_DOUBLE_EQ(values(scan, "k_min")[4], -0.25);
  EXPECT_DOUBLE_EQ(values(scan, "k_max")[4], 0.25);
  EXPECT_EQ(values(scan, "mean_curvature")[4], 0);
  EXPECT_DOUBLE_EQ(std::abs(test::vector_value(scan, "dir_min", 4).x()), 1);
  EXPECT_DOUBLE_EQ(std::abs(test::vector_value(scan, "dir_max", 4).y()), 1);
}

TEST(Plane, IsFlat) {
  const Scan scan = plane({});
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    ASSERT_EQ(scan.points[i].z(), 0);
    ASSERT_EQ(scan.normals[i].z(), 1);
    ASSERT_EQ(values(scan, "k_min")[i], 0);
    ASSERT_EQ(values(scan, "gaussian_curvature")[i], 0);
  }
  EXPECT_NEAR(mesh_facts(scan).area, 4, 1e-12);
}

TEST(Icosphere, CountsAndCloses) {
  for (int subdivisions = 0; subdivisions <= 4; ++subdivisions) {
    const Scan scan = icosphere({0.5, subdivisions});
    const std::size_t power = std::size_t{1} << (2 * subdivisions);
    EXPECT_EQ(scan.points.size(), 10 * power + 2);
    EXPECT_EQ(scan.faces.size(), 20 * power);
    expect_complete(scan);
    expect_closed(scan, 2);
    expect_faces_follow_normals(scan);
    expect_truth(scan, sphere_normals(), 1e-4, 2, kTolerance);
    for (const auto& x : scan.points) ASSERT_NEAR(x.norm(), 0.5, 1e-15);
  }
  EXPECT_NEAR(mesh_facts(icosphere({0.5, 5})).area, kPi, 0.002 * kPi);
}

TEST(Lantern, LiesOnItsCylinder) {
  for (const int rings : {1, 2, 7, 40}) {
    const Scan scan = lantern({2, 3, 12, rings});
    expect_complete(scan);
    EXPECT_EQ(scan.points.size(), 12U * static_cast<unsigned>(rings + 1));
    for (const auto& x : scan.points) ASSERT_NEAR(x.head<2>().norm(), 2, 1e-14);
    expect_truth(scan, cylinder_normals(), 1e-3, 0.5, kTolerance);
    expect_faces_follow_normals(scan);
    const MeshFacts facts = mesh_facts(scan);
    EXPECT_EQ(facts.border_edges, 24U);
    EXPECT_EQ(facts.repeated_edges, 0U);
    EXPECT_EQ(facts.euler, 0);
  }
}

// Schwarz's closed form: 2 m n triangles of base 2 R sin(pi/m) and height hypot(H/n, R (1 - cos(pi/m))).
TEST(Lantern, HasItsAreaWhichDiverges) {
  const auto area = [](int m, int n) {
    return 2.0 * m * n * std::sin(kPi / m) * std::hypot(2.0 / n, 1 - std::cos(kPi / m));
  };
  for (const auto& [m, n] : {std::pair(20, 40), std::pair(20, 2000)}) {
    EXPECT_NEAR(mesh_facts(lantern({1, 2, m, n})).area, area(m, n), 1e-11 * area(m, n));
  }
  EXPECT_GT(mesh_facts(lantern({1, 2, 20, 2000})).area, 5 * 2 * kPi * 2);
}

TEST(Shapes, ScaleWithTheUnit) {
  const Scan small = torus({3e-6, 1e-6, 12, 12, 1, GridFaces::Triangles}),
             one = torus({3, 1, 12, 12, 1, GridFaces::Triangles});
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    ASSERT_NEAR(values(small, "k_min")[i] * 1e-6, values(one, "k_min")[i], 1e-12);
    ASSERT_NEAR(values(small, "gaussian_curvature")[i] * 1e-12, values(one, "gaussian_curvature")[i], 1e-12);
  }
}

TEST(Shapes, NamesAreUnique) {
  auto names = shape_names();
  EXPECT_EQ(names.size(), 11U);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace kappa
