// SPDX-License-Identifier: BSD-3-Clause
// Shapes on which the corrected curvatures are exact with true normals, whatever the mesh and the ball.
#include <gtest/gtest.h>

#include <cmath>

#include "kappa/curvature/estimate.hpp"
#include "support/shapes.hpp"

namespace kappa {
namespace {

using shapes::Shape;

constexpr std::array<BallDefinition, 2> kBalls = {BallDefinition::ExactDensity, BallDefinition::AreaFraction};
constexpr std::array<VertexLimit, 2> kLimits = {VertexLimit::Star, VertexLimit::Limit};

std::vector<CurvatureField> in_balls(const Shape& s, const std::vector<double>& radii, BallDefinition ball) {
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  return curvatures_in_balls(balls, s.mesh.vertices, s.normals, {radii, 1, ball});
}

struct Expected {
  double mean, gaussian, unit;  ///< `unit`: curvature that errors are relative to
};

void expect_field(const CurvatureField& field, const Expected& e, const char* what) {
  double mean = 0, gaussian = 0;
  std::size_t valid = 0;
  for (const CurvatureSample& s : field.samples) {
    if (s.k.status != PointStatus::Valid) continue;
    ++valid;
    mean = std::max(mean, std::abs(s.k.mean - e.mean) / e.unit);
    gaussian = std::max(gaussian, std::abs(s.k.gaussian - e.gaussian) / (e.unit * e.unit));
  }
  EXPECT_LE(mean, 1e-12) << what << " radius " << field.radius;
  EXPECT_LE(gaussian, 1e-12) << what << " radius " << field.radius;
  EXPECT_EQ(valid, field.samples.size()) << what << " radius " << field.radius;
}

void expect_exact(const Shape& s, const Expected& e, const std::vector<double>& radii, const char* what) {
  for (const BallDefinition ball : kBalls) {
    for (const CurvatureField& field : in_balls(s, radii, ball)) expect_field(field, e, what);
  }
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  for (const VertexLimit limit : kLimits) expect_field(curvatures_at_vertices(balls, s.normals, limit), e, what);
}

TEST(Exact, Sphere) {
  for (const double R : {1e-3, 1.0, 250.0}) {
    expect_exact(shapes::sphere(R, 2), {1 / R, 1 / (R * R), 1 / R}, {1e-3 * R, 0.1 * R, 0.37 * R, R, 2.5 * R},
                 "sphere");
  }
}

TEST(Exact, SphereOfIrregularTriangles) {
  const double R = 2;
  Shape s = shapes::sphere(R, 2);
  for (std::size_t i = 0; i < s.normals.size(); ++i) {
    const Vec3 x = s.normals[i];
    s.normals[i] = (x + 0.2 * Vec3(std::sin(7 * x.y()), std::cos(9 * x.z()), std::sin(8 * x.x()))).normalized();
    s.mesh.vertices[i] = R * s.normals[i];
  }
  expect_exact(s, {1 / R, 1 / (R * R), 1 / R}, {0.05, 0.4, 1.0, 3.0}, "irregular sphere");
}

/// Triangles that cross and overlap. A vertex may have no triangle: the ball around it is then what it meets.
TEST(Exact, SphereSoup) {
  const double R = 1;
  const Shape s = shapes::sphere_soup(R, 300, 4);
  for (const BallDefinition ball : kBalls) {
    for (const CurvatureField& field : in_balls(s, {0.5, 0.9, 1.7}, ball)) {
      expect_field(field, {1 / R, 1 / (R * R), 1 / R}, "soup");
    }
  }
}

TEST(Exact, SphereOfPolygons) {
  // A cube inscribed in the sphere: six quads, split at barycentres that get normals of their own.
  Shape s;
  const double R = 1.5;
  for (int i = 0; i < 8; ++i) {
    s.normals.push_back(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).normalized());
    s.mesh.vertices.push_back(R * s.normals.back());
  }
  for (const auto& f : std::vector<std::vector<Index>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    s.mesh.faces.add(f);
  }
  // Bilinear patches keep u = x / R inside, so they are exact.
  const Triangles t = triangles_of(s.mesh, s.normals, QuadMeasures::Bilinear);
  MeasureSum sum;
  for (const MeasureSum& m : measure_triangles(t)) sum += m;
  EXPECT_NEAR(sum.mu1() / (2 * sum.mu0), 1 / R, 1e-12);
  EXPECT_NEAR(sum.mu2 / sum.mu0, 1 / (R * R), 1e-12);
}

TEST(Exact, Cylinder) {
  for (const double R : {0.02, 1.0, 40.0}) {
    expect_exact(shapes::cylinder(R, 3 * R, 14, 9), {1 / (2 * R), 0, 1 / R}, {1e-2 * R, 0.3 * R, R, 4 * R}, "cylinder");
  }
}

TEST(Exact, SchwarzLantern) {
  // 10 corners in 400 rings: the area of the lantern diverges, its curvatures stay exact.
  const Shape s = shapes::cylinder(1, 1, 10, 400, 0.5);
  double area = 0;
  for (const MeasureSum& m : measure_triangles(triangles_of(s.mesh, s.normals))) area += m.area;
  EXPECT_GT(area, 10 * 2 * kPi);
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  for (const VertexLimit limit : kLimits) {
    expect_field(curvatures_at_vertices(balls, s.normals, limit), {0.5, 0, 1}, "lantern");
  }
  // Balls around every 97th vertex: the brute force is slow.
  std::vector<Vec3> centres;
  Normals u;
  for (std::size_t i = 0; i < s.normals.size(); i += 97) {
    centres.push_back(s.mesh.vertices[i]);
    u.push_back(s.normals[i]);
  }
  for (const BallDefinition ball : kBalls) {
    for (const CurvatureField& field : curvatures_in_balls(balls, centres, u, {{0.004, 0.05, 0.3, 1.5}, 1, ball})) {
      expect_field(field, {0.5, 0, 1}, "lantern");
    }
  }
}

TEST(Exact, PrincipalCurvaturesOfACylinder) {
  const Shape s = shapes::cylinder(2, 6, 60, 40);
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  const Index middle = 20 * 60;
  const CurvatureField f = curvatures_in_balls(balls, {s.mesh.vertices[middle]}, {s.normals[middle]}, {{0.5}})[0];
  const Curvatures& k = f.samples[0].k;
  EXPECT_NEAR(k.k_min, 0, 2e-3);
  EXPECT_NEAR(k.k_max, 0.5, 0.01);
  EXPECT_NEAR(std::abs(k.dir_min.z()), 1, 1e-4);
  EXPECT_NEAR(std::abs(k.dir_max.y()), 1, 1e-4) << "across the axis at the vertex (2, 0, z)";
}

/// On a sphere of radius R the principal curvatures in a ball of radius rho are k = (1 - rho^2 / (4 R^2)) / R +
/// O(rho^4).
TEST(Exact, KnownScaleBiasOfTheSphere) {
  const Shape s = shapes::sphere(1, 5);
  const BruteForceBallSum balls(triangles_of(s.mesh, s.normals));
  for (const double rho : {0.2, 0.4}) {
    const auto f = curvatures_in_balls(balls, {s.mesh.vertices[0]}, {s.normals[0]}, {{rho}});
    EXPECT_NEAR(f[0].samples[0].k.k_max, 1 - rho * rho / 4, 1.5e-3) << rho;
    EXPECT_NEAR(f[0].samples[0].k.k_min, 1 - rho * rho / 4, 1.5e-3) << rho;
  }
}

}  // namespace
}  // namespace kappa
